//! The threshold that keeps a promised rate of false alarms, and the delay that it costs.

use super::chain::Chain;
use super::chart::Chart;
use super::detector::Detector;
use super::reach::Reach;
use super::run_length::RunLength;
use super::score::{STEPS, Side};
use crate::rule::OutOfRange;
use crate::stats::bisect::first;
use crate::stats::normal;

/// A rate of false alarms that no threshold keeps.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at most {reachable:.3e} blocks between false alarms can be promised, got {wanted:.3e}")]
pub struct ThresholdError {
    /// Mean blocks between false alarms that were asked for.
    pub wanted: f64,
    /// The most that can be promised.
    pub reachable: f64,
    /// N, if a longer reference could promise more; if not, the threshold is too high to be computed.
    pub reference: Option<usize>,
}

impl ThresholdError {
    /// The same of a rate per hour at so many blocks an hour. The keys are those of the rate and of the reference.
    pub fn per_hour(&self, [rate, reference]: [&str; 2], blocks: f64) -> OutOfRange {
        let got = blocks / self.wanted;
        let least = rounded_up(blocks / self.reachable);
        match self.reference {
            None => OutOfRange::new(rate, format!("be at least {least}"), got)
                .explained(" (or raise k: thresholds beyond 20 are not computed)"),
            Some(n) if self.reachable == 0.0 => {
                let rule = "be longer for a shift of any size to reach a threshold";
                OutOfRange::new(reference, rule, n)
            }
            Some(n) => {
                let rule = format!("be at least {least} with a reference of {n} blocks");
                let remedy =
                    " (lengthen the reference: in this one no shift, however large, climbs higher)";
                OutOfRange::new(rate, rule, got).explained(remedy)
            }
        }
    }
}

/// Three digits, not below the value.
fn rounded_up(value: f64) -> f64 {
    let near = |value: f64| format!("{value:.2e}").parse().unwrap_or(value);
    let nearest: f64 = near(value);
    if nearest < value {
        near(value * 1.01)
    } else {
        nearest
    }
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
    /// If a shift of any size would not reach it, or it is beyond 20.
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
        Err(ThresholdError {
            wanted: mean,
            reachable: match most {
                0 => 0.0,
                _ => self.run_length(most as i32).promised(),
            },
            reference: (most < MOST).then_some(self.reference),
        })
    }

    /// The mean number of blocks from the start of a shift by `shift` deviations of normal noise to the alarm of the side
    /// that is fastest on average, from S = 0 with a long reference. With several sides the true mean is at most this.
    pub fn delay(&self, threshold: i32, shift: f64) -> f64 {
        let below = |u: f64| normal::below(normal::quantile(u) - shift);
        let mean = |side: Side| {
            let law = self.lattice.law(side, below);
            Chain::new(&law, self.allowance, threshold).mean()
        };
        let up = |side: &Side| if *side == Side::Down { Side::Up } else { *side };
        let delays = self.sides.iter().map(|side| mean(up(side)));
        delays.fold(f64::INFINITY, f64::min)
    }
}
