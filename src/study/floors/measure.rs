//! What is asked of each building.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What is asked of each building.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A stop beside its floor: does it alarm at once, and judged again after the next trip? Do the ordinary stops
    /// before?
    Alarm,
    /// Ordinary stops: how many alarm, how many are taken for another floor?
    Stops,
    /// After so many trips: how far is the position from the truth, how far the map?
    Position,
    /// So many trips after one that was missed: is the floor right again?
    Healing,
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Measure {
    /// The keys that do not affect this measure.
    pub fn unused(self) -> &'static [&'static str] {
        match self {
            Self::Alarm => &["since"],
            Self::Stops | Self::Position => &["storeys", "next_storeys", "offset", "since"],
            Self::Healing => &["storeys", "next_storeys", "offset"],
        }
    }

    /// The keys in which points may differ that share the same building and the same trips.
    pub fn shared(self) -> &'static [&'static str] {
        match self {
            Self::Alarm => &["storeys", "next_storeys", "offset"],
            Self::Stops => &[],
            Self::Position => &["trips"],
            Self::Healing => &["since"],
        }
    }
}
