//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One sample. Values are in the trace's unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Time in seconds.
    pub time: f64,
    /// `rest`, `acceleration`, `inertial` or `braking`.
    pub phase: String,
    /// The sensor's record.
    pub record: f64,
    /// The whitened record, if the trace is whitened.
    pub whitened: Option<f64>,
    /// `training`, `reference`, `shift` or `scale`; empty outside these.
    pub sample: Option<String>,
    /// The acceleration's contribution to the record.
    pub acceleration: f64,
    /// λ.
    pub impulse: f64,
}
