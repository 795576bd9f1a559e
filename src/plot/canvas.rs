//! Lines, areas and texts on a sheet, measured in points (1/72 inch) from its upper left corner.

use super::text::{FONT_HEIGHT, runs, text_width};
use super::{Colour, Marker};

/// A sheet and what lies on it, from the bottom up.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    /// Width and height.
    pub size: (f64, f64),
    pub shapes: Vec<Shape>,
}

/// The few things that can be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Through its points.
    Line {
        points: Vec<(f64, f64)>,
        width: f64,
        colour: Colour,
    },
    /// A filled polygon.
    Area {
        points: Vec<(f64, f64)>,
        colour: Colour,
    },
    Disc {
        centre: (f64, f64),
        radius: f64,
        colour: Colour,
    },
    Text {
        text: String,
        /// The left end of the baseline, half a `height` above it.
        at: (f64, f64),
        /// From descender to ascender.
        height: f64,
        /// Reads upwards; `at` lies half a height to the left of the baseline then.
        is_upright: bool,
    },
}

/// Where on a text its position is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

impl Canvas {
    /// White paper.
    pub(super) fn new(size: (f64, f64)) -> Self {
        let shapes = Vec::new();
        let mut canvas = Self { size, shapes };
        canvas.rectangle((0.0, 0.0), size, Colour::WHITE);
        canvas
    }

    pub(super) fn line(&mut self, points: &[(f64, f64)], width: f64, colour: Colour) {
        self.shapes.push(Shape::Line {
            points: points.to_vec(),
            width,
            colour,
        });
    }

    /// A line through `points`, its `dash` drawn and left out in turn.
    pub(super) fn dashed(
        &mut self,
        points: &[(f64, f64)],
        width: f64,
        colour: Colour,
        dash: &[f64],
    ) {
        if dash.is_empty() || points.is_empty() {
            return self.line(points, width, colour);
        }
        for stroke in strokes(points, dash) {
            self.line(&stroke, width, colour);
        }
    }

    pub(super) fn area(&mut self, points: Vec<(f64, f64)>, colour: Colour) {
        self.shapes.push(Shape::Area { points, colour });
    }

    /// A filled rectangle between two opposite corners.
    pub(super) fn rectangle(
        &mut self,
        (left, top): (f64, f64),
        (right, bottom): (f64, f64),
        colour: Colour,
    ) {
        let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom)];
        self.area(corners, colour);
    }

    /// The edge of a rectangle.
    pub(super) fn outline(
        &mut self,
        (left, top): (f64, f64),
        (right, bottom): (f64, f64),
        width: f64,
        colour: Colour,
    ) {
        let corners = [
            (left, top),
            (right, top),
            (right, bottom),
            (left, bottom),
            (left, top),
        ];
        self.line(&corners, width, colour);
    }

    /// A marker of half-width `r`.
    pub(super) fn marker(&mut self, kind: Marker, (x, y): (f64, f64), r: f64, colour: Colour) {
        let shape = |corners: &[(f64, f64)]| -> Vec<(f64, f64)> {
            let corners = corners.iter();
            corners.map(|(dx, dy)| (x + r * dx, y + r * dy)).collect()
        };
        let square = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
        let diamond = [(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)];
        match kind {
            Marker::Disc => self.shapes.push(Shape::Disc {
                centre: (x, y),
                radius: r,
                colour,
            }),
            Marker::Square => self.area(shape(&square), colour),
            Marker::Triangle => self.area(shape(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), colour),
            Marker::Wedge => self.area(shape(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]), colour),
            Marker::Diamond => self.area(shape(&diamond), colour),
            Marker::Cross => {
                self.line(&shape(&[(-1.0, -1.0), (1.0, 1.0)]), 0.4 * r, colour);
                self.line(&shape(&[(-1.0, 1.0), (1.0, -1.0)]), 0.4 * r, colour);
            }
            Marker::ArrowDown => self.arrow((x, y), 3.0 * r, colour),
            Marker::ArrowUp => self.arrow((x, y), -3.0 * r, colour),
        }
    }

    /// An arrow of so many points downwards, or upwards where they are negative.
    fn arrow(&mut self, (x, y): (f64, f64), length: f64, colour: Colour) {
        let (tip, half) = (y + length, 0.35 * length);
        self.line(&[(x - half, y), (x + half, y)], 0.8, colour);
        self.line(&[(x, y), (x, tip - half)], 0.8, colour);
        let head = vec![(x, tip), (x - half, tip - half), (x + half, tip - half)];
        self.area(head, colour);
    }

    /// Text on one line whose baseline passes through `point`.
    pub(super) fn text(&mut self, text: &str, point: (f64, f64), size: f64, align: Align) {
        self.runs(text, point, size, align, false);
    }

    /// The same centred and read upwards.
    pub(super) fn upright_text(&mut self, text: &str, point: (f64, f64), size: f64) {
        self.runs(text, point, size, Align::Centre, true);
    }

    fn runs(&mut self, text: &str, (x, y): (f64, f64), size: f64, align: Align, is_upright: bool) {
        let width = text_width(text, size);
        let mut along = match align {
            Align::Left => 0.0,
            Align::Centre => -width / 2.0,
            Align::Right => -width,
        };
        for run in runs(text) {
            let height = size * run.scale() * FONT_HEIGHT;
            let lowered = if run.is_subscript { 0.22 * size } else { 0.0 };
            let across = lowered - height / 2.0;
            let at = match is_upright {
                true => (x + across, y - along),
                false => (x + along, y + across),
            };
            along += run.width(size);
            self.shapes.push(Shape::Text {
                text: run.text,
                at,
                height,
                is_upright,
            });
        }
    }
}

/// The parts of a line through `points` that a `dash` leaves.
fn strokes(points: &[(f64, f64)], dash: &[f64]) -> Vec<Vec<(f64, f64)>> {
    let mut strokes = vec![points[..1].to_vec()];
    let (mut phase, mut left) = (0, dash[0]);
    for pair in points.windows(2) {
        let ((x, y), (dx, dy)) = (pair[0], (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1));
        let length = libm::hypot(dx, dy);
        let mut along = 0.0;
        while length - along > left {
            along += left;
            let turn = (x + dx * along / length, y + dy * along / length);
            match phase % 2 {
                0 => strokes[phase / 2].push(turn),
                _ => strokes.push(vec![turn]),
            }
            phase += 1;
            left = dash[phase % dash.len()];
        }
        left -= length - along;
        if phase % 2 == 0 {
            strokes[phase / 2].push(pair[1]);
        }
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Round a corner, 3 drawn and 2 left out.
    #[test]
    fn dashes_go_round_corners() {
        let line = [(0.0, 0.0), (6.0, 0.0), (6.0, 5.0)];
        let expected = [
            vec![(0.0, 0.0), (3.0, 0.0)],
            vec![(5.0, 0.0), (6.0, 0.0), (6.0, 2.0)],
            vec![(6.0, 4.0), (6.0, 5.0)],
        ];
        assert_eq!(strokes(&line, &[3.0, 2.0]), expected);
    }
}
