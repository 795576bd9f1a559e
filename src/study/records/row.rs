//! The columns of `points.csv`.

use crate::lift::Class;
use crate::study::outcomes::outcome_row;

outcome_row! {
    class: Class,
    ..
    watch: String,
    tolerance: f64,
}
