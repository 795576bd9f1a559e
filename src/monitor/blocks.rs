//! Means of blocks of a fixed number of samples.

use crate::recording::Sample;

/// Samples are added as whole nanometres per second squared, so that equal means stay equal in any order of
/// their samples: in floating point, rounding would break the ties of a coarse sensor.
const UNIT: f64 = 1e-9;

/// The largest absolute acceleration, m/s²: no sensor reaches it, stronger samples are clipped to it, and the
/// sum of a block cannot overflow.
pub const STRONGEST: f64 = 1e4;

/// The longest silence that cannot hide a start: s, and blocks.
const LONGEST_GAP: (f64, f64) = (0.5, 3.0);

/// A complete block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
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
#[derive(Clone, Debug)]
pub(super) struct Blocks {
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
