//! A picture: panels with their axes, the marks in them, a legend and a caption.

use super::axis::Axis;
use super::legend::{Entry, Legend, Place};
use super::mark::Mark;
use super::text::{missing_glyphs, wrap};

/// Width of a sheet unless another is asked for, in points.
pub const WIDTH: f64 = 396.0;
/// Where a caption starts, and as far from the right edge it ends.
pub(super) const CAPTION_LEFT: f64 = 10.0;

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// From left to right in each row, from the uppermost row down.
    pub panels: Vec<Panel>,
    /// Of the sheet, in points.
    pub width: f64,
    /// Panels in a row.
    pub columns: usize,
    /// Whether words stand between the rows, though panels share what is along x.
    pub is_apart: bool,
    /// In the order in which they are drawn, each with the panel it lies in.
    pub marks: Vec<(usize, Mark)>,
    pub legend: Option<Legend>,
    /// Each of these begins on a line of its own, and is broken between its parts.
    pub caption: Vec<Vec<String>>,
    pub margins: Margins,
}

/// A pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Above it.
    pub title: String,
    /// In points.
    pub height: f64,
    pub x: Axis,
    /// A second scale along its upper edge.
    pub top: Option<Axis>,
    pub y: Axis,
}

/// Points left free around the panels: for labels, names, and what stands beside them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    /// Above the caption.
    pub bottom: f64,
    /// Above and below a legend that lies over the panels.
    pub legend: (f64, f64),
}

impl Default for Margins {
    fn default() -> Self {
        Self {
            left: 54.0,
            right: 16.0,
            top: 10.0,
            bottom: 36.0,
            legend: (4.0, 8.0),
        }
    }
}

impl Plot {
    /// Panels one under the other that share `x`, each `(height, y)`; only the lowest has words along x.
    pub fn stack(x: &Axis, panels: impl IntoIterator<Item = (f64, Axis)>) -> Self {
        let panels = panels.into_iter();
        let mut panels: Vec<Panel> = panels
            .map(|(height, y)| Panel::new(height, x.unlabelled(), y))
            .collect();
        if let Some(lowest) = panels.last_mut() {
            lowest.x = x.clone();
        }
        Self::of(panels, 1)
    }

    /// Panels in rows of so many.
    pub fn of(panels: Vec<Panel>, columns: usize) -> Self {
        let (marks, caption) = (Vec::new(), Vec::new());
        let (legend, margins) = (None, Margins::default());
        Self {
            panels,
            width: WIDTH,
            columns,
            is_apart: columns > 1,
            marks,
            legend,
            caption,
            margins,
        }
    }

    /// Draws `mark` next, in a panel.
    pub fn add(&mut self, panel: usize, mark: Mark) {
        self.marks.push((panel, mark));
    }

    /// Draws `mark` next, in every panel.
    pub fn add_to_all(&mut self, mark: &Mark) {
        for panel in 0..self.panels.len() {
            self.add(panel, mark.clone());
        }
    }

    /// Draws a legend next, wherever it finds room.
    pub fn add_legend(&mut self, entries: impl IntoIterator<Item = Entry>, place: Place) {
        self.add(0, Mark::Legend);
        let entries = entries.into_iter().collect();
        self.legend = Some(Legend { entries, place });
    }

    /// What the caption says, broken into lines between these parts.
    pub fn set_caption(&mut self, parts: &[String]) {
        self.caption = vec![parts.to_vec()];
    }

    /// The caption in lines.
    pub fn caption_lines(&self) -> Vec<String> {
        let width = self.width - 2.0 * CAPTION_LEFT;
        let parts = self.caption.iter();
        parts.flat_map(|parts| wrap(parts, width)).collect()
    }

    /// The characters in its words that the font has no sign for.
    pub(super) fn missing_glyphs(&self) -> Vec<char> {
        let axes = self
            .panels
            .iter()
            .flat_map(|panel| [Some(&panel.x), panel.top.as_ref(), Some(&panel.y)]);
        let axes = axes.flatten().flat_map(|axis| {
            let ticks = axis.ticks.iter().map(|(_, label)| label);
            ticks.chain([&axis.label])
        });
        let titles = self.panels.iter().map(|panel| &panel.title);
        let entries = self
            .legend
            .iter()
            .flat_map(|it| it.entries.iter().map(|entry| &entry.text));
        let words = axes
            .chain(titles)
            .chain(entries)
            .chain(self.caption.iter().flatten());
        missing_glyphs(words.map(String::as_str))
    }

    /// The marks of a panel.
    pub fn marks_of(&self, panel: usize) -> impl Iterator<Item = &Mark> {
        let here = self.marks.iter().filter(move |(index, _)| *index == panel);
        here.map(|(_, mark)| mark)
    }
}

impl Panel {
    /// Without title.
    pub fn new(height: f64, x: Axis, y: Axis) -> Self {
        let (title, top) = (String::new(), None);
        Self {
            title,
            height,
            x,
            top,
            y,
        }
    }

    pub fn titled(self, title: &str) -> Self {
        let title = title.to_owned();
        Self { title, ..self }
    }
}
