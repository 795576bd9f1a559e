//! Block means: as many samples as a block holds, one after the other.

use super::history::Span;
use crate::signal::recording::Sample;

/// Samples are added as whole nanometres per second squared, so that equal means stay equal whatever the
/// order of their samples: a sum of rounded numbers would break the ties of a coarse sensor by rounding.
const UNIT: f64 = 1e-9;

/// m/s², in size: no sensor reaches it, a stronger sample counts as this strong, and a block of them fits into
/// the sum.
pub const STRONGEST: f64 = 1e4;

/// The block under way.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    length: u32,
    held: u32,
    sum: i64,
    from: f64,
}

impl Blocks {
    pub fn new(length: usize) -> Self {
        Self {
            length: length as u32,
            held: 0,
            sum: 0,
            from: 0.0,
        }
    }

    /// Takes a sample; the block that it completes, where it does.
    #[inline]
    pub fn step(&mut self, sample: Sample) -> Option<(Span, f64)> {
        if self.held == 0 {
            self.from = sample.time;
        }
        let units = sample.acceleration.clamp(-STRONGEST, STRONGEST) / UNIT;
        self.sum += units.round() as i64;
        self.held += 1;
        if self.held < self.length {
            return None;
        }
        let mean = self.sum as f64 / f64::from(self.length) * UNIT;
        self.clear();
        let times = Span {
            from: self.from,
            to: sample.time,
        };
        Some((times, mean))
    }

    pub fn clear(&mut self) {
        (self.held, self.sum) = (0, 0);
    }
}
