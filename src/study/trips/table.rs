//! `[trips]`: which trips are simulated.

use super::condition::{Condition, Grid};
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

const GRID: Grid = Grid {
    table: "trips",
    key: "distance",
    values: "lengths",
    rule: Rule::Within(1.0, 200.0, "m"),
};

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a distance breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        GRID.check(&self.condition, &self.distance)
    }

    /// Condition by condition.
    pub fn grid(&self) -> Vec<Point> {
        let points = Grid::points(&self.condition, &self.distance).into_iter();
        let point = |(condition, distance)| Point {
            condition,
            distance,
        };
        points.map(point).collect()
    }
}

impl Point {
    /// Every parameter of a point.
    pub fn identity(&self) -> Identity {
        GRID.identity(self.condition, self.distance)
    }
}
