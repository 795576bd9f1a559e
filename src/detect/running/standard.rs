//! What a textbook has: CUSUM [^1] and generalised likelihood ratio (GLR) [^2] of blocks z in deviations of a reference.
//!
//! | chart | score |
//! |---|---|
//! | CUSUM of the mean | S± ← max(0, S± ± z − k), the larger |
//! | CUSUM of mean and variance | S± ← max(0, S± + ln N(z; ±2k, τ²) − ln N(z; 0, 1)), the larger |
//! | GLR of the mean | max over n of n z̄²/2 |
//! | GLR of mean and variance | max over n of n/2 (z̄² + s² − s²/v − ln v), v = max(s², 1) |
//!
//! z̄ and s² are mean and variance (over n) of the newest n blocks, n ≤ 15. A motion does not make noise quieter, so v is at
//! least 1. At rest z would be N(0, 1) if the noise were normal and white, and mean and σ known; they are learnt.
//!
//! [^1]: E. S. Page, "Continuous inspection schemes", Biometrika 41, 1954.
//! [^2]: M. Basseville, I. V. Nikiforov, "Detection of Abrupt Changes", 1993, sections 2.2 and 2.4.

use super::blocks::{Reference, Score};
use libm::log;
use std::collections::VecDeque;

/// Half of the shift that is looked for, in deviations of a block: 0.36 of those of a sample.
const K: f64 = 0.8;

/// The deviation that is looked for, in those at rest.
const TAU: f64 = 1.5;

/// The longest change that GLR looks for: 3 s.
const LONGEST: usize = 15;

/// A chart with its reference.
#[derive(Clone, Debug)]
pub struct Standard {
    reference: Reference,
    chart: Chart,
}

/// A score of standardised blocks.
#[derive(Clone, Debug)]
pub enum Chart {
    /// Sums up and down, and what a block adds to the first.
    Cusum([f64; 2], fn(f64) -> f64),
    /// The newest blocks, the last first, and the score of so many with mean and variance.
    Glr(VecDeque<f64>, fn(f64, f64, f64) -> f64),
}

impl Chart {
    pub fn cusum() -> Self {
        Self::Cusum([0.0; 2], |z| z - K)
    }

    pub fn cusum_variance() -> Self {
        Self::Cusum([0.0; 2], |z| {
            let off = (z - 2.0 * K) / TAU;
            (z * z - off * off) / 2.0 - log(TAU)
        })
    }

    pub fn glr() -> Self {
        Self::Glr(VecDeque::new(), |n, mean, _| n * mean * mean / 2.0)
    }

    pub fn glr_variance() -> Self {
        Self::Glr(VecDeque::new(), |n, mean, variance| {
            let v = variance.max(1.0);
            n / 2.0 * (mean * mean + variance - variance / v - log(v))
        })
    }
}

impl Standard {
    pub fn new(chart: Chart) -> Self {
        let reference = Reference::default();
        Self { reference, chart }
    }
}

impl Score for Standard {
    fn step(&mut self, x: f64) -> f64 {
        match self.reference.step(x) {
            Some(z) => self.chart.step(z),
            None => f64::NEG_INFINITY,
        }
    }
}

impl Score for Chart {
    fn step(&mut self, z: f64) -> f64 {
        match self {
            Self::Cusum([up, down], adds) => {
                *up = (*up + adds(z)).max(0.0);
                *down = (*down + adds(-z)).max(0.0);
                up.max(*down)
            }
            Self::Glr(newest, score) => {
                newest.truncate(LONGEST - 1);
                newest.push_front(z);
                let (mut sum, mut squares) = (0.0, 0.0);
                let each = (1..).map(f64::from).zip(newest.iter());
                each.fold(0.0, |most, (n, z)| {
                    sum += z;
                    squares += z * z;
                    let mean = sum / n;
                    f64::max(most, score(n, mean, squares / n - mean * mean))
                })
            }
        }
    }
}
