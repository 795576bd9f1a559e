//! Means of blocks of a fixed number of samples.

use crate::recording::Sample;
use crate::stats::quantile::median;
use serde::{Deserialize, Serialize};

/// Samples are added as whole nanometres per second squared, so that equal means stay equal in any order of
/// their samples: in floating point, rounding would break the ties of a coarse sensor.
const UNIT: f64 = 1e-9;

/// The largest absolute acceleration, m/s²: no sensor reaches it, stronger samples are clipped to it, and the
/// sum of a block cannot overflow.
pub const STRONGEST: f64 = 1e4;

/// The longest silence that cannot hide a start: s, and blocks.
const LONGEST_GAP: (f64, f64) = (0.5, 3.0);

/// A complete block.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Time of its first sample, s.
    pub from: f64,
    /// Time of its last sample, s.
    pub to: f64,
    /// The time its mean covers, s: from the end of the block before to its own.
    pub seconds: f64,
    /// m/s².
    pub mean: f64,
}

/// The current, incomplete block.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Blocks {
    length: u32,
    /// Nominal length of a block, s.
    nominal: f64,
    held: u32,
    sum: i64,
    from: f64,
    /// End of the last block, s.
    ended: Option<f64>,
    /// Time of the last sample, s.
    last: Option<f64>,
}

impl Blocks {
    /// Blocks of `length` samples, which take `nominal` seconds.
    pub fn new(length: usize, nominal: f64) -> Self {
        Self {
            length: length as u32,
            nominal,
            held: 0,
            sum: 0,
            from: 0.0,
            ended: None,
            last: None,
        }
    }

    /// Whether a sample at this time comes after a gap.
    pub fn is_gap(&self, time: f64) -> bool {
        let longest = LONGEST_GAP.0.max(LONGEST_GAP.1 * self.nominal);
        self.last.is_some_and(|last| time - last > longest)
    }

    /// Takes a sample and returns the block that it completes, if any.
    #[inline]
    pub fn step(&mut self, sample: Sample) -> Option<Block> {
        self.last = Some(sample.time);
        if self.held == 0 {
            self.from = sample.time;
        }
        let units = sample.acceleration.clamp(-STRONGEST, STRONGEST) / UNIT;
        self.sum += units.round() as i64;
        self.held += 1;
        if self.held < self.length {
            return None;
        }
        let block = Block {
            from: self.from,
            to: sample.time,
            seconds: self.ended.map_or(self.nominal, |ended| sample.time - ended),
            mean: self.sum as f64 / f64::from(self.length) * UNIT,
        };
        (self.held, self.sum) = (0, 0);
        self.ended = Some(sample.time);
        Some(block)
    }

    /// Discards the current block and the end of the last one.
    pub fn clear(&mut self) {
        *self = Self::new(self.length as usize, self.nominal);
    }
}

/// A record as blocks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cut {
    /// All blocks.
    pub blocks: Vec<Block>,
    /// Nominal length of a block, s.
    pub seconds: f64,
    /// The ends of the stretches without holes, as places in the blocks.
    pub ends: Vec<usize>,
    /// The step of the samples, m/s²; 0 if they are finer than their noise.
    pub step: f64,
}

impl Cut {
    /// Cuts samples into blocks of `length` samples, which take `seconds`.
    pub fn new(samples: &[Sample], length: usize, seconds: f64) -> Self {
        let mut blocks = Vec::with_capacity(samples.len() / length);
        let mut ends = Vec::new();
        let mut current = Blocks::new(length, seconds);
        for sample in samples {
            if current.is_gap(sample.time) {
                ends.push(blocks.len());
                current.clear();
            }
            blocks.extend(current.step(*sample));
        }
        ends.push(blocks.len());
        ends.dedup();
        ends.retain(|end| *end > 0);
        Self {
            blocks,
            seconds,
            ends,
            step: step(samples),
        }
    }

    /// How long it is without its holes, s.
    pub fn recorded(&self) -> f64 {
        self.blocks.iter().map(|block| block.seconds).sum()
    }

    /// The means of windows of about this length, s.
    pub fn window_means(&self, seconds: f64) -> Vec<f64> {
        let windows = self.blocks.chunks(self.blocks_in(seconds));
        let mean = |window: &[Block]| {
            window.iter().map(|block| block.mean).sum::<f64>() / window.len() as f64
        };
        windows.map(mean).collect()
    }

    /// The deviation of a block if their noise were white, m/s²: from second differences, which a ramp leaves alone.
    pub fn scatter(&self) -> f64 {
        let bends = self
            .blocks
            .windows(3)
            .map(|it| (it[0].mean - 2.0 * it[1].mean + it[2].mean).abs());
        1.4826 * median(bends.collect()) / 6f64.sqrt()
    }

    /// The blocks in a time, at least one.
    pub fn blocks_in(&self, seconds: f64) -> usize {
        ((seconds / self.seconds).round() as usize).max(1)
    }
}

/// The least difference of successive samples, if it is no smaller than a tenth of their median difference: then
/// they are steps.
fn step(samples: &[Sample]) -> f64 {
    let differences = samples
        .windows(2)
        .map(|pair| (pair[1].acceleration - pair[0].acceleration).abs());
    let moves: Vec<f64> = differences
        .filter(|difference| *difference > 1e-9)
        .collect();
    let least = moves.iter().copied().fold(f64::INFINITY, f64::min);
    if least >= median(moves) / 10.0 && least.is_finite() {
        least
    } else {
        0.0
    }
}
