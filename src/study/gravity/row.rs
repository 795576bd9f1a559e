//! The columns of `points.csv`.

use super::condition::Condition;
use crate::study::outcomes::outcome_row;

outcome_row! {
    |at: Condition|
    condition: Condition = at;
    ..
}
