//! `[air]`: in which air lifts are simulated, and the columns of `points.csv`.

use crate::rule::{OutOfRange, Rule};
use crate::study::outcomes::{ascending, outcome_row};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Simulated lifts whose trips are known, measured by a barometer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// How many trips each lift makes.
    pub trips: usize,
    /// The temperature of the air, °C, in ascending order.
    pub temperature: Vec<f64>,
    /// Its pressure at the first floor, hPa, in ascending order, each with every temperature.
    pub pressure: Vec<f64>,
}

/// The air of a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub temperature: f64,
    pub pressure: f64,
}

outcome_row! {
    |point: &Point|
    temperature: f64 = point.temperature;
    pressure: f64 = point.pressure;
    ..
}

impl Table {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a number breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(1.0, 1000.0, "trips").check("air.trips", &self.trips)?;
        let celsius = Rule::Within(-60.0, 60.0, "°C");
        ascending(
            "air.temperature",
            "temperatures",
            celsius,
            &self.temperature,
        )?;
        let pressure = Rule::Within(500.0, 1200.0, "hPa");
        ascending("air.pressure", "pressures", pressure, &self.pressure)
    }

    /// Pressure by pressure.
    pub fn grid(&self) -> Vec<Point> {
        let each = self.pressure.iter().flat_map(|&pressure| {
            self.temperature.iter().map(move |&temperature| Point {
                temperature,
                pressure,
            })
        });
        each.collect()
    }
}
