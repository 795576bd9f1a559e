//! Page's CUSUM [^1] of scores, in integers.
//!
//! S ← max(0, S + score − k) from S = 0; an alarm where S reaches h. Scores, k and h in steps of the lattice.
//!
//! [^1]: E. S. Page, "Continuous inspection schemes", Biometrika 41, 1954.

use serde::{Deserialize, Serialize};

/// The sum of one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cusum {
    allowance: i32,
    threshold: i32,
    sum: i32,
}

impl Cusum {
    /// A sum at 0 with allowance k and threshold h ≥ 1.
    pub fn new(allowance: i32, threshold: i32) -> Self {
        Self {
            allowance,
            threshold,
            sum: 0,
        }
    }

    /// Takes in a score; whether this is an alarm.
    pub fn step(&mut self, score: i32) -> bool {
        self.sum = (self.sum + score - self.allowance).max(0);
        self.sum >= self.threshold
    }

    /// S, in steps.
    pub fn sum(&self) -> i32 {
        self.sum
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        self.sum = 0;
    }
}
