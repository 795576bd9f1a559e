//! The columns of `points.csv`.

use super::building::Traffic;
use super::keys::JudgingRule;
use super::table::{Point, Table};
use crate::study::outcomes::outcome_row;
use crate::track::floors::Association;

outcome_row! {
    curve: usize,
    label: String,
    axis: String,
    x: f64,
    ..
    measure: String,
    floors: usize,
    storey: f64,
    uneven: f64,
    level: f64,
    noise: f64,
    traffic: Traffic,
    trips: usize,
    storeys: usize,
    next_storeys: usize,
    offset: f64,
    since: usize,
    vague: f64,
    rule: JudgingRule,
    threshold: f64,
    association: Association,
    window: usize,
}

impl Columns {
    /// Those of a point.
    pub fn of(table: &Table, point: &Point) -> Self {
        let keys = point.keys.clone();
        let settings = keys.settings();
        Self {
            curve: point.curve + 1,
            label: table.labels[point.curve].clone(),
            axis: table.axis.clone(),
            x: point.x,
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
