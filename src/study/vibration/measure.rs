//! What is asked of each lift.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What is asked of each lift.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A baseline is learnt until a rule stops: how far off is its mean, and how many windows and trips of 100 ordinary ones
    /// are above its guard line?
    Baseline,
    /// After that a trip with a knock at a joint of the rails: is it found, and where?
    Knock,
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
            Self::Baseline => &["size"],
            Self::Knock => &[],
        }
    }

    /// The keys in which points may differ that share a lift and its trips.
    pub const SHARED: [&'static str; 5] = ["stop", "trips", "guard", "alarm_rate", "size"];
}
