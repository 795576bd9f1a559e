//! The choice of the vertical axis.

use super::unknown_name::UnknownName;
use std::fmt;
use std::str::FromStr;

/// The vertical axis of a sensor.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Axis {
    /// The nearest to gravity; without gravity, the one with the ride.
    #[default]
    Auto,
    /// The axis x.
    X,
    /// The axis y.
    Y,
    /// The axis z, out of the screen of a phone.
    Z,
    /// None of them: the acceleration along the direction of gravity.
    Gravity,
}

impl Axis {
    /// The axes, in the order of all triples.
    pub(super) const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];
}

impl FromStr for Axis {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        match name.trim().to_lowercase().as_str() {
            "auto" => Ok(Self::Auto),
            "x" => Ok(Self::X),
            "y" => Ok(Self::Y),
            "z" => Ok(Self::Z),
            "gravity" => Ok(Self::Gravity),
            _ => Err(UnknownName::new("auto, x, y, z or gravity", name)),
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Gravity => "gravity",
        })
    }
}
