//! What a study measures on rides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What is asked of each trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A ride: are its trips found, and how late?
    Rides,
    /// A rest: how often does it look like motion?
    Rest,
    /// A ride and a rest: what does finding soon cost?
    Tradeoff,
    /// A ride whose last trip jams: does it alarm, and how late?
    Jam,
    /// A ride that the monitor sees from somewhere in its first uniform motion on: does it take that for
    /// rest, and when does it know better?
    SwitchedOn,
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Measure {
    /// Whether the trial has trips.
    pub fn rides(self) -> bool {
        self != Self::Rest
    }

    /// Whether the trial has a rest of a given length.
    pub fn rests(self) -> bool {
        matches!(self, Self::Rest | Self::Tradeoff)
    }

    /// The keys that do not affect this measure.
    pub fn unused(self) -> &'static [&'static str] {
        match self {
            Self::Rides | Self::SwitchedOn => &["length", "jam_within"],
            Self::Rest => &[
                "distance",
                "speed",
                "jerk",
                "trips",
                "rest",
                "jam_within",
                "tolerance",
                "vibration",
                "nu",
                "theta",
            ],
            Self::Tradeoff => &["jam_within"],
            Self::Jam => &["length"],
        }
    }
}
