//! One row of `points.csv`: an outcome of a way to measure trips.

use super::condition::Condition;
use super::table::Point;
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use serde::{Deserialize, Serialize};

/// An outcome of a way to measure trips of one length under one condition.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub condition: Condition,
    /// m.
    pub distance: f64,
    pub outcome: String,
    /// How often the event happened.
    pub count: u64,
    /// The number of cases in which it could happen.
    pub exposure: f64,
    /// Unit of the exposure.
    pub unit: String,
    /// The rate of the event, the mean, or the quantile.
    pub estimate: f64,
    pub low: f64,
    pub high: f64,
    pub trials: u64,
    pub confidence: f64,
}

impl Row {
    pub(super) fn new(point: Point, estimate: Estimate, context: &Context) -> Self {
        let estimate = estimate.rounded();
        Self {
            condition: point.condition,
            distance: point.distance,
            outcome: estimate.outcome,
            count: estimate.count,
            exposure: estimate.exposure,
            unit: estimate.unit.to_owned(),
            estimate: estimate.value,
            low: estimate.low,
            high: estimate.high,
            trials: context.trials,
            confidence: context.confidence,
        }
    }
}
