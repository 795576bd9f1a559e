//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One row of `points.csv`: the operating point of one size and power.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// N = M₁ = M₂.
    pub all_samples: usize,
    /// α.
    pub alpha: f64,
    /// The exact size of the region.
    pub size: f64,
    /// The wanted power.
    pub power: f64,
    /// Δ/σ_ξ. The start of the search if the power is already reached there; none if it is never reached.
    pub delta: Option<f64>,
    /// The lower end of its interval; none if the interval is open below.
    pub low: Option<f64>,
    /// The upper end of its interval; none if the interval is open above.
    pub high: Option<f64>,
    /// Trials at each Δ.
    pub trials: u64,
    /// Confidence of the interval.
    pub confidence: f64,
}
