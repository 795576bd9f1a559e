//! `[quality]`: which rides are simulated.

use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::study::trips::{Condition, Grid};
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

const GRID: Grid = Grid {
    table: "quality",
    key: "vibration",
    values: "vibrations",
    rule: Rule::Within(0.0, 1.0, "m/s²"),
};

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a vibration breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        GRID.check(&self.condition, &self.vibration)
    }

    /// Condition by condition.
    pub fn grid(&self) -> Vec<Point> {
        let points = Grid::points(&self.condition, &self.vibration).into_iter();
        let point = |(condition, vibration)| Point {
            condition,
            vibration,
        };
        points.map(point).collect()
    }
}

impl Point {
    /// Every parameter of a point.
    pub fn identity(&self) -> Identity {
        GRID.identity(self.condition, self.vibration)
    }
}
