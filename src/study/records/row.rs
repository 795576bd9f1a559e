//! The columns of `points.csv`.

use super::table::Table;
use crate::lift::Class;
use crate::study::outcomes::outcome_row;

outcome_row! {
    |table: &Table, of: Class|
    class: Class = of;
    ..
    watch: String = table.watch.to_string();
    tolerance: f64 = table.tolerance.get();
}
