//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One rule at one T: W ≤ lower or W ≥ upper decides H₁.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The rule, as in a config.
    pub rule: String,
    /// P(ϑ | H₀), exact.
    pub size: f64,
    /// T.
    pub exceedances: usize,
    /// Absent if no small W decides H₁.
    pub lower: Option<u64>,
    /// Absent if no large W decides H₁.
    pub upper: Option<u64>,
}
