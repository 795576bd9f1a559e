//! The columns of `points.csv`.

use super::table::Point;
use crate::study::outcomes::outcome_row;

outcome_row! {
    |point: &Point|
    drift: f64 = point.drift;
    ..
}
