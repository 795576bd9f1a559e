//! One row of `points.csv`: an outcome of a class.

use super::table::Table;
use crate::lift::Class;
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use serde::{Deserialize, Serialize};

/// An outcome of a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub class: Class,
    pub outcome: String,
    /// How often the event happened.
    pub count: u64,
    /// The number of cases, or the time, in which it could happen.
    pub exposure: f64,
    /// Unit of the exposure.
    pub unit: String,
    /// The rate of the event, or the quantile.
    pub estimate: f64,
    pub low: f64,
    pub high: f64,
    pub trials: u64,
    pub confidence: f64,
    pub watch: String,
    pub tolerance: f64,
}

impl Row {
    pub(super) fn new(class: Class, estimate: Estimate, table: &Table, context: &Context) -> Self {
        let estimate = estimate.rounded();
        Self {
            class,
            outcome: estimate.outcome,
            count: estimate.count,
            exposure: estimate.exposure,
            unit: estimate.unit.to_owned(),
            estimate: estimate.value,
            low: estimate.low,
            high: estimate.high,
            trials: context.trials,
            confidence: context.confidence,
            watch: table.watch.to_string(),
            tolerance: table.tolerance.get(),
        }
    }
}
