//! The false-alarm gate: does every scenario at rest keep its level?
//!
//! Each scenario's hypothesis "the false-alarm rate is at most nominal" gets an exact one-sided
//! binomial test; the p-values are corrected together by Holm's rule, so that a gate all of whose
//! scenarios hold fails with probability at most [`FAMILY_LEVEL`]. A scenario that is not rejected
//! passes only where the run could have told: where it had power [`POWER`] against [`EXCESS`] times
//! nominal, computed at the strictest level that Holm's rule may use. Otherwise the run says nothing.

use crate::plan::Point;
use crate::tally::{self, Tally};

/// The probability that a gate fails although every scenario holds, at most.
pub const FAMILY_LEVEL: f64 = 1e-3;

/// The excess over nominal that a run must be able to see.
pub const EXCESS: f64 = 1.2;

/// The probability of seeing it, at least.
pub const POWER: f64 = 0.99;

/// What became of one scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The level tested against.
    pub nominal: f64,
    /// What was counted.
    pub tally: Tally,
    /// P(at least as many false alarms | rate = nominal).
    pub p_value: f64,
    /// The probability of rejecting a rate of 1.2 nominal.
    pub power: f64,
    /// The conclusion.
    pub verdict: Verdict,
}

/// What may be concluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Not rejected, by a run that could have.
    Pass,
    /// Not rejected, by a run that was too short to tell.
    Inconclusive,
    /// Rejected: the false-alarm rate is above nominal.
    Fail,
}

/// Judges scenarios at rest by their tallies, against `nominal` or else each one's own α.
pub fn judge(points: &[Point], tallies: &[Tally], nominal: Option<f64>) -> Vec<Finding> {
    let nominal = |point: &Point| nominal.unwrap_or(point.scenario.detector.alpha);
    let p_value = |(point, tally): (&Point, &Tally)| tally.p_value_above(nominal(point));
    let p_values: Vec<f64> = points.iter().zip(tallies).map(p_value).collect();
    let rejected = tally::holm(&p_values, FAMILY_LEVEL);
    let strictest = FAMILY_LEVEL / points.len() as f64;
    (0..points.len())
        .map(|i| {
            let (nominal, tally) = (nominal(&points[i]), tallies[i]);
            let excess = (EXCESS * nominal).min(1.0);
            let power = tally::power_against(excess, nominal, strictest, tally.trials);
            Finding {
                nominal,
                tally,
                p_value: p_values[i],
                power,
                verdict: match (rejected[i], power >= POWER) {
                    (true, _) => Verdict::Fail,
                    (false, true) => Verdict::Pass,
                    (false, false) => Verdict::Inconclusive,
                },
            }
        })
        .collect()
}

/// The conclusion over all: the worst of them.
pub fn overall(findings: &[Finding]) -> Verdict {
    let any = |verdict| findings.iter().any(|finding| finding.verdict == verdict);
    if any(Verdict::Fail) {
        Verdict::Fail
    } else if any(Verdict::Inconclusive) {
        Verdict::Inconclusive
    } else {
        Verdict::Pass
    }
}
