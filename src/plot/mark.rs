//! What is drawn in a panel, in its data.

use super::{Colour, Marker, Style};

/// Something in a panel. What lies outside its axes is drawn on their edge.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A pale line at each tick of y.
    Grid,
    /// The rectangle with its ticks, labels and title.
    Axes,
    /// The legend of the plot, wherever it found room.
    Legend,
    Line {
        points: Vec<(f64, f64)>,
        width: f64,
        style: Style,
    },
    /// A line so dense that its turns cannot be told apart.
    Dense {
        points: Vec<(f64, f64)>,
        colour: Colour,
    },
    /// What lies between two lines, each point `(x, low, high)`.
    Band {
        points: Vec<(f64, f64, f64)>,
        colour: Colour,
    },
    /// Upright bars, each `(x, low, high)`.
    Bars {
        bars: Vec<(f64, f64, f64)>,
        width: f64,
        colour: Colour,
    },
    /// Markers, each over the bar of its interval.
    Points {
        points: Vec<Point>,
        /// Half the width of a marker.
        size: f64,
        /// The width of a bar.
        width: f64,
        style: Style,
    },
    /// A shade over the whole height.
    Span { from: f64, to: f64, colour: Colour },
    /// Names of stretches `(from, to, name)`, so many points above the panel. Of names that would run into
    /// each other the first is kept.
    Names {
        names: Vec<(f64, f64, String)>,
        above: f64,
    },
    /// A line over the whole width.
    Level { y: f64, dash: &'static [f64] },
    /// A dashed upright line through all panels.
    Limit { x: f64 },
    /// A bracket over the panel with a name on top.
    Bracket { from: f64, to: f64, name: String },
    /// A short bar just below the upper edge of the panel, so many points under it.
    Bar {
        from: f64,
        to: f64,
        below: f64,
        colour: Colour,
    },
    /// Filled rectangles.
    Cells(Vec<Cell>),
    /// Beside the panel, what the colours of cells stand for.
    Shades {
        title: String,
        shades: Vec<(Colour, String)>,
    },
    /// A labelled stretch in the middle of a panel that has no scale of y; lines for which it is too narrow
    /// are left out.
    Block {
        from: f64,
        to: f64,
        /// It goes on before the panel.
        is_cut: bool,
        /// No colour, no box.
        colour: Option<Colour>,
        lines: Vec<String>,
    },
}

/// A marker, and the interval behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub bar: Option<(f64, f64)>,
    /// Instead of the marker of its curve.
    pub arrow: Option<Marker>,
}

/// A filled rectangle between two opposite corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    pub corner: (f64, f64),
    pub opposite: (f64, f64),
    pub colour: Colour,
}

impl Point {
    /// Without interval.
    pub const fn at(x: f64, y: f64) -> Self {
        Self {
            x,
            y,
            bar: None,
            arrow: None,
        }
    }
}

impl Mark {
    /// A line through `points`.
    pub fn line(points: impl IntoIterator<Item = (f64, f64)>, width: f64, style: Style) -> Self {
        let points = points.into_iter().collect();
        Self::Line {
            points,
            width,
            style,
        }
    }
}
