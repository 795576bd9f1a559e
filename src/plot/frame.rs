//! A panel in its place on the sheet.

use super::canvas::{Align, Canvas};
use super::text::{NORMAL, SMALL, text_width};
use super::{Axis, Colour, Panel};

const AXIS_WIDTH: f64 = 0.6;
const TICK: f64 = 3.0;
const GRID: Colour = Colour::new(225, 225, 225);

/// The rectangle of a panel, in points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'a> {
    pub panel: &'a Panel,
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

    pub fn x(&self, x: f64) -> f64 {
        self.at((x, self.panel.y.from)).0
    }

    pub fn y(&self, y: f64) -> f64 {
        self.at((self.panel.x.from, y)).1
    }

    pub fn middle(&self) -> f64 {
        f64::midpoint(self.left, self.right)
    }

    /// A line at each tick of y.
    pub fn draw_grid(&self, canvas: &mut Canvas) {
        for (y, _) in &self.panel.y.ticks {
            let y = self.y(*y);
            canvas.line(&[(self.left, y), (self.right, y)], 0.4, GRID);
        }
    }

    /// The rectangle, ticks, labels and title.
    pub fn draw_axes(&self, canvas: &mut Canvas) {
        let corners = ((self.left, self.top), (self.right, self.bottom));
        canvas.outline(corners.0, corners.1, AXIS_WIDTH, Colour::BLACK);
        let Panel { x, y, title, .. } = self.panel;
        for (value, label) in self.spaced_ticks(x) {
            let (at, bottom) = (self.x(*value), self.bottom);
            canvas.line(
                &[(at, bottom), (at, bottom - TICK)],
                AXIS_WIDTH,
                Colour::BLACK,
            );
            canvas.text(label, (at, bottom + SMALL + 3.0), SMALL, Align::Centre);
        }
        for (value, label) in &y.ticks {
            let (left, at) = (self.left, self.y(*value));
            canvas.line(&[(left, at), (left + TICK, at)], AXIS_WIDTH, Colour::BLACK);
            let beside = (left - 4.0, at + 0.36 * SMALL);
            canvas.text(label, beside, SMALL, Align::Right);
        }
        let below = (self.middle(), self.bottom + 25.0);
        canvas.text(&x.label, below, NORMAL, Align::Centre);
        let beside = (12.0, f64::midpoint(self.top, self.bottom));
        canvas.upright_text(&y.label, beside, NORMAL);
        let above = (self.middle(), self.top - 5.0);
        canvas.text(title, above, NORMAL, Align::Centre);
        if let Some(axis) = &self.panel.top {
            self.draw_top(canvas, axis);
        }
    }

    fn draw_top(&self, canvas: &mut Canvas, axis: &Axis) {
        let top = self.top;
        for (value, label) in &axis.ticks {
            let x = self.left + axis.share(*value) * (self.right - self.left);
            canvas.line(&[(x, top), (x, top + TICK)], AXIS_WIDTH, Colour::BLACK);
            canvas.text(label, (x, top - 4.0), SMALL, Align::Centre);
        }
        let above = (self.middle(), top - 16.0);
        canvas.text(&axis.label, above, NORMAL, Align::Centre);
    }

    /// The ticks whose words find room side by side: the first and every so many after it.
    fn spaced_ticks<'t>(&self, axis: &'t Axis) -> impl Iterator<Item = &'t (f64, String)> {
        let widths = axis.ticks.iter().map(|(_, label)| text_width(label, SMALL));
        let needed = widths.fold(0.0, f64::max) + 6.0;
        let every = needed * axis.ticks.len() as f64 / (self.right - self.left);
        axis.ticks.iter().step_by(every.ceil().max(1.0) as usize)
    }
}
