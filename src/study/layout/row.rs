//! One row of `points.csv`.

use serde::{Deserialize, Serialize};

/// A stretch of a trial, from `start` to just before `end`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Row {
    /// `rest`, `acceleration`, `inertial`; `training`, `reference`, `gap`, `shift`, `scale`.
    pub name: String,
    /// Its first observation.
    pub start: i64,
    /// The first observation after it.
    pub end: i64,
}
