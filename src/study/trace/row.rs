//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One sample. Values are in the trace's unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// In seconds.
    pub time: f64,
    /// `rest`, `acceleration`, `inertial` or `braking`.
    pub phase: String,
    /// What the sensor writes down.
    pub record: f64,
    /// The same whitened, where it is.
    pub whitened: Option<f64>,
    /// `training`, `reference`, `shift`, `scale`, or nothing.
    pub sample: Option<String>,
    /// What is added to the noise for the acceleration.
    pub acceleration: f64,
    /// λ.
    pub impulse: f64,
}
