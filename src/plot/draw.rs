//! Draws marks in their panels.

use super::axis::ends;
use super::canvas::{Align, Canvas};
use super::frame::Frame;
use super::mark::{Block, Limit, Mark, Point};
use super::picture::WIDTH;
use super::style::{Colour, Style};
use super::text::{NORMAL, SMALL, text_width};

/// Width of a column of a dense line.
const COLUMN: f64 = 0.4;
const EDGE: Style = Style::of(0).coloured(Colour::BLACK.faded(0.6));

impl Mark {
    /// Draws it in `panel`, one of `frames`.
    pub(super) fn draw(&self, canvas: &mut Canvas, panel: usize, frames: &[Frame]) {
        let frame = &frames[panel];
        match self {
            Self::Legend => {}
            Self::Grid => frame.draw_grid(canvas),
            Self::Axes => frame.draw_axes(canvas),
            Self::Line(points, style) => canvas.dashed(&frame.all(points), style),
            Self::Dense(points, style) => draw_dense(canvas, &frame.all(points), style.colour),
            Self::Band(points, style) => {
                if let [point] = &points[..] {
                    draw_bar(canvas, frame, point, &style.wide(4.0));
                }
                let upper = points.iter().map(|p| frame.at((p.x, p.high)));
                let lower = points.iter().rev().map(|p| frame.at((p.x, p.low)));
                canvas.area(upper.chain(lower).collect(), style.colour);
            }
            Self::Bars(points, style) => {
                for point in points {
                    draw_bar(canvas, frame, point, style);
                }
            }
            Self::Markers(points, style) => {
                for point in points {
                    draw_marker(canvas, frame, point, style);
                }
            }
            Self::Points(points, style) => {
                for point in points {
                    draw_bar(canvas, frame, point, style);
                    draw_marker(canvas, frame, point, style);
                }
            }
            Self::Span(stretch, colour) => {
                let (left, right) = frame.stretch(*stretch);
                canvas.rectangle((left, frame.top), (right, frame.bottom), *colour);
            }
            Self::Names(names, above) => draw_names(canvas, frame, names, *above),
            Self::Level(y, dash) => {
                let ends = [(frame.left, frame.y(*y)), (frame.right, frame.y(*y))];
                canvas.dashed(&ends, &EDGE.wide(0.8).dashed(dash));
            }
            Self::Limit(x) => {
                let (x, last) = (frame.x(*x), &frames[frames.len() - 1]);
                let line = [(x, frames[0].top), (x, last.bottom)];
                canvas.dashed(&line, &EDGE.wide(0.5).dashed(&[2.0, 2.0]));
            }
            Self::Bracket(stretch, name) => draw_bracket(canvas, frame, *stretch, name),
            Self::Bar(stretch, below, colour) => {
                let ((left, right), y) = (frame.stretch(*stretch), frame.top + below);
                canvas.line(&[(left, y), (right, y)], 2.4, *colour);
            }
            Self::Cells(cells) => {
                for (corner, opposite, colour) in cells {
                    canvas.rectangle(frame.at(*corner), frame.at(*opposite), *colour);
                }
            }
            Self::Shades(title, shades) => draw_shades(canvas, frame, title, shades),
            Self::Block(block) => draw_block(canvas, frame, block),
        }
    }
}

/// The interval of a point that has one.
fn draw_bar(canvas: &mut Canvas, frame: &Frame, point: &Point, style: &Style) {
    if point.low < point.high {
        let ends = [point.low, point.high].map(|y| frame.at((point.x, y)));
        canvas.line(&ends, style.width, style.colour);
    }
}

fn draw_marker(canvas: &mut Canvas, frame: &Frame, point: &Point, style: &Style) {
    let place = frame.at(point.place());
    match point.limit {
        Some(Limit::Upper) => canvas.arrow(place, 3.0 * style.size, style.colour),
        Some(Limit::Lower) => canvas.arrow(place, -3.0 * style.size, style.colour),
        None => canvas.marker(place, style),
    }
}

/// An upright bar over the extremes of each column, its neighbour's end included, because the turns of a
/// thick line would reach beyond its points.
fn draw_dense(canvas: &mut Canvas, line: &[(f64, f64)], colour: Colour) {
    let column = |place: &(f64, f64)| (place.0 / COLUMN).floor();
    let mut before: Option<f64> = None;
    for places in line.chunk_by(|a, b| column(a) == column(b)) {
        let (top, bottom) = ends(places.iter().map(|place| place.1).chain(before));
        let x = (column(&places[0]) + 0.5) * COLUMN;
        canvas.line(&[(x, top - 0.2), (x, bottom + 0.2)], COLUMN, colour);
        before = places.last().map(|place| place.1);
    }
}

fn draw_names(canvas: &mut Canvas, frame: &Frame, names: &[((f64, f64), String)], above: f64) {
    let mut taken = 0.0;
    for (stretch, name) in names {
        let (left, right) = frame.stretch(*stretch);
        let (middle, half) = (f64::midpoint(left, right), text_width(name, SMALL) / 2.0);
        if middle - half > taken && middle + half < WIDTH {
            canvas.text(name, (middle, frame.top - above), SMALL, Align::Centre);
            taken = middle + half + 4.0;
        }
    }
}

fn draw_bracket(canvas: &mut Canvas, frame: &Frame, stretch: (f64, f64), name: &str) {
    let ((from, to), y) = (frame.stretch(stretch), frame.top - 5.0);
    let (left, right) = (from + 0.7, to - 0.7);
    let bracket = [(left, y + 4.0), (left, y), (right, y), (right, y + 4.0)];
    canvas.line(&bracket, 0.8, Colour::BLACK);
    let above = (f64::midpoint(left, right), y - 3.0);
    canvas.text(name, above, SMALL, Align::Centre);
}

fn draw_shades(canvas: &mut Canvas, frame: &Frame, title: &str, shades: &[(Colour, String)]) {
    let (left, top) = (frame.right + 12.0, frame.top + 16.0);
    canvas.text(title, (left, top - 8.0), SMALL, Align::Left);
    for (row, (colour, label)) in shades.iter().enumerate() {
        let y = top + 14.0 * row as f64;
        let (corner, opposite) = ((left, y), (left + 14.0, y + 10.0));
        canvas.rectangle(corner, opposite, *colour);
        canvas.outline(corner, opposite, 0.4, Colour::BLACK.faded(0.5));
        canvas.text(label, (left + 20.0, y + 8.0), SMALL, Align::Left);
    }
}

fn draw_block(canvas: &mut Canvas, frame: &Frame, block: &Block) {
    let (left, right) = frame.stretch(block.ends);
    let (top, bottom) = (frame.y(0.86), frame.y(0.14));
    if let Some(colour) = block.colour {
        canvas.rectangle((left, top), (right, bottom), colour.faded(0.28));
        canvas.outline((left, top), (right, bottom), 0.8, colour);
    }
    if block.is_cut {
        let words = block.lines.first().map_or(0.0, |it| text_width(it, NORMAL));
        // Beside the first line, or below all where that leaves no room.
        let has_room = words + 2.0 * 15.0 <= right - left;
        let line = if has_room { 0 } else { block.lines.len() };
        let at = (left + 9.0, top + 15.0 + 13.0 * line as f64);
        canvas.text("…", at, NORMAL, Align::Centre);
    }
    let fits = |text: &&String| text_width(text, SMALL) < right - left;
    for (line, text) in (0..).zip(block.lines.iter().filter(fits)) {
        let at = (
            f64::midpoint(left, right),
            top + 15.0 + 13.0 * f64::from(line),
        );
        let size = if line == 0 { NORMAL } else { SMALL };
        canvas.text(text, at, size, Align::Centre);
    }
}
