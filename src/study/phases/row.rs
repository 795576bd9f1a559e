//! The columns of `points.csv`.

use super::table::Point;
use crate::study::outcomes::outcome_row;
use crate::study::trips::Condition;

outcome_row! {
    |point: &Point|
    condition: Condition = point.condition;
    vibration: f64 = point.vibration;
    threshold: f64 = point.threshold;
    ..
}
