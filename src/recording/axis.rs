//! The choice of the vertical axis.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The vertical axis of a sensor.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Serialize, Deserialize)]
pub enum Axis {
    /// Along gravity; without gravity, along the pulses of the ride.
    #[default]
    Auto,
    /// Along gravity, which must be in the record.
    Gravity,
    /// One axis: 0 is x, 1 y, 2 z.
    Along {
        /// Its place among x, y, z.
        index: usize,
        /// Whether the axis points down.
        is_down: bool,
    },
}

/// The names of the three axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

impl FromStr for Axis {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let name = name.trim().to_lowercase();
        let along = name.trim_start_matches(['-', '+']);
        let is_down = name.starts_with('-');
        match (&*name, AXES.iter().position(|axis| *axis == along)) {
            ("auto", _) => Ok(Self::Auto),
            ("gravity", _) => Ok(Self::Gravity),
            (_, Some(index)) if name.len() <= 2 => Ok(Self::Along { index, is_down }),
            _ => Err(UnknownName::new(
                "auto, x, y, z, -x, -y, -z or gravity",
                &name,
            )),
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Gravity => f.write_str("gravity"),
            Self::Along { index, is_down } => {
                write!(f, "{}{}", if *is_down { "-" } else { "" }, AXES[*index])
            }
        }
    }
}

/// A name that is not one of several known ones.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
#[error("must be {known}, got \"{got}\"")]
pub struct UnknownName {
    known: &'static str,
    got: String,
}

impl UnknownName {
    pub(super) fn new(known: &'static str, got: &str) -> Self {
        let got = got.to_owned();
        Self { known, got }
    }
}
