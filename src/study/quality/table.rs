//! `[quality]`: which rides are simulated.

use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::study::trips::Condition;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Simulated rides whose quality is known, judged from their records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// How much the car shakes at full speed, m/s²: the deviation in each direction, in ascending order.
    pub vibration: Vec<f64>,
    /// By which drive and sensor, each with every vibration.
    pub condition: Vec<Condition>,
}

/// A vibration under a condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub condition: Condition,
    pub vibration: f64,
}

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a vibration breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        if self.condition.is_empty() || self.vibration.is_empty() {
            let rule = "name a condition and a vibration";
            return Err(OutOfRange::new("quality", rule, "none"));
        }
        for vibration in &self.vibration {
            Rule::Within(0.0, 1.0, "m/s²").check("quality.vibration", vibration)?;
        }
        if let Some(pair) = self.vibration.windows(2).find(|pair| pair[0] >= pair[1]) {
            let got = format!("{} before {}", pair[0], pair[1]);
            let rule = "name vibrations in ascending order";
            return Err(OutOfRange::new("quality.vibration", rule, got));
        }
        Condition::check_once("quality.condition", &self.condition)
    }

    /// Condition by condition.
    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.condition.iter().flat_map(|&condition| {
            let vibrations = self.vibration.iter();
            vibrations.map(move |&vibration| Point {
                condition,
                vibration,
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
            ("vibration", self.vibration.to_string()),
        ])
    }
}
