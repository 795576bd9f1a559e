//! One row of `points.csv`: an outcome at a point.

use super::building::Traffic;
use super::keys::JudgingRule;
use super::table::{Point, Table};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::track::floors::Association;
use serde::{Deserialize, Serialize};

/// An outcome at a point, and the parameters of the point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub curve: usize,
    pub label: String,
    /// The key that is swept.
    pub axis: String,
    /// The value of the swept key.
    pub x: f64,
    pub outcome: String,
    /// How often the event happened.
    pub count: u64,
    /// The number of cases in which it could happen.
    pub exposure: f64,
    /// Unit of the exposure.
    pub unit: String,
    /// The rate of the event, or the root mean square in m.
    pub estimate: f64,
    pub low: f64,
    pub high: f64,
    pub trials: u64,
    pub confidence: f64,
    pub measure: String,
    pub floors: usize,
    pub storey: f64,
    pub uneven: f64,
    pub level: f64,
    pub noise: f64,
    pub traffic: Traffic,
    pub trips: usize,
    pub storeys: usize,
    pub next_storeys: usize,
    pub offset: f64,
    pub since: usize,
    pub vague: f64,
    pub rule: JudgingRule,
    pub threshold: f64,
    pub association: Association,
    pub window: usize,
}

impl Row {
    pub(super) fn new(table: &Table, point: &Point, estimate: Estimate, context: &Context) -> Self {
        let keys = point.keys.clone();
        let settings = keys.settings();
        let estimate = estimate.rounded();
        Self {
            curve: point.curve + 1,
            label: table.labels[point.curve].clone(),
            axis: table.axis.clone(),
            x: point.x,
            outcome: estimate.outcome,
            count: estimate.count,
            exposure: estimate.exposure,
            unit: estimate.unit.to_owned(),
            estimate: estimate.value,
            low: estimate.low,
            high: estimate.high,
            trials: context.trials,
            confidence: context.confidence,
            measure: table.measure.to_string(),
            floors: keys.floors,
            storey: keys.storey,
            uneven: keys.uneven,
            level: keys.level,
            noise: keys.noise,
            traffic: keys.traffic,
            trips: keys.trips,
            storeys: keys.storeys,
            next_storeys: keys.next_storeys,
            offset: keys.offset,
            since: keys.since,
            vague: keys.vague,
            rule: keys.rule,
            threshold: settings.threshold,
            association: settings.association,
            window: settings.window,
        }
    }
}
