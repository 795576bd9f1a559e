//! The legend: in a corner that covers no data, or above the plot where there is none.

use super::FigureError;
use super::frame::{Frame, SMALL};
use super::look::Look;
use super::sheet::Sheet;
use super::text::{Align, Style, text_width};
use plotters::prelude::{BLACK, Color, DrawingBackend, WHITE};

const STEP: f64 = 11.5;
const MARGIN: f64 = 6.0;
const MARKER: f64 = 2.3;
const LINE: f64 = 1.1;

/// The entries of a legend.
pub(super) struct Legend {
    pub entries: Vec<Entry>,
    columns: usize,
}

/// What a look stands for.
pub(super) struct Entry {
    pub text: String,
    pub look: Look,
    pub key: Key,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Marker,
    MarkedLine,
    Line,
    Shade,
}

impl Legend {
    /// In one column.
    pub fn new(entries: Vec<Entry>) -> Self {
        Self {
            entries,
            columns: 1,
        }
    }

    /// What it takes from left to right.
    pub fn width(&self) -> f64 {
        self.columns as f64 * self.column_width()
    }

    fn column_width(&self) -> f64 {
        let widths = (self.entries.iter()).map(|entry| text_width(&entry.text, SMALL));
        widths.fold(0.0, f64::max) + 32.0
    }

    /// What it takes from the top to bottom.
    pub fn height(&self) -> f64 {
        STEP * self.rows() as f64 + 6.0
    }

    fn rows(&self) -> usize {
        self.entries.len().div_ceil(self.columns)
    }

    /// The same in as many columns as `width` has room for, filled evenly.
    pub fn spread(self, width: f64) -> Self {
        let most = ((width / self.column_width()) as usize).clamp(1, self.entries.len().max(1));
        let rows = self.entries.len().div_ceil(most);
        Self {
            columns: self.entries.len().div_ceil(rows.max(1)).max(1),
            ..self
        }
    }

    /// The corner of `frame` where it covers nothing of `data`, points on the sheet.
    pub fn free_corner(&self, frame: &Frame, data: &[(f64, f64)]) -> Option<(f64, f64)> {
        let (width, height) = (self.width(), self.height());
        let (left, right) = (frame.left + MARGIN, frame.right - MARGIN - width);
        let (top, bottom) = (frame.top + MARGIN, frame.bottom - MARGIN - height);
        let is_free = |&(x, y): &(f64, f64)| {
            let near = |&(px, py): &(f64, f64)| {
                px > x - 4.0 && px < x + width + 4.0 && py > y - 4.0 && py < y + height + 4.0
            };
            x >= left && y >= top && !data.iter().any(near)
        };
        let corners = [(right, bottom), (left, top), (right, top), (left, bottom)];
        corners.into_iter().find(is_free)
    }

    /// Draws it with its upper left corner at (`x`, `y`).
    pub fn draw<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        (x, y): (f64, f64),
    ) -> Result<(), FigureError> {
        let (width, height) = (self.width(), self.height());
        let opposite = (x + width, y + height);
        sheet.rectangle((x, y), opposite, WHITE.to_rgba())?;
        sheet.outline((x, y), opposite, 0.4, BLACK.mix(0.3))?;
        for (index, Entry { text, look, key }) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows(), index % self.rows());
            let x = x + column as f64 * self.column_width();
            let middle = y + 3.0 + STEP * (row as f64 + 0.5);
            let ends = [(x + 4.0, middle), (x + 22.0, middle)];
            let colour = look.colour.to_rgba();
            match key {
                Key::Marker => {}
                Key::MarkedLine => sheet.line(&ends, LINE, colour)?,
                Key::Line => sheet.dashed(&ends, LINE, colour, look.dash)?,
                Key::Shade => {
                    let corners = [(x + 4.0, middle - 3.5), (x + 22.0, middle + 3.5)];
                    sheet.rectangle(corners[0], corners[1], colour)?;
                    sheet.outline(corners[0], corners[1], 0.4, BLACK.mix(0.3))?;
                }
            }
            if matches!(key, Key::Marker | Key::MarkedLine) {
                sheet.marker(look.marker, (x + 13.0, middle), MARKER, look.colour)?;
            }
            let baseline = (x + 27.0, middle + 0.36 * SMALL);
            sheet.text(text, baseline, Style::plain(SMALL, Align::Left))?;
        }
        Ok(())
    }
}
