//! A record behind a first-order high-pass filter, restored.
//!
//! Phones that remove gravity by a filter give y = a − s with τ ds/dt = y, so that a = y + (1/τ)∫y. The constant of
//! the integral is part of the level. The integral of a small offset grows without bound, so the offset is removed
//! first.

use super::blocks::{Block, Cut};
use super::cost::Prior;
use super::record::Record;
use crate::stats::quantile::median;

/// The time constants tried, s.
const TIME_CONSTANTS: [f64; 15] = [
    16.0, 11.0, 8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0, 0.8, 0.65, 0.54, 0.45, 0.36, 0.3,
];

/// Factors of the best of them, tried in turn.
const NEARBY: [f64; 4] = [0.85, 0.92, 1.08, 1.17];

/// What a filter leaves of a constant, m/s²: a record farther from zero has none.
const NO_LEVEL: f64 = 0.4;

/// What one without an offset of its own leaves, m/s².
const ZERO: f64 = 0.05;

/// The error of a restored record's speeds, as a share.
const RESTORED_ERROR: f64 = 0.08;

/// A filter is looked for in so much of a record before and after its first pulse, s.
const BEFORE: f64 = 30.0;
const TELLING: f64 = 300.0;

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// A high-pass filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighPass {
    /// s
    pub time_constant: f64,
    /// What the sensor reads on average, m/s².
    offset: f64,
}

impl HighPass {
    /// The filters that a record may be behind.
    pub fn all(cut: &Cut) -> Vec<Self> {
        Self::with(cut, &TIME_CONSTANTS)
    }

    /// Those with time constants near to this one's.
    pub fn nearby(&self, cut: &Cut) -> Vec<Self> {
        Self::with(cut, &NEARBY.map(|factor| factor * self.time_constant))
    }

    fn with(cut: &Cut, time_constants: &[f64]) -> Vec<Self> {
        let offsets = offsets(cut)
            .into_iter()
            .filter(|offset| offset.abs() < NO_LEVEL);
        let filters = offsets.flat_map(|offset| {
            time_constants.iter().map(move |&time_constant| Self {
                time_constant,
                offset,
            })
        });
        filters.collect()
    }

    /// What is known of lifts beforehand, for restored records.
    pub fn prior(&self, prior: &Prior) -> Prior {
        Prior {
            gain_error: RESTORED_ERROR,
            ..*prior
        }
    }

    /// The record before the filter.
    pub fn undone(&self, cut: &Cut, prior: &Prior) -> Record {
        Record::of(self.restored(cut), 0.0, prior.most_acceleration)
    }

    fn restored(&self, cut: &Cut) -> Cut {
        let mut integral = 0.0;
        let restore = |block: &Block| {
            let filtered = block.mean - self.offset;
            let half = filtered * block.seconds / 2.0;
            let mean = filtered + (integral + half) / self.time_constant;
            integral += 2.0 * half;
            Block { mean, ..*block }
        };
        Cut {
            blocks: cut.blocks.iter().map(restore).collect(),
            ..cut.clone()
        }
    }
}

impl Record {
    /// The first minutes in which pulses show, long enough to tell whether there is a filter.
    pub fn telling_part(&self) -> Option<Cut> {
        let cut = &self.cut;
        let first = self.pulses.first()?.blocks.start;
        let from = first.saturating_sub(cut.blocks_in(BEFORE));
        let to = cut.blocks.len().min(first + cut.blocks_in(TELLING));
        let ends = cut.ends.iter().map(|end| (*end).clamp(from, to) - from);
        let mut ends: Vec<usize> = ends.filter(|end| *end > 0).collect();
        ends.dedup();
        Some(Cut {
            blocks: cut.blocks[from..to].to_vec(),
            ends,
            ..*cut
        })
    }
}

/// Whether a record reads nothing on average.
pub fn is_near_zero(cut: &Cut) -> bool {
    offsets(cut).iter().any(|offset| offset.abs() < ZERO)
}

/// What a record reads on average: over all of it, or over what lies near its median. The first is right where the cage
/// stands at both ends, the second where it does not.
fn offsets(cut: &Cut) -> [f64; 2] {
    let area: f64 = cut
        .blocks
        .iter()
        .map(|block| block.mean * block.seconds)
        .sum();
    let means = cut.window_means(WINDOW);
    let middle = median(means.clone());
    let spread = median(means.iter().map(|mean| (mean - middle).abs()).collect());
    let near = means
        .into_iter()
        .filter(|mean| (mean - middle).abs() <= 4.0 * spread);
    let near: Vec<f64> = near.collect();
    [
        area / cut.recorded(),
        near.iter().sum::<f64>() / near.len() as f64,
    ]
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
            let filter = HighPass {
                time_constant,
                offset: 0.0,
            };
            for block in filter.restored(&cut).blocks {
                let error = (block.mean - pulse(block.to - 0.02)).abs();
                assert!(error < 0.01, "{time_constant}: {error} at {}", block.to);
            }
        }
    }
}
