//! The threshold that keeps a promised rate of false alarms, and the delay that it costs.

use super::chain::Chain;
use super::change::Change;
use super::chart::{Chart, units};
use super::detector::Detector;
use super::reach::Reach;
use super::run_length::RunLength;
use super::score::STEPS;
use crate::stats::bisect::first;

/// A rate of false alarms that no threshold keeps.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at most {reachable:.3e} blocks between false alarms can be promised, got {wanted:.3e}")]
pub struct ThresholdError {
    /// Mean blocks between false alarms that were asked for.
    pub wanted: f64,
    /// The most that can be promised.
    pub reachable: f64,
    /// What would help.
    pub remedy: Remedy,
}

/// What makes a rate reachable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Remedy {
    /// A larger k: the threshold is too high to be computed.
    RaiseAllowance,
    /// A smaller k: with this one no change reaches any threshold, with half of it one reaches some.
    LowerAllowance {
        /// N.
        reference: usize,
        /// k.
        allowance: f64,
    },
    /// A longer reference than that of N blocks.
    LongerReference(usize),
}

/// The largest threshold in steps. With normal scores and k = 0.8 its mean run is some 10¹⁴ blocks.
const MOST: u64 = 20 * STEPS as u64;

impl Chart {
    /// The detector with threshold h, in steps.
    pub fn detector(&self, threshold: i32) -> Detector {
        Detector::new(self, threshold)
    }

    /// The exact law of the time to a false alarm with threshold h, in steps.
    pub fn run_length(&self, threshold: i32) -> RunLength {
        RunLength::new(self, threshold)
    }

    /// The smallest threshold h, in steps, that promises `mean` blocks between false alarms, all sides together.
    ///
    /// # Errors
    /// If a change of any size would not reach it, or it is beyond 20.
    pub fn threshold(&self, mean: f64) -> Result<i32, ThresholdError> {
        let keeps = |threshold: u64| self.run_length(threshold as i32).promised() >= mean;
        let mut enough = STEPS as u64;
        while enough < MOST && !keeps(enough) {
            enough *= 2;
        }
        let threshold = first(1..enough.min(MOST + 1), keeps);
        let reach = Reach::new(self);
        let reaches = |threshold: u64| reach.reaches(threshold as i32);
        if threshold <= MOST && reaches(threshold) {
            return Ok(threshold as i32);
        }
        let most = first(1..threshold.min(MOST) + 1, |threshold| !reaches(threshold)) - 1;
        let reachable = match most {
            0 => 0.0,
            _ => self.run_length(most as i32).promised(),
        };
        let reference = self.reference;
        let remedy = match most {
            0 if Reach::new(&self.with_half_the_allowance()).reaches(1) => Remedy::LowerAllowance {
                reference,
                allowance: units(self.allowance),
            },
            MOST => Remedy::RaiseAllowance,
            _ => Remedy::LongerReference(reference),
        };
        Err(ThresholdError {
            wanted: mean,
            reachable,
            remedy,
        })
    }

    fn with_half_the_allowance(&self) -> Self {
        Self {
            allowance: self.allowance / 2,
            ..self.clone()
        }
    }

    /// The mean number of blocks from the start of a change of normal noise to the alarm of the side that is fastest on
    /// average, from S = 0 with a long reference. With several sides the true mean is at most this. Shifts are those that
    /// are looked for.
    pub fn delay(&self, threshold: i32, change: Change) -> f64 {
        let change = self.towards(change);
        let delays = self.sides.iter().map(|side| {
            let law = self.lattice.law(*side, |u| change.below(u));
            Chain::new(&law, self.allowance, threshold).mean()
        });
        delays.fold(f64::INFINITY, f64::min)
    }
}
