//! The legend: what the styles of a plot stand for.

use super::style::Style;

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
    /// Nothing: a further line of the entry before.
    None,
}

/// Where a legend goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A corner of a panel, or a free place in a grid, where it covers no data; above where there is none.
    Free,
    /// So many points left of the right edge of the first panel and below its upper edge; above where it
    /// would cover data.
    Inside(f64, f64),
    /// This corner of the first panel, whatever lies there.
    Corner { is_right: bool, is_low: bool },
    /// Above the panels.
    Above,
    /// Above the panels, as wide as a caption.
    Across,
}

impl Entry {
    /// Those of curves in the styles of their places.
    pub fn of_curves(
        names: impl IntoIterator<Item = String>,
        key: Key,
    ) -> impl Iterator<Item = Self> {
        let names = names.into_iter().enumerate();
        names.map(move |(index, name)| Self::new(name, Style::of(index), key))
    }

    pub fn new(text: impl Into<String>, style: Style, key: Key) -> Self {
        let text = text.into();
        Self { text, style, key }
    }
}
