//! `quantities.csv`: single numbers that an experiment comes to.

use serde::{Deserialize, Serialize};

/// A named number with its interval; an exact one is its own interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// In snake case.
    pub name: String,
    /// What came out.
    pub value: f64,
    /// Its interval.
    pub low: f64,
    /// Its interval.
    pub high: f64,
}

impl Quantity {
    /// A number without uncertainty.
    pub fn exact(name: &str, value: f64) -> Self {
        Self {
            name: name.to_owned(),
            value,
            low: value,
            high: value,
        }
    }
}
