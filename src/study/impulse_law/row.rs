//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// One ν at one sample. Each law has its exact value, the number of trials in which the event occurred,
/// and the exact interval of its probability.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns of three laws are alike")]
pub struct Row {
    pub nu: f64,
    pub sample: usize,
    pub trials: u64,
    pub zero_sum: f64,
    pub zero_sum_count: u64,
    pub zero_sum_rate: f64,
    pub zero_sum_low: f64,
    pub zero_sum_high: f64,
    pub positive: f64,
    pub positive_count: u64,
    pub positive_rate: f64,
    pub positive_low: f64,
    pub positive_high: f64,
    pub none: f64,
    pub none_count: u64,
    pub none_rate: f64,
    pub none_low: f64,
    pub none_high: f64,
}
