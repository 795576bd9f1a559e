//! `[trips]`: which trips are simulated.

use super::condition::Condition;
use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Simulated trips of known length, measured in every way there is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The lengths of the trips, m, in ascending order.
    pub distance: Vec<f64>,
    /// Under which conditions, each with every length.
    pub condition: Vec<Condition>,
}

/// A length under a condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub condition: Condition,
    pub distance: f64,
}

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a length breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let refuse = |key, rule, got: String| Err(OutOfRange::new(key, rule, got));
        if self.condition.is_empty() || self.distance.is_empty() {
            return refuse("trips", "name a condition and a distance", "none".into());
        }
        for distance in &self.distance {
            Rule::Within(1.0, 200.0, "m").check("trips.distance", distance)?;
        }
        if let Some(pair) = self.distance.windows(2).find(|pair| pair[0] >= pair[1]) {
            let got = format!("{} before {}", pair[0], pair[1]);
            return refuse("trips.distance", "name lengths in ascending order", got);
        }
        Condition::check_once("trips.condition", &self.condition)
    }

    /// Condition by condition.
    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.condition.iter().flat_map(|&condition| {
            let distances = self.distance.iter();
            distances.map(move |&distance| Point {
                condition,
                distance,
            })
        })
    }
}

impl Point {
    /// Every parameter of a point.
    pub fn identity(&self) -> Identity {
        let numbers = format!("{:?}", self.condition.numbers());
        Identity::new([
            ("condition", self.condition.to_string()),
            ("numbers", numbers),
            ("distance", self.distance.to_string()),
        ])
    }
}
