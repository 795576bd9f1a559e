//! Block means: as many samples as a block holds, one after the other.

use crate::signal::recording::Sample;

/// Samples are added as whole nanometres per second squared, so that equal means stay equal whatever the
/// order of their samples: a sum of rounded numbers would break the ties of a coarse sensor by rounding.
const UNIT: f64 = 1e-9;

/// m/s², in size: no sensor reaches it, a stronger sample counts as this strong, and a block of them fits into
/// the sum.
pub const STRONGEST: f64 = 1e4;

/// A longer silence, s or blocks, may hide a start.
const LONGEST_GAP: (f64, f64) = (0.5, 3.0);

/// A block that is complete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
    /// When its first sample was taken, s.
    pub from: f64,
    /// When its last sample was taken, s.
    pub to: f64,
    /// From the end of the block before to its own, s: what its mean stands for.
    pub seconds: f64,
    /// m/s².
    pub mean: f64,
}

/// The block under way.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    length: u32,
    /// Seconds in a block, nominally.
    nominal: f64,
    held: u32,
    sum: i64,
    from: f64,
    /// When the last block ended, s.
    ended: Option<f64>,
    /// When the last sample was taken, s.
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

    /// Takes a sample; the block that it completes, where it does.
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

    /// Forgets the block under way, and that there was one before.
    pub fn clear(&mut self) {
        *self = Self::new(self.length as usize, self.nominal);
    }
}
