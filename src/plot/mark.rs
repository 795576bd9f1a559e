//! What is drawn in a panel, in its data.

use super::style::{Colour, Style};

/// Something in a panel. What lies outside its axes is drawn on their edge. Pairs of numbers are `(x, y)`,
/// or the ends of a stretch of x.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A pale line at each tick of y.
    Grid,
    /// The rectangle with its ticks, labels and title.
    Axes,
    /// The legend of the plot, wherever it found room.
    Legend,
    Line(Vec<(f64, f64)>, Style),
    /// A line so dense that its turns cannot be told apart.
    Dense(Vec<(f64, f64)>, Style),
    /// The intervals of all points as one area.
    Band(Vec<Point>, Style),
    /// The interval of each point as an upright bar.
    Bars(Vec<Point>, Style),
    /// A marker at each point; where a limit stands for it, an arrow.
    Markers(Vec<Point>, Style),
    /// The bar and the marker of each point in turn.
    Points(Vec<Point>, Style),
    /// A shade over the whole height.
    Span((f64, f64), Colour),
    /// Names of stretches, so many points (1/72 inch) above the panel. Of names that would run into each
    /// other the first is kept.
    Names(Vec<((f64, f64), String)>, f64),
    /// A line over the whole width, with its dash.
    Level(f64, &'static [f64]),
    /// A dashed upright line through all panels.
    Limit(f64),
    /// A bracket over the panel with a name on top.
    Bracket((f64, f64), &'static str),
    /// A thick line so many points below the upper edge.
    Bar((f64, f64), f64, Colour),
    /// Filled rectangles, each between two opposite corners.
    Cells(Vec<Cell>),
    /// Beside the panel under a title, what the colours of cells stand for.
    Shades(String, Vec<(Colour, String)>),
    Block(Block),
}

impl Mark {
    /// Its colours.
    pub(super) fn colours(&mut self) -> Vec<&mut Colour> {
        match self {
            Self::Line(_, style)
            | Self::Dense(_, style)
            | Self::Band(_, style)
            | Self::Bars(_, style)
            | Self::Markers(_, style)
            | Self::Points(_, style) => vec![&mut style.colour],
            Self::Span(_, colour) | Self::Bar(.., colour) => vec![colour],
            Self::Cells(cells) => cells.iter_mut().map(|cell| &mut cell.2).collect(),
            Self::Block(block) => block.colour.iter_mut().collect(),
            _ => Vec::new(),
        }
    }
}

/// An estimate with its interval; on a logarithmic scale, their logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub low: f64,
    pub high: f64,
    /// Stands for an estimate that has no logarithm.
    pub limit: Option<Limit>,
}

/// An end of an interval beyond which the truth does not lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    Upper,
    Lower,
}

/// A labelled stretch in the middle of a panel whose y runs from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    pub ends: (f64, f64),
    /// It begins before the panel.
    pub is_cut: bool,
    /// Without one there is no box.
    pub colour: Option<Colour>,
    /// Those for which there is no room are left out.
    pub lines: Vec<String>,
}

impl Point {
    /// Without interval.
    pub const fn at((x, y): (f64, f64)) -> Self {
        Self::new(x, [y, y, y])
    }

    /// An estimate between the ends of its interval.
    pub const fn new(x: f64, [low, y, high]: [f64; 3]) -> Self {
        let limit = None;
        Self {
            x,
            y,
            low,
            high,
            limit,
        }
    }

    pub const fn place(&self) -> (f64, f64) {
        (self.x, self.y)
    }

    /// Its logarithms: an estimate of zero has none, a limit stands for it.
    #[must_use]
    pub fn logarithms(self) -> Self {
        let low = libm::log10(self.low.max(f64::MIN_POSITIVE));
        let (y, high) = (libm::log10(self.shown()), libm::log10(self.high));
        Self {
            y,
            low,
            high,
            ..self
        }
    }

    /// What stands for it on a logarithmic scale.
    pub const fn shown(&self) -> f64 {
        match self.limit {
            Some(Limit::Upper) => self.high,
            Some(Limit::Lower) => self.low,
            None => self.y,
        }
    }
}

/// A filled rectangle between two opposite corners.
pub type Cell = ((f64, f64), (f64, f64), Colour);
