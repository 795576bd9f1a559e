//! The air between two pressures, by its temperature.

use crate::recording::{GRAVITY, Pressure};
use libm::log;
use serde::Serialize;
use std::fmt;

/// The gas constant of dry air, J/(kg K).
const DRY_AIR: f64 = 287.05;

/// 0 °C, K.
pub(super) const FREEZING: f64 = 273.15;

/// The air of a building where nothing is known of it, and its deviation, K.
pub(super) const INDOORS: (f64, f64) = (FREEZING + 20.0, 10.0);

/// The temperature of the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Air {
    /// °C
    pub celsius: f64,
    /// Its standard deviation, K; 0 if it is given.
    pub deviation: f64,
    /// The number of trips that it is learnt from.
    pub learnt: usize,
}

impl fmt::Display for Air {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1} ± {:.1} °C, ", self.celsius, self.deviation)?;
        match self.learnt {
            0 if self.deviation == 0.0 => f.write_str("as given"),
            0 => f.write_str("not learnt: as usual indoors"),
            1 => f.write_str("learnt from 1 ride and what is usual indoors"),
            rides => write!(f, "learnt from {rides} rides and what is usual indoors"),
        }
    }
}

/// The temperature of the air, K, as given, °C, or as usual.
pub(super) fn kelvin(celsius: Option<f64>) -> f64 {
    celsius.map_or(INDOORS.0, |it| it + FREEZING)
}

/// The height of each reading above the first, m, at its time, s.
pub(super) fn above_first(readings: &[Pressure], kelvin: f64) -> Vec<(f64, f64)> {
    let above = |it: &Pressure| metres(log(readings[0].pascal / it.pascal), kelvin);
    readings.iter().map(|it| (it.time, above(it))).collect()
}

/// The height of the air between pressures of which this is the logarithm of the ratio, m.
pub(super) fn metres(log_ratio: f64, kelvin: f64) -> f64 {
    DRY_AIR * kelvin / GRAVITY * log_ratio
}
