//! The outcomes of every way to measure trips, from the sums of the trials.

use super::trial::{COUNTS, LENGTHS, Way};
use crate::counts::Sums;
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, Mean, computed, quantile, share};
use libm::sqrt;

/// All outcomes of a point.
pub(super) fn of(sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
    let bound = sqrt(Mean::new(sums, 0, trials, confidence).value);
    let mut estimates = vec![computed("bound", bound)];
    for (place, way) in Way::ALL.into_iter().enumerate() {
        let name = |outcome: &str| format!("{outcome}_{}", way.name());
        let [told, within] = [0, 1].map(|at| sums.counts[COUNTS * place + at]);
        let tally = |hits, trials| Tally { hits, trials };
        let first = 1 + LENGTHS / 2 * place;
        let mean = |at: usize| Mean::new(sums, first + at, told, confidence);
        let rms = mean(1).root();
        estimates.extend([
            share(&name("told"), tally(told, trials), "trials", confidence),
            mean(0).named(&name("bias"), told, "trips"),
            rms.named(&name("rms"), told, "trips"),
            rms.over(bound).named(&name("over_bound"), told, "trips"),
            quantile(&name("error_95"), &sums.values[place], 0.95, confidence),
            mean(2).named(&name("nees"), told, "trips"),
            share(&name("within"), tally(within, told), "trips", confidence),
        ]);
    }
    let rms = |way: &str| {
        let name = format!("rms_{way}");
        estimates.iter().find(|it| it.outcome == name).cloned()
    };
    if let (Some(track), Some(drift)) = (rms("track"), rms("drift_removed")) {
        // The ends of the interval as if the errors had nothing in common.
        estimates.push(Estimate {
            outcome: "over_drift_removed_track".to_owned(),
            value: track.value / drift.value,
            low: track.low / drift.high,
            high: track.high / drift.low,
            ..track
        });
    }
    estimates
}
