//! Lines, areas and texts on a sheet, measured in points (1/72 inch) from its upper left corner.

use super::style::{Colour, Marker, Style};
use super::text::{FONT_HEIGHT, runs, text_width};

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
    /// Through its points, of this width.
    Line(Vec<(f64, f64)>, f64, Colour),
    /// A filled polygon.
    Area(Vec<(f64, f64)>, Colour),
    /// Around its centre, of this radius.
    Disc((f64, f64), f64, Colour),
    Text(Text),
}

/// Black text on one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    pub text: String,
    /// The left end of the baseline, half a `height` above it.
    pub at: (f64, f64),
    /// From descender to ascender.
    pub height: f64,
    /// Reads upwards; `at` lies half a height to the left of the baseline then.
    pub is_upright: bool,
}

/// Where on a text its position is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

impl Canvas {
    /// A white sheet.
    pub(super) fn new(size: (f64, f64)) -> Self {
        let shapes = Vec::new();
        let mut canvas = Self { size, shapes };
        canvas.rectangle((0.0, 0.0), size, Colour::WHITE);
        canvas
    }

    pub(super) fn line(&mut self, points: &[(f64, f64)], width: f64, colour: Colour) {
        self.shapes
            .push(Shape::Line(points.to_vec(), width, colour));
    }

    /// A line with its dashes.
    pub(super) fn dashed(&mut self, points: &[(f64, f64)], style: &Style) {
        if style.dash.is_empty() || points.is_empty() {
            return self.line(points, style.width, style.colour);
        }
        for stroke in strokes(points, style.dash) {
            self.line(&stroke, style.width, style.colour);
        }
    }

    pub(super) fn area(&mut self, points: Vec<(f64, f64)>, colour: Colour) {
        self.shapes.push(Shape::Area(points, colour));
    }

    /// A filled rectangle between two opposite corners.
    pub(super) fn rectangle(&mut self, from: (f64, f64), to: (f64, f64), colour: Colour) {
        self.area(corners(from, to).to_vec(), colour);
    }

    /// The edge of a rectangle.
    pub(super) fn outline(&mut self, from: (f64, f64), to: (f64, f64), width: f64, colour: Colour) {
        let corners = corners(from, to);
        self.line(&[&corners[..], &[from]].concat(), width, colour);
    }

    pub(super) fn marker(&mut self, (x, y): (f64, f64), style: &Style) {
        let (r, colour) = (style.size, style.colour);
        let place = |(dx, dy): &(f64, f64)| (x + r * dx, y + r * dy);
        let corners: &[(f64, f64)] = match style.marker {
            Marker::Disc => return self.shapes.push(Shape::Disc((x, y), r, colour)),
            Marker::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Marker::Triangle => &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
            Marker::Wedge => &[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)],
            Marker::Diamond => &[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)],
            Marker::Cross => {
                for down in [1.0, -1.0] {
                    let ends = [(-1.0, -down), (1.0, down)].map(|end| place(&end));
                    self.line(&ends, 0.4 * r, colour);
                }
                return;
            }
        };
        self.area(corners.iter().map(place).collect(), colour);
    }

    /// An arrow of so many points downwards, or upwards where they are negative.
    pub(super) fn arrow(&mut self, (x, y): (f64, f64), length: f64, colour: Colour) {
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
            let at = if is_upright {
                (x + across, y - along)
            } else {
                (x + along, y + across)
            };
            along += run.width(size);
            let text = run.text;
            self.shapes.push(Shape::Text(Text {
                text,
                at,
                height,
                is_upright,
            }));
        }
    }
}

/// A place in whole units, so many per point.
pub fn rounded((x, y): (f64, f64), unit: f64) -> (i32, i32) {
    ((x * unit).round() as i32, (y * unit).round() as i32)
}

fn corners((left, top): (f64, f64), (right, bottom): (f64, f64)) -> [(f64, f64); 4] {
    [(left, top), (right, top), (right, bottom), (left, bottom)]
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
