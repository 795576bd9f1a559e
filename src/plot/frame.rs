//! A panel in its place on the sheet.

use super::axis::Axis;
use super::canvas::{Align, Canvas};
use super::picture::Panel;
use super::style::Colour;
use super::text::{LINE, NORMAL, SMALL, text_width};

const WIDTH: f64 = 0.6;
const TICK: f64 = 3.0;
const GRID: Colour = Colour::new(225, 225, 225);

/// The rectangle of a panel, in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'a> {
    pub panel: &'a Panel,
    /// The width of the sheet.
    pub sheet: f64,
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Frame<'_> {
    /// Where a value stands on the sheet; on the edge, where it lies outside.
    pub fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let across = self.panel.x.share(x) * (self.right - self.left);
        let up = self.panel.y.share(y) * (self.bottom - self.top);
        (
            (self.left + across).clamp(self.left, self.right),
            (self.bottom - up).clamp(self.top, self.bottom),
        )
    }

    pub fn all(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        points.iter().map(|&point| self.at(point)).collect()
    }

    pub fn x(&self, x: f64) -> f64 {
        self.at((x, self.panel.y.from)).0
    }

    pub fn y(&self, y: f64) -> f64 {
        self.at((self.panel.x.from, y)).1
    }

    /// Both ends of a stretch of x.
    pub fn stretch(&self, (from, to): (f64, f64)) -> (f64, f64) {
        (self.x(from), self.x(to))
    }

    /// A line at each tick of y.
    pub fn draw_grid(&self, canvas: &mut Canvas) {
        for y in self.ticks_up().map(|(y, _)| self.y(*y)) {
            canvas.line(&[(self.left, y), (self.right, y)], 0.4, GRID);
        }
    }

    /// The rectangle, ticks, labels and title.
    pub fn draw_axes(&self, canvas: &mut Canvas) {
        let (left, right, top, bottom) = (self.left, self.right, self.top, self.bottom);
        let Panel { x, y, title, .. } = self.panel;
        canvas.outline((left, top), (right, bottom), WIDTH, Colour::BLACK);
        let lines = self.panel.lines_of_names(right - left);
        for (place, (value, label)) in self.spaced_ticks(lines).enumerate() {
            let at = self.x(*value);
            canvas.line(&[(at, bottom), (at, bottom - TICK)], WIDTH, Colour::BLACK);
            // The last label stays on the sheet.
            let half = text_width(label, SMALL) / 2.0;
            let at = at.min(self.sheet - half).max(half);
            let baseline = bottom + SMALL + 3.0 + LINE * (place % lines) as f64;
            canvas.text(label, (at, baseline), SMALL, Align::Centre);
        }
        for (value, label) in self.ticks_up() {
            let at = self.y(*value);
            canvas.line(&[(left, at), (left + TICK, at)], WIDTH, Colour::BLACK);
            canvas.text(label, (left - 4.0, at + 0.36 * SMALL), SMALL, Align::Right);
        }
        let middle = f64::midpoint(left, right);
        for (line, text) in (lines - 1..).zip(x.label.split('\n')) {
            let baseline = bottom + 25.0 + LINE * line as f64;
            canvas.text(text, (middle, baseline), NORMAL, Align::Centre);
        }
        canvas.upright_text(&y.label, (12.0, f64::midpoint(top, bottom)), NORMAL);
        let above = |canvas: &mut Canvas, text: &str, lowest: f64| {
            for (line, text) in (0..).zip(text.rsplit('\n')) {
                let baseline = lowest - LINE * f64::from(line);
                canvas.text(text, (middle, baseline), NORMAL, Align::Centre);
            }
        };
        above(canvas, title, top - 5.0);
        if let Some(axis) = &self.panel.top {
            for (value, label) in &axis.ticks {
                let at = left + axis.share(*value) * (right - left);
                canvas.line(&[(at, top), (at, top + TICK)], WIDTH, Colour::BLACK);
                canvas.text(label, (at, top - 4.0), SMALL, Align::Centre);
            }
            above(canvas, &axis.label, top - 16.0);
        }
    }

    /// The ticks of x whose words find room side by side, on so many lines in turn.
    fn spaced_ticks(&self, lines: usize) -> impl Iterator<Item = &(f64, String)> {
        let axis = &self.panel.x;
        let needed = room_of_words(axis) / lines as f64;
        spaced(&axis.ticks, needed, |value| self.x(value))
    }

    /// The ticks of y whose words find room over each other.
    fn ticks_up(&self) -> impl Iterator<Item = &(f64, String)> {
        spaced(&self.panel.y.ticks, SMALL + 1.0, |value| self.y(value))
    }
}

impl Panel {
    /// On how many lines names along x stand in turn, where the panel has a width: on as few as leave none out, up to three.
    pub(super) fn lines_of_names(&self, width: f64) -> usize {
        if self.x.scale.is_some() {
            return 1;
        }
        let step = width / (self.x.to - self.x.from);
        let fits = |lines: &usize| room_of_words(&self.x) <= step * *lines as f64;
        (1..3).find(fits).unwrap_or(3)
    }
}

/// What the longest words of an axis take side by side.
fn room_of_words(axis: &Axis) -> f64 {
    let widths = axis.ticks.iter().map(|(_, label)| text_width(label, SMALL));
    widths.fold(0.0, f64::max) + 6.0
}

/// The first tick and every one that is as far as it needs from those before, which may run up or down.
fn spaced(
    ticks: &[(f64, String)],
    needed: f64,
    place: impl Fn(f64) -> f64,
) -> impl Iterator<Item = &(f64, String)> {
    let mut last: Option<f64> = None;
    ticks.iter().filter(move |(value, _)| {
        let at = place(*value);
        let has_room = last.is_none_or(|last| (at - last).abs() >= needed - 0.01);
        if has_room {
            last = Some(at);
        }
        has_room
    })
}
