//! `[phases]`: which trips are simulated, and how they are followed.

use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::study::trips::{Condition, Grid, Numbers};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Simulated trips, followed by the published filter with several thresholds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// What is drawn.
    pub measure: Measure,
    /// The length of a trip, m.
    pub distance: f64,
    /// By which drive and sensor.
    pub condition: Vec<Condition>,
    /// How much the motion shakes the sensor at full speed, m/s², in ascending order, each with every condition.
    pub vibration: Vec<f64>,
    /// Readings below this are of a cage that neither speeds up nor brakes, m/s², in ascending order, each with every
    /// vibration.
    pub threshold: Vec<f64>,
}

/// What is drawn of trips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// The error of the distance.
    Spacing,
    /// The time whose phase is wrong.
    Phases,
}

/// Trips under a condition, and how they are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    distance: f64,
    pub condition: Condition,
    pub vibration: f64,
    pub threshold: f64,
}

const SHAKEN: Grid = Grid {
    table: "phases",
    key: "vibration",
    values: "vibrations",
    rule: Rule::Within(0.0, 1.0, "m/s²"),
};

const FOLLOWED: Grid = Grid {
    table: "phases",
    key: "threshold",
    values: "thresholds",
    rule: Rule::Within(0.01, 1.0, "m/s²"),
};

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a number breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(2.0, 200.0, "m").check("phases.distance", &self.distance)?;
        SHAKEN.check(&self.condition, &self.vibration)?;
        FOLLOWED.check(&self.condition, &self.threshold)
    }

    /// Condition by condition, vibration by vibration.
    pub fn grid(&self) -> Vec<Point> {
        let shaken = Grid::points(&self.condition, &self.vibration);
        let each = shaken.into_iter().flat_map(|(condition, vibration)| {
            self.threshold.iter().map(move |threshold| Point {
                distance: self.distance,
                condition,
                vibration,
                threshold: *threshold,
            })
        });
        each.collect()
    }
}

impl Point {
    /// Every parameter of a point.
    pub fn identity(&self) -> Identity {
        self.recorded().with("threshold", self.threshold)
    }

    /// Those of the record.
    pub fn recorded(&self) -> Identity {
        SHAKEN
            .identity(self.condition, self.vibration)
            .with("distance", self.distance)
    }

    /// Of the trip and its sensor; up is positive.
    pub fn numbers(&self) -> (Numbers, f64) {
        let numbers = self.condition.numbers();
        let shaken = self.vibration / numbers.sigma();
        (Numbers { shaken, ..numbers }, self.distance)
    }
}
