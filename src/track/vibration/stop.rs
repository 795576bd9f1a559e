//! When a baseline has been learnt.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// A rule by which learning stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// (20)–(22), window by window: at the first k near zero.
    Printed,
    /// Trip by trip: once there are windows enough, and the standard error of the mean is small, by the means of trips.
    #[default]
    StandardError,
}

/// The windows between the ends of a slope.
const SPAN: usize = 20;

/// What is near zero, degrees.
const LEVEL: f64 = 0.1;

/// (20)–(22), window by window.
#[derive(Clone, Debug, Default)]
pub struct PrintedStop {
    number: u64,
    sum: f64,
    /// The latest errors, %, the oldest first; one more than the span.
    errors: VecDeque<f64>,
}

impl PrintedStop {
    /// Takes an energy; returns k, degrees, where there are errors enough.
    pub fn step(&mut self, energy: f64) -> Option<f64> {
        let before = self.sum / self.number.max(1) as f64;
        self.number += 1;
        self.sum += energy;
        if before <= 0.0 {
            return None;
        }
        let mean = self.sum / self.number as f64;
        self.errors
            .push_back((mean - before).abs() / before * 100.0);
        if self.errors.len() <= SPAN {
            return None;
        }
        let latest = *self.errors.back()?;
        let first = self.errors.pop_front()?;
        let slope = (latest - first) / SPAN as f64;
        Some(libm::atan(slope).to_degrees())
    }

    /// Whether learning stops at this k.
    pub fn is_level(k: f64) -> bool {
        k.abs() < LEVEL
    }
}
