//! The false-alarm gate: does every scenario at rest keep its level?
//!
//! Each scenario's hypothesis "the false-alarm rate is at most nominal" gets an exact one-sided
//! binomial test; the p-values are corrected together by Holm's rule, so that a gate all of whose
//! scenarios hold fails with probability at most [`FAMILY_LEVEL`]. A scenario that is not rejected
//! passes only if the run could have detected an excess: if it had power [`POWER`] against [`EXCESS`]
//! times nominal, computed at the strictest level that Holm's rule may use. Otherwise the run is
//! inconclusive.
//!
//! # Rare events
//! Plain simulation is enough: `scripts/rare` tests α = 10⁻⁵ with the fitted filter by 10⁸ trials in about a
//! minute on two cores. Importance sampling would be unbiased with normal noise (a decision is a function of
//! the driving noise, whose density is known), but it is not used, for two reasons. Its weighted sums are not
//! counts, so neither the exact test nor results that agree bit for bit on every machine would be possible.
//! And it would fail silently where it matters: a tilt of Y₁ and Y₂ samples the false alarms of the exact law,
//! while an excess comes from single huge innovations that spoil the fit. Such a tilt hardly ever draws them,
//! so the estimate would be small, with a small, wrong interval. Splitting by levels of W has the same fault,
//! and its chains are dependent.

use crate::stats::tally::{self, Tally};

/// The largest probability that a gate fails although every scenario holds.
pub const FAMILY_LEVEL: f64 = 1e-3;

/// The excess over nominal that a run must be able to see.
pub const EXCESS: f64 = 1.2;

/// The smallest probability of detecting that excess.
pub const POWER: f64 = 0.99;

/// False alarms of something with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// In words.
    pub name: String,
    /// What a false alarm can happen in: stops, blocks.
    pub cases: &'static str,
    /// The rate that it promises to keep.
    pub nominal: f64,
    /// The false alarms and the cases in which one could happen.
    pub tally: Tally,
}

/// The result of one scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The level tested against.
    pub nominal: f64,
    /// The false alarms and trials counted.
    pub tally: Tally,
    /// P(at least as many false alarms | rate = nominal).
    pub p_value: f64,
    /// The probability of rejecting a rate of 1.2 nominal.
    pub power: f64,
    /// The conclusion.
    pub verdict: Verdict,
}

/// The conclusion about one scenario or all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Not rejected, by a run with enough power.
    Pass,
    /// Not rejected, by a run without enough power.
    Inconclusive,
    /// Rejected: the false-alarm rate is above nominal.
    Fail,
}

/// Judges scenarios at rest, each by its nominal level and its tally.
pub fn judge(scenarios: &[(f64, Tally)]) -> Vec<Finding> {
    let p_values = scenarios.iter();
    let p_values: Vec<f64> = p_values
        .map(|(nominal, tally)| tally.p_value_above(*nominal))
        .collect();
    let rejected = tally::holm(&p_values, FAMILY_LEVEL);
    let strictest = FAMILY_LEVEL / scenarios.len() as f64;
    (0..scenarios.len())
        .map(|i| {
            let (nominal, tally) = scenarios[i];
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

/// The number of trials that gives every scenario enough power to pass, rounded up to two digits;
/// `None` if it is beyond any practical run.
pub fn trials_for_power(findings: &[Finding]) -> Option<u64> {
    let strictest = FAMILY_LEVEL / findings.len() as f64;
    let nominal = findings
        .iter()
        .map(|finding| finding.nominal)
        .fold(1.0, f64::min);
    let excess = (EXCESS * nominal).min(1.0);
    let sizes = (3..11).flat_map(|power| (10..100).map(move |digits| digits * 10u64.pow(power)));
    sizes.into_iter().find(|&trials| {
        // A size is worth a look only where the excess stands out at all.
        let deviations = (excess - nominal) * (trials as f64 / nominal).sqrt();
        deviations > 4.0 && tally::power_against(excess, nominal, strictest, trials) >= POWER
    })
}

/// The worst verdict of all findings.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(hits: [u64; 3], trials: u64, nominal: f64) -> Vec<Finding> {
        judge(&hits.map(|hits| (nominal, Tally { hits, trials })))
    }

    fn verdicts(hits: [u64; 3], trials: u64) -> Vec<Verdict> {
        findings(hits, trials, 0.01)
            .iter()
            .map(|f| f.verdict)
            .collect()
    }

    /// Holm's rule rejects the second p-value at half the level once the first is gone; Bonferroni
    /// would still ask for a third of it.
    #[test]
    fn scenarios_are_corrected_step_by_step() {
        let n = 200_000;
        let hits = |p: f64| {
            let reach = |k: &u64| {
                Tally {
                    hits: *k,
                    trials: n,
                }
                .p_value_above(0.01)
                    <= p
            };
            (2000..3000).find(reach).unwrap()
        };
        let between = hits(FAMILY_LEVEL / 2.2);
        assert_eq!(verdicts([between, 2000, 2000], n), [Verdict::Pass; 3]);
        let first = hits(FAMILY_LEVEL / 4.0);
        assert_eq!(
            verdicts([between, first, 2000], n),
            [Verdict::Fail, Verdict::Fail, Verdict::Pass]
        );
    }

    /// The shortest run that may pass has power 0.99 against 0.012 at a third of the level; one
    /// twentieth fewer trials may not.
    #[test]
    fn power_decides_between_pass_and_inconclusive() {
        let power = |n| tally::power_against(0.012, 0.01, FAMILY_LEVEL / 3.0, n);
        let enough = (10_000..200_000)
            .step_by(500)
            .find(|&n| power(n) >= 0.991)
            .unwrap();
        let few = enough * 19 / 20;
        assert!(power(few) < 0.99, "{enough}");
        let hits = |n: u64| [n / 100; 3];
        assert_eq!(verdicts(hits(enough), enough), [Verdict::Pass; 3]);
        assert_eq!(verdicts(hits(few), few), [Verdict::Inconclusive; 3]);
        assert_eq!(
            overall(&findings(hits(few), few, 0.01)),
            Verdict::Inconclusive
        );
    }

    #[test]
    fn a_lower_nominal_is_not_kept() {
        let n = 200_000;
        let strict = findings([2000; 3], n, 0.008);
        assert!(
            strict
                .iter()
                .all(|f| f.verdict == Verdict::Fail && f.nominal == 0.008)
        );
        assert_eq!(overall(&strict), Verdict::Fail);
        assert_eq!(overall(&findings([2000; 3], n, 0.01)), Verdict::Pass);
    }
}
