//! The columns of `points.csv`.

use super::building::Traffic;
use super::keys::{JudgingRule, Keys};
use super::table::Table;
use crate::study::curves::Point;
use crate::study::outcomes::outcome_row;
use crate::track::floors::Association;

outcome_row! {
    |table: &Table, point: &Point<Keys>|
    curve: usize = point.curve + 1;
    label: String = table.labels[point.curve].clone();
    /// The key that is swept.
    axis: String = table.axis.clone();
    /// Its value.
    x: f64 = point.x;
    ..
    measure: String = table.measure.to_string();
    floors: usize = point.of.floors;
    storey: f64 = point.of.storey;
    uneven: f64 = point.of.uneven;
    level: f64 = point.of.level;
    noise: f64 = point.of.noise;
    traffic: Traffic = point.of.traffic;
    trips: usize = point.of.trips;
    storeys: usize = point.of.storeys;
    next_storeys: usize = point.of.next_storeys;
    offset: f64 = point.of.offset;
    since: usize = point.of.since;
    vague: f64 = point.of.vague;
    rule: JudgingRule = point.of.rule;
    threshold: f64 = point.of.settings().threshold;
    association: Association = point.of.settings().association;
    window: usize = point.of.settings().window;
}
