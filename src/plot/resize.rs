//! A plot on a sheet of another width: the layout changes, the type stays as large as it is.

use super::legend::{Entry, Key, Legend, Place};
use super::picture::{CAPTION_LEFT, Panel, Plot};
use super::placed::BESIDE_TEXT;
use super::text::{NORMAL, SMALL, text_width};

/// Narrower sheets have one column of panels, points.
const TWO_COLUMNS: f64 = 340.0;

/// Widths that differ by less are one, points: millimetres are given with few digits.
const SAME: f64 = 0.2;

impl Plot {
    /// The same on a sheet so many points wide: with panels one under the other if it is narrow, and longer texts in
    /// several lines.
    pub fn resized(mut self, width: f64) -> Self {
        let is_other = (width - self.width).abs() > SAME;
        self.width = (width * 100.0).round() / 100.0;
        if width < TWO_COLUMNS && self.columns > 1 {
            self.stack_rows();
        }
        let room = width - 2.0 * CAPTION_LEFT;
        // Words stand about the middle of their panel.
        let middle = f64::midpoint(self.margins.left, width - self.margins.right);
        let about_middle = match self.columns {
            1 => 2.0 * middle.min(width - middle) - CAPTION_LEFT,
            columns => room / columns as f64,
        };
        for Panel { title, x, top, .. } in &mut self.panels {
            let labels = top.as_mut().map(|top| &mut top.label);
            for text in [title, &mut x.label].into_iter().chain(labels) {
                *text = lines(text, NORMAL, about_middle).join("\n");
            }
        }
        if let Some(legend) = &mut self.legend {
            if let Place::Inside(..) = legend.place
                && is_other
            {
                legend.place = Place::Free;
            }
            let room = match legend.place {
                Place::Across => room,
                _ => width - self.margins.left - self.margins.right,
            };
            legend.wrap(room - BESIDE_TEXT);
        }
        self
    }
}

impl Plot {
    /// Puts the panels of each row one under the other. What those of a row or a column shared, each says itself.
    fn stack_rows(&mut self) {
        for index in 0..self.panels.len() {
            if index % self.columns > 0 && self.panels[index].y.label.is_empty() {
                self.panels[index].y = self.panels[index - 1].y.clone();
            }
        }
        let last = self.panels.len() - 1;
        for panel in &mut self.panels[..last] {
            panel.x.label.clear();
        }
        self.columns = 1;
    }
}

impl Legend {
    /// Breaks texts that are wider into several entries, of which only the first has a key.
    fn wrap(&mut self, width: f64) {
        let entries = self.entries.iter().flat_map(|entry| {
            let lines = lines(&entry.text, SMALL, width).into_iter().enumerate();
            lines.map(|(number, text)| Entry {
                text,
                key: if number == 0 { entry.key } else { Key::None },
                ..entry.clone()
            })
        });
        self.entries = entries.collect();
    }
}

/// A text in lines no wider than `width` where its words allow.
fn lines(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), size) <= width => {
                *line += &format!(" {word}");
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
