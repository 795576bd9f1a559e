//! A promised rate of false alarms, in the words of a user.

use super::chart::Chart;
use super::promise::{Remedy, ThresholdError};
use crate::format::{brief, eight_digits};
use crate::rule::{OutOfRange, Rule};

/// False alarms per hour that are promised, of so many blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    per_hour: f64,
    /// Blocks per hour.
    blocks: f64,
}

impl Rate {
    /// At most `per_hour` false alarms with `rate` blocks per second. Errors call these `per_hour` and `rate`.
    ///
    /// # Errors
    /// If one is out of range, or as many false alarms as blocks would be promised.
    pub fn new(per_hour: f64, rate: f64) -> Result<Self, OutOfRange> {
        Rule::Positive.check("per_hour", &per_hour)?;
        Rule::Within(1e-30, 1e10, "false alarms").check("per_hour", &per_hour)?;
        Rule::Within(1e-6, 1e6, "blocks per second").check("rate", &rate)?;
        let blocks = 3600.0 * rate;
        if per_hour >= blocks {
            let rule = format!("be less than {blocks}, the blocks in an hour");
            return Err(OutOfRange::new("per_hour", rule, per_hour));
        }
        Ok(Self { per_hour, blocks })
    }

    /// False alarms per block.
    pub fn per_block(self) -> f64 {
        self.per_hour / self.blocks
    }

    /// The smallest threshold, in steps, that keeps it. Errors are about `per_hour`, `reference` or `k`.
    ///
    /// # Errors
    /// As of [`Chart::threshold`].
    pub fn threshold(self, chart: &Chart) -> Result<i32, OutOfRange> {
        let threshold = chart.threshold(self.blocks / self.per_hour);
        threshold.map_err(|error| error.per_hour(["per_hour", "reference"], self.blocks))
    }
}

impl ThresholdError {
    /// The same of a rate per hour at so many blocks an hour. The keys are those of the rate and of the reference.
    pub fn per_hour(&self, [rate, reference]: [&str; 2], blocks: f64) -> OutOfRange {
        let got = eight_digits(blocks / self.wanted);
        let least = brief(rounded_up(blocks / self.reachable));
        match self.remedy {
            Remedy::RaiseAllowance => OutOfRange::new(rate, format!("be at least {least}"), got)
                .explained(" (thresholds beyond 20 are not computed; a larger k lowers them)"),
            Remedy::LowerAllowance {
                reference,
                allowance,
            } => {
                let rule = format!("be smaller with a reference of {reference} blocks");
                let remedy = " (with this one no change, however large, reaches a threshold; a longer reference helps too)";
                OutOfRange::new("k", rule, allowance).explained(remedy)
            }
            Remedy::LongerReference(n) if self.reachable == 0.0 => {
                let rule = "be longer for a change of any size to reach a threshold";
                OutOfRange::new(reference, rule, n)
            }
            Remedy::LongerReference(n) => {
                let rule = format!("be at least {least} with a reference of {n} blocks");
                let remedy = " (lengthen the reference: in this one no change, however large, climbs higher)";
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
