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
        let first = way.lengths() / 2;
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
    estimates.push(over_drift_removed(sums, trials, confidence));
    estimates
}

/// The RMS error of `track` over that of `drift_removed`, trip by trip.
fn over_drift_removed(sums: &Sums, trials: u64, confidence: f64) -> Estimate {
    let told = sums.counts[COUNTS * Way::Track as usize];
    let square = |way: Way, cases| Mean::new(sums, way.lengths() / 2 + 1, cases, confidence);
    let (track, drift) = (square(Way::Track, told), square(Way::DriftRemoved, trials));
    let product = sums.lengths[Way::ALL.len() * LENGTHS + 2].value() / told.max(1) as f64;
    let ratio = track.ratio(drift, product, told, confidence).root();
    ratio.named("over_drift_removed_track", told, "trips")
}
