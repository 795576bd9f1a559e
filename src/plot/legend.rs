//! The legend and how it is drawn.

use super::canvas::{Align, Canvas};
use super::frame::Frame;
use super::text::{SMALL, text_width};
use super::{Colour, Style};

const STEP: f64 = 11.5;
const MARGIN: f64 = 6.0;
const MARKER: f64 = 2.3;
const LINE: f64 = 1.1;

/// What the styles of a plot stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    pub entries: Vec<Entry>,
    pub place: Place,
}

/// What a style stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub text: String,
    pub style: Style,
    pub key: Key,
}

/// How something is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    Marker,
    MarkedLine,
    Line,
    Shade,
}

/// Where a legend goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A corner of a panel, or a free place in a grid, where it covers no data; above where there is none.
    Free,
    /// So many points left of the right edge of the first panel and below its upper edge; above where it
    /// would cover data.
    Inside(f64, f64),
    /// Above the panels.
    Above,
    /// Above the panels, as wide as a caption.
    Across,
}

/// A legend on the sheet, its entries in columns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    entries: &'a [Entry],
    columns: usize,
    /// The upper left corner.
    pub corner: (f64, f64),
}

impl Legend {
    pub fn new(entries: Vec<Entry>, place: Place) -> Self {
        Self { entries, place }
    }
}

impl Entry {
    pub fn new(text: impl Into<String>, style: Style, key: Key) -> Self {
        let text = text.into();
        Self { text, style, key }
    }
}

impl<'a> Placed<'a> {
    /// In one column.
    pub fn new(legend: &'a Legend) -> Self {
        Self {
            entries: &legend.entries,
            columns: 1,
            corner: (0.0, 0.0),
        }
    }

    pub fn width(&self) -> f64 {
        self.columns as f64 * self.column_width()
    }

    fn column_width(&self) -> f64 {
        let widths = (self.entries.iter()).map(|entry| text_width(&entry.text, SMALL));
        widths.fold(0.0, f64::max) + 32.0
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
        let (left, right) = (frame.left + MARGIN, frame.right - MARGIN - self.width());
        let (top, bottom) = (frame.top + MARGIN, frame.bottom - MARGIN - self.height());
        [(right, bottom), (left, top), (right, top), (left, bottom)]
            .into_iter()
            .filter(|&(x, y)| x >= left && y >= top)
            .map(|corner| self.at(corner))
            .find(|legend| !legend.covers(data))
    }

    /// Whether any of `data` lies under it, or close to it.
    pub fn covers(&self, data: &[(f64, f64)]) -> bool {
        let ((x, y), width, height) = (self.corner, self.width(), self.height());
        data.iter().any(|&(px, py)| {
            px > x - 4.0 && px < x + width + 4.0 && py > y - 4.0 && py < y + height + 4.0
        })
    }

    pub fn draw(&self, canvas: &mut Canvas) {
        let (x, y) = self.corner;
        let opposite = (x + self.width(), y + self.height());
        canvas.rectangle((x, y), opposite, Colour::WHITE);
        canvas.outline((x, y), opposite, 0.4, Colour::BLACK.faded(0.3));
        for (index, entry) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows(), index % self.rows());
            let left = x + column as f64 * self.column_width();
            entry.draw(canvas, left, y + 3.0 + STEP * (row as f64 + 0.5));
        }
    }
}

impl Entry {
    fn draw(&self, canvas: &mut Canvas, left: f64, middle: f64) {
        let Style {
            colour,
            marker,
            dash,
        } = self.style;
        let ends = [(left + 4.0, middle), (left + 22.0, middle)];
        match self.key {
            Key::Marker => {}
            Key::MarkedLine => canvas.line(&ends, LINE, colour),
            Key::Line => canvas.dashed(&ends, LINE, colour, dash),
            Key::Shade => {
                let corners = [(left + 4.0, middle - 3.5), (left + 22.0, middle + 3.5)];
                canvas.rectangle(corners[0], corners[1], colour);
                canvas.outline(corners[0], corners[1], 0.4, Colour::BLACK.faded(0.3));
            }
        }
        if matches!(self.key, Key::Marker | Key::MarkedLine) {
            canvas.marker(marker, (left + 13.0, middle), MARKER, colour);
        }
        let baseline = (left + 27.0, middle + 0.36 * SMALL);
        canvas.text(&self.text, baseline, SMALL, Align::Left);
    }
}
