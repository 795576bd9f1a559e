//! `[height]`: which lifts are simulated, and how the weather changes.

use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::study::outcomes::ascending;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Simulated lifts whose height is known, followed by accelerometer and barometer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// How many trips each lift makes.
    pub trips: usize,
    /// How fast the weather changes the pressure, hPa an hour, in ascending order.
    pub drift: Vec<f64>,
}

/// A lift under a weather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub trips: usize,
    pub drift: f64,
}

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a number breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(2.0, 1000.0, "trips").check("height.trips", &self.trips)?;
        let drift = Rule::Within(0.0, 20.0, "hPa an hour");
        ascending("height.drift", "drifts", drift, &self.drift)
    }

    pub fn grid(&self) -> Vec<Point> {
        let trips = self.trips;
        let points = self.drift.iter().map(|&drift| Point { trips, drift });
        points.collect()
    }
}

impl Point {
    /// Every parameter of a point.
    pub fn identity(&self) -> Identity {
        self.recorded().with("drift", self.drift)
    }

    /// Those of the lift.
    pub fn recorded(&self) -> Identity {
        Identity::new([("trips", self.trips.to_string())])
    }
}
