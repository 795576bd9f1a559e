//! Rules that learn nothing: the zero rule [^1] and the change of the local mean [^2].
//!
//! The zero rule: rest while all |a| of the last n samples are below a threshold. It leaves rest with the first |a| that is
//! not, so the time to an alarm is that of a single sample whatever n is; n only says how long the alarm stands.
//!
//! The local mean: uniform motion, or rest, while the mean of the last 0.5 s is near the bias. The published detector looks
//! at the mean around a sample, half a window later; the alarm comes when the window is full either way.
//!
//! [^1]: Yang et al., a lift monitor by accelerometer and barometer (in Chinese).
//! [^2]: The trip filter of a patent (in Chinese).

use super::blocks::{RATE, Score};
use libm::fabs;
use std::collections::VecDeque;

/// n of the zero rule: 0.2 s.
pub const ZERO: usize = 20;

/// W: 0.5 s.
pub const WINDOW: usize = RATE / 2;

/// The largest |a| of the last n, and for how many samples it stands.
#[derive(Clone, Debug, Default)]
pub struct ZeroRule {
    /// Sizes that no later one exceeds, each with its age; the largest first.
    sizes: VecDeque<(f64, usize)>,
    time: usize,
}

/// The mean of the last W.
#[derive(Clone, Debug, Default)]
pub struct Uniform {
    window: VecDeque<f64>,
    sum: f64,
}

impl Score for ZeroRule {
    fn step(&mut self, x: f64) -> f64 {
        let size = fabs(x);
        while self.sizes.back().is_some_and(|(last, _)| *last <= size) {
            self.sizes.pop_back();
        }
        self.sizes.push_back((size, self.time));
        if self.sizes[0].1 + ZERO <= self.time {
            self.sizes.pop_front();
        }
        self.time += 1;
        self.sizes[0].0
    }
}

impl Score for Uniform {
    fn step(&mut self, x: f64) -> f64 {
        self.window.push_back(x);
        self.sum += x;
        if self.window.len() > WINDOW {
            self.sum -= self.window.pop_front().unwrap_or_default();
        }
        if self.window.len() < WINDOW {
            return f64::NEG_INFINITY;
        }
        fabs(self.sum) / WINDOW as f64
    }
}
