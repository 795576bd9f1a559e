//! A legend in its place on the sheet, and how it is drawn.

use super::canvas::{Align, Canvas};
use super::frame::Frame;
use super::legend::{Entry, Key, Legend};
use super::style::Colour;
use super::text::{SMALL, text_width};

const STEP: f64 = 11.5;
/// What the key of an entry takes, and the margins.
pub(super) const BESIDE_TEXT: f64 = 32.0;
const MARGIN: f64 = 6.0;
const EDGE: (f64, Colour) = (0.4, Colour::BLACK.faded(0.3));

/// A legend on the sheet, its entries in columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    entries: &'a [Entry],
    columns: usize,
    /// The upper left corner.
    pub corner: (f64, f64),
}

impl<'a> Placed<'a> {
    /// In one column.
    pub fn new(legend: &'a Legend) -> Self {
        let (entries, corner) = (&legend.entries[..], (0.0, 0.0));
        Self {
            entries,
            columns: 1,
            corner,
        }
    }

    pub fn width(&self) -> f64 {
        self.columns as f64 * self.column_width()
    }

    fn column_width(&self) -> f64 {
        let widths = (self.entries.iter()).map(|entry| text_width(&entry.text, SMALL));
        widths.fold(0.0, f64::max) + BESIDE_TEXT
    }

    pub fn height(&self) -> f64 {
        STEP * self.rows() as f64 + 6.0
    }

    fn rows(&self) -> usize {
        self.entries.len().div_ceil(self.columns)
    }

    /// The same with its upper left corner at (`x`, `y`).
    pub fn at(self, corner: (f64, f64)) -> Self {
        Self { corner, ..self }
    }

    /// The same in as many columns as `width` has room for, filled evenly.
    pub fn spread(self, width: f64) -> Self {
        let most = ((width / self.column_width()) as usize).clamp(1, self.entries.len().max(1));
        let rows = self.entries.len().div_ceil(most).max(1);
        let columns = self.entries.len().div_ceil(rows).max(1);
        Self { columns, ..self }
    }

    /// In a corner of `frame` where it covers nothing of `data`, points on the sheet.
    pub fn in_corner(self, frame: &Frame, data: &[(f64, f64)]) -> Option<Self> {
        let (left, top) = self.corner_of(frame, false, false);
        [(true, true), (false, false), (true, false), (false, true)]
            .into_iter()
            .map(|(is_right, is_low)| self.corner_of(frame, is_right, is_low))
            .filter(|&(x, y)| x >= left && y >= top)
            .map(|corner| self.at(corner))
            .find(|legend| !legend.covers(data))
    }

    /// Where it begins in this corner of `frame`.
    pub fn corner_of(&self, frame: &Frame, is_right: bool, is_low: bool) -> (f64, f64) {
        let x = if is_right {
            frame.right - MARGIN - self.width()
        } else {
            frame.left + MARGIN
        };
        let y = if is_low {
            frame.bottom - MARGIN - self.height()
        } else {
            frame.top + MARGIN
        };
        (x, y)
    }

    /// Whether any of `data` lies under it, or close to it.
    pub fn covers(&self, data: &[(f64, f64)]) -> bool {
        let ((x, y), width, height) = (self.corner, self.width(), self.height());
        let near = |at: f64, from: f64, length: f64| at > from - 4.0 && at < from + length + 4.0;
        data.iter()
            .any(|point| near(point.0, x, width) && near(point.1, y, height))
    }

    pub fn draw(&self, canvas: &mut Canvas) {
        let (x, y) = self.corner;
        let opposite = (x + self.width(), y + self.height());
        canvas.rectangle((x, y), opposite, Colour::WHITE);
        canvas.outline((x, y), opposite, EDGE.0, EDGE.1);
        for (index, entry) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows(), index % self.rows());
            let left = x + column as f64 * self.column_width();
            entry.draw(canvas, left, y + 3.0 + STEP * (row as f64 + 0.5));
        }
    }
}

impl Entry {
    fn draw(&self, canvas: &mut Canvas, left: f64, middle: f64) {
        let (style, colour) = (&self.style, self.style.colour);
        let ends = [(left + 4.0, middle), (left + 22.0, middle)];
        match self.key {
            Key::Marker | Key::None => {}
            Key::MarkedLine => canvas.line(&ends, style.width, colour),
            Key::Line => canvas.dashed(&ends, style),
            Key::Shade => {
                let (corner, opposite) = ((left + 4.0, middle - 3.5), (left + 22.0, middle + 3.5));
                canvas.rectangle(corner, opposite, colour);
                canvas.outline(corner, opposite, EDGE.0, EDGE.1);
            }
        }
        if matches!(self.key, Key::Marker | Key::MarkedLine) {
            canvas.marker((left + 13.0, middle), style);
        }
        let baseline = (left + 27.0, middle + 0.36 * SMALL);
        canvas.text(&self.text, baseline, SMALL, Align::Left);
    }
}
