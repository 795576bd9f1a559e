//! `[records]`: which classes of records are drawn, and who watches them.

use crate::lift::Class;
use crate::monitor::{Design, Settings};
use crate::rule::OutOfRange;
use crate::run::Identity;
use crate::values::Positive;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Simulated records of every class, as found by `detect` or watched by `monitor`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Who watches.
    pub watch: Watch,
    /// What makes the records hard, one point for each.
    pub class: Vec<Class>,
    /// How far from the truth the time of a start or a stop may lie, s.
    #[serde(default = "half_a_second")]
    pub tolerance: Positive,
    /// Settings of the monitor, by the tables of `detect --config`.
    #[serde(default)]
    pub settings: Settings,
    /// The settings at one rate, from which those at the rate of a record follow.
    #[serde(skip)]
    pub design: Option<Design>,
}

/// Who watches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Watch {
    /// The whole record is known before anything is said.
    Detect,
    /// Sample by sample; it is told that the cage stands at the beginning.
    Monitor,
}

fn half_a_second() -> Positive {
    Positive::new(0.5).expect("it is")
}

impl fmt::Display for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Table {
    /// Checks that there is a point, and each but once.
    ///
    /// # Errors
    /// If there is none, or a class is named twice.
    pub fn check(&self) -> Result<(), OutOfRange> {
        if self.class.is_empty() {
            return Err(OutOfRange::new("records.class", "name a class", "none"));
        }
        let mut classes = self.class.clone();
        classes.sort_unstable();
        match classes.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => {
                let rule = "name each class once";
                Err(OutOfRange::new(
                    "records.class",
                    rule,
                    format!("{} twice", pair[0]),
                ))
            }
            None => Ok(()),
        }
    }

    /// Every parameter of a point.
    pub fn parameters(&self, class: Class) -> Identity {
        let settings = serde_json::to_string(&self.settings).expect("settings are plain data");
        Identity::new([
            ("watch", self.watch.to_string()),
            ("class", class.to_string()),
            ("tolerance", self.tolerance.get().to_string()),
            ("settings", settings),
        ])
    }
}
