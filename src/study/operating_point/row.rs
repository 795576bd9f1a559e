//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One row of `points.csv`: the operating point of one size and power.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// N = M₁ = M₂.
    pub all_samples: usize,
    /// α.
    pub alpha: f64,
    /// Of the region.
    pub size: f64,
    /// The wanted power.
    pub power: f64,
    /// Δ/σ_ξ, or the start of the search where the power is reached already; none where it never is.
    pub delta: Option<f64>,
    /// Of its interval; none where that is open below.
    pub low: Option<f64>,
    /// Of its interval; none where that is open above.
    pub high: Option<f64>,
    /// At every Δ.
    pub trials: u64,
    /// Of the interval.
    pub confidence: f64,
}
