//! The columns of `points.csv`.

use super::keys::Keys;
use super::table::Table;
use crate::study::curves::Point;
use crate::study::outcomes::outcome_row;
use crate::track::vibration::{Guard, Stop};

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
    vibration: f64 = point.of.vibration;
    uneven: f64 = point.of.uneven;
    joints: f64 = point.of.joints;
    unlike: f64 = point.of.unlike;
    stop: Stop = point.of.stop;
    learnt: Option<usize> = point.of.trips;
    guard: Guard = point.of.guard;
    alarm_rate: f64 = point.of.alarm_rate;
    size: f64 = point.of.size;
}
