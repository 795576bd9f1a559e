//! The vertical direction, and how it was found.

use super::axis::Axis;
use super::reading::GRAVITY;
use std::fmt;

/// The vertical direction, and how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertical {
    /// The direction.
    pub direction: Direction,
    /// How it was found.
    pub reason: Reason,
}

/// The direction along which the acceleration is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Direction {
    /// Along one column.
    Along {
        /// Its index in the table, from 0.
        column: usize,
        /// Its axis, if it has one.
        axis: Option<Axis>,
        /// −1 if it points down.
        sign: f64,
    },
    /// Along a direction between three columns.
    Projected {
        /// Their indices in the table, from 0.
        columns: [usize; 3],
        /// A vector of length 1.
        up: [f64; 3],
    },
}

/// How the vertical was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// Given by the user.
    Given,
    /// The only column.
    Only,
    /// The nearest to gravity, at this angle in degrees.
    Gravity(f64),
    /// The one with the ride, more than any other by this factor.
    Ride(f64),
    /// No axis stands out; z if there is one.
    NearTie,
}

impl Vertical {
    /// The opposite direction.
    pub(super) fn turned(mut self) -> Self {
        match &mut self.direction {
            Direction::Along { sign, .. } => *sign = -*sign,
            Direction::Projected { up, .. } => *up = up.map(|along| -along),
        }
        self
    }
}

impl fmt::Display for Vertical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.direction {
            Direction::Along { axis, sign, .. } => {
                let is_down = *sign < 0.0;
                match axis {
                    Some(axis) => write!(f, "{}{axis}", if is_down { "-" } else { "" })?,
                    None if is_down => f.write_str("that column upside down")?,
                    None => f.write_str("that column")?,
                }
            }
            Direction::Projected { up: [x, y, z], .. } => {
                write!(f, "({x:.3}, {y:.3}, {z:.3})")?;
            }
        }
        match self.reason {
            Reason::Given => f.write_str(" (as given)"),
            Reason::Only => f.write_str(" (the only one)"),
            Reason::Gravity(angle) => write!(f, " ({angle:.1} degrees from gravity)"),
            Reason::Ride(factor) => {
                let digits = if factor < 10.0 { 1 } else { 0 };
                write!(
                    f,
                    ", which carries the ride {factor:.digits$} times as strongly as any other axis"
                )
            }
            Reason::NearTie => f.write_str(", though no axis stands out"),
        }
    }
}

/// Whether a mean is gravity: 9.8 m/s² up to the bias of a poor sensor and the tilt of an axis.
pub(super) fn is_gravity(mean: f64) -> bool {
    (0.87 * GRAVITY..=1.13 * GRAVITY).contains(&mean.abs())
}
