//! Means of blocks of samples, and the reference that blocks are measured by.

use libm::sqrt;
use std::collections::VecDeque;

/// A second, samples.
pub const RATE: usize = 100;

/// Samples of a block.
pub const BLOCK: usize = 20;

/// Blocks of the reference, and of the gap between it and the newest.
pub const REFERENCE: usize = 60;
pub const GAP: usize = 15;

/// What is computed from the newest sample or block.
pub trait Score {
    /// −∞ before there is anything to compute it from.
    fn step(&mut self, x: f64) -> f64;

    /// The first of the samples after which the score is what is looked for. It takes in none of those that follow.
    #[inline]
    fn find(&mut self, samples: &[f64], mut is_it: impl FnMut(f64) -> bool) -> Option<usize> {
        samples.iter().position(|x| is_it(self.step(*x)))
    }
}

/// A score of means of so many samples; between them the last stands.
#[derive(Clone, Debug)]
pub struct Blocks<S> {
    size: usize,
    sum: f64,
    taken: usize,
    score: f64,
    of: S,
}

impl<S: Score> Blocks<S> {
    pub fn new(size: usize, of: S) -> Self {
        let (sum, taken, score) = (0.0, 0, f64::NEG_INFINITY);
        Self {
            size,
            sum,
            taken,
            score,
            of,
        }
    }
}

impl<S: Score> Score for Blocks<S> {
    fn step(&mut self, x: f64) -> f64 {
        self.find(&[x], |_| true);
        self.score
    }

    /// With sum and score in registers, between blocks too.
    #[inline]
    fn find(&mut self, samples: &[f64], mut is_it: impl FnMut(f64) -> bool) -> Option<usize> {
        let (mut sum, mut taken, mut score) = (self.sum, self.taken, self.score);
        let found = samples.iter().position(|x| {
            sum += x;
            taken += 1;
            if taken == self.size {
                score = self.of.step(sum / self.size as f64);
                (sum, taken) = (0.0, 0);
            }
            is_it(score)
        });
        (self.sum, self.taken, self.score) = (sum, taken, score);
        found
    }
}

/// The blocks between [`GAP`] and [`GAP`] + [`REFERENCE`] before the newest.
#[derive(Clone, Debug, Default)]
pub struct Reference {
    blocks: VecDeque<f64>,
}

impl Reference {
    /// The newest block less the mean of the reference, in its deviations; none before there is a reference.
    pub fn step(&mut self, x: f64) -> Option<f64> {
        let full = self.blocks.len() == REFERENCE + GAP;
        let z = full.then(|| {
            let (mean, deviation) = self.moments();
            (x - mean) / deviation
        });
        if full {
            self.blocks.pop_front();
        }
        self.blocks.push_back(x);
        z
    }

    /// Mean and standard deviation. Blocks that are all alike deviate a little, so that z is a number.
    fn moments(&self) -> (f64, f64) {
        // In one piece but for the turn of the ring, so in two plain loops.
        let (front, back) = self.blocks.as_slices();
        let (front, back) = (&front[..front.len().min(REFERENCE)], back);
        let reference = || front.iter().chain(&back[..REFERENCE - front.len()]);
        let mean = reference().sum::<f64>() / REFERENCE as f64;
        let squares: f64 = reference().map(|x| (x - mean) * (x - mean)).sum();
        (mean, sqrt(squares / (REFERENCE - 1) as f64).max(1e-9))
    }
}
