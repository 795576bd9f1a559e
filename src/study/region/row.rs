//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One rule at one T: W ≤ lower or W ≥ upper decides H₁.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// As in a config.
    pub rule: String,
    /// P(ϑ | H₀), exact.
    pub size: f64,
    /// T.
    pub exceedances: usize,
    /// Absent where no small W decides.
    pub lower: Option<u64>,
    /// Absent where no large W decides.
    pub upper: Option<u64>,
}
