//! The ceiling: a matched filter that is told all but when the start comes, and how strong it is.
//!
//! Samples are whitened with the true coefficients, and means of 0.2 s of the last 3 s correlated with the shape of the
//! start in them: T = Σ s_j y_j / (|s| σ_y). At rest T is N(0, 1) where the noise is normal. Among all tests of the last 3 s
//! it is the most powerful for every Δ > 0 if the start is 3 s old [^1]; so it is the ceiling of what is detected within
//! 3 s, but not of how soon. Within the first samples of a step, the filter's memory, y is not s.
//!
//! [^1]: H. L. Van Trees, "Detection, Estimation, and Modulation Theory", part I, 1968, section 4.2.

use super::blocks::{BLOCK, Blocks, Score};
use libm::sqrt;
use std::collections::VecDeque;

/// Blocks of 3 s.
pub const BLOCKS: usize = 15;

/// What the clairvoyant is told.
#[derive(Clone, Debug)]
pub struct Told {
    /// φ of the noise.
    pub ar: Vec<f64>,
    /// Of the white noise that drives it, in deviations of the noise.
    pub deviation: f64,
    /// The mean shape of the start in each of its first `BLOCKS` blocks.
    pub shape: Vec<f64>,
}

/// Whitening before the filter.
#[derive(Clone, Debug)]
pub struct Matched {
    ar: Vec<f64>,
    /// The last samples, the newest first.
    past: VecDeque<f64>,
    filter: Blocks<Filter>,
}

#[derive(Clone, Debug)]
struct Filter {
    weights: Vec<f64>,
    newest: VecDeque<f64>,
}

impl Told {
    /// Blocks of which `shape` says something.
    pub const BLOCKS: usize = BLOCKS;
    /// Samples of each.
    pub const BLOCK: usize = BLOCK;
}

impl Matched {
    pub fn new(told: &Told) -> Self {
        let norm = sqrt(told.shape.iter().map(|s| s * s).sum());
        let unit = sqrt(BLOCK as f64) / told.deviation / norm;
        let weights = told.shape.iter().map(|s| s * unit).collect();
        let newest = VecDeque::new();
        Self {
            ar: told.ar.clone(),
            past: VecDeque::new(),
            filter: Blocks::new(BLOCK, Filter { weights, newest }),
        }
    }
}

impl Score for Matched {
    fn step(&mut self, x: f64) -> f64 {
        let terms = self.ar.iter().zip(&self.past);
        let white = x - terms.map(|(phi, past)| phi * past).sum::<f64>();
        self.past.push_front(x);
        self.past.truncate(self.ar.len());
        self.filter.step(white)
    }
}

impl Score for Filter {
    fn step(&mut self, y: f64) -> f64 {
        self.newest.push_back(y);
        if self.newest.len() > self.weights.len() {
            self.newest.pop_front();
        }
        if self.newest.len() < self.weights.len() {
            return f64::NEG_INFINITY;
        }
        let terms = self.weights.iter().zip(&self.newest);
        terms.map(|(weight, y)| weight * y).sum()
    }
}
