//! What a recording consists of.

use serde::{Deserialize, Serialize};

/// One reading of the vertical axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// s, by the file's clock.
    pub time: f64,
    /// m/s², up positive; bias and any gravity are left in.
    pub acceleration: f64,
}

/// The readings of these times, each times its sign, without those that are not there.
pub(super) fn series(times: &[f64], readings: Vec<f64>, sign: f64) -> Vec<Sample> {
    let readings = times.iter().zip(readings);
    let readings = readings.filter(|(_, reading)| !reading.is_nan());
    let samples = readings.map(|(&time, reading)| Sample {
        time,
        acceleration: sign * reading,
    });
    samples.collect()
}
