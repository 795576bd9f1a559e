//! A record behind a first-order high-pass filter, restored.
//!
//! Phones that remove gravity by a filter give y = a − s with τ ds/dt = y, so that a = y + (1/τ)∫y. The constant of
//! the integral is part of the level. The integral of a small offset grows without bound, so the offset is removed
//! first.

use super::blocks::{Block, Cut, median};

/// The time constants tried, s.
pub const TIME_CONSTANTS: [f64; 15] = [
    16.0, 11.0, 8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0, 0.8, 0.65, 0.54, 0.45, 0.36, 0.3,
];

/// Factors of the best of them, tried in turn.
pub const NEARBY: [f64; 4] = [0.85, 0.92, 1.08, 1.17];

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// What the record reads on average: over all of it, or over what lies near its median. The first is right where
/// the cage stands at both ends, the second where it does not.
pub fn offsets(record: &Cut) -> [f64; 2] {
    let seconds: f64 = record.blocks.iter().map(|block| block.seconds).sum();
    let area: f64 = record
        .blocks
        .iter()
        .map(|block| block.mean * block.seconds)
        .sum();
    let means = record.window_means(WINDOW);
    let middle = median(means.clone());
    let spread = median(means.iter().map(|mean| (mean - middle).abs()).collect());
    let near = means
        .into_iter()
        .filter(|mean| (mean - middle).abs() <= 4.0 * spread);
    let near: Vec<f64> = near.collect();
    [area / seconds, near.iter().sum::<f64>() / near.len() as f64]
}

/// The record before the filter.
pub fn restored(record: &Cut, time_constant: f64, offset: f64) -> Cut {
    let mut integral = 0.0;
    let restore = |block: &Block| {
        let filtered = block.mean - offset;
        let half = filtered * block.seconds / 2.0;
        let mean = filtered + (integral + half) / time_constant;
        integral += 2.0 * half;
        Block { mean, ..*block }
    };
    Cut {
        blocks: record.blocks.iter().map(restore).collect(),
        ..record.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Sample;

    /// A pulse behind a high pass comes back, whatever its time constant; the integral is exact to the trapezoid.
    #[test]
    fn a_pulse_comes_back() {
        for time_constant in [0.5f64, 2.0, 8.0] {
            let rate = 200.0f64;
            let pulse = |time: f64| if (3.0..5.0).contains(&time) { 1.0 } else { 0.0 };
            let mut low = 0.0;
            let share = 1.0 - (-1.0 / (rate * time_constant)).exp();
            let samples = (0..4000).map(|i| {
                let time = f64::from(i) / rate;
                let acceleration = pulse(time) - low;
                low += share * acceleration;
                Sample { time, acceleration }
            });
            let cut = Cut::new(&samples.collect::<Vec<_>>(), 10, 0.05);
            for block in restored(&cut, time_constant, 0.0).blocks {
                let error = (block.mean - pulse(block.to - 0.02)).abs();
                assert!(error < 0.01, "{time_constant}: {error} at {}", block.to);
            }
        }
    }
}
