//! Which way is up, and how that is known.

use super::axis::Axis;
use super::reading::GRAVITY;
use std::fmt;

/// Which way is up, and how that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertical {
    /// Which way.
    pub direction: Direction,
    /// How that is known.
    pub reason: Reason,
}

/// The direction along which the acceleration is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Direction {
    /// Along one column.
    Along {
        /// Its place in the table, from 0.
        column: usize,
        /// Its axis, where it has one.
        axis: Option<Axis>,
        /// −1 where it points down.
        sign: f64,
    },
    /// Along a direction between three of them.
    Projected {
        /// Their places in the table, from 0.
        columns: [usize; 3],
        /// A vector of length 1.
        up: [f64; 3],
    },
}

/// How the vertical was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The reader said so.
    Given,
    /// There is no other.
    Only,
    /// It lies this near to gravity, in degrees.
    Gravity(f64),
    /// The ride is along it, more than along any other by this factor.
    Ride(f64),
    /// No axis stands out: z where there is one.
    NearTie,
}

impl Vertical {
    /// The same upside down.
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

/// Whether a mean is gravity: 9.8 m/s² but for the bias of a bad sensor, and the tilt of one axis.
pub(super) fn is_gravity(mean: f64) -> bool {
    (0.87 * GRAVITY..=1.13 * GRAVITY).contains(&mean.abs())
}
