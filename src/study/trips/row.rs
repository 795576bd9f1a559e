//! The columns of `points.csv`.

use super::condition::Condition;
use super::table::Point;
use crate::study::outcomes::outcome_row;

outcome_row! {
    |point: &Point|
    condition: Condition = point.condition;
    distance: f64 = point.distance;
    ..
}
