//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One lag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// k, in samples.
    pub lag: usize,
    /// ρ_k by the coefficients of the config's sensor.
    pub theory: f64,
    /// ρ_k by the coefficients that follow from (1).
    pub exact_transfer: f64,
    /// Mean of the records' estimates.
    pub estimate: f64,
    /// The lower end of its interval.
    pub low: f64,
    /// The upper end of its interval.
    pub high: f64,
}
