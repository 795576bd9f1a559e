//! The outcomes of a measure, from the sums of the trials.
//!
//! Stops in one building share its map, so the intervals of shares of stops are somewhat too narrow; those of shares of
//! trials are exact. Root mean squares have intervals from the normal law of a mean of squares.

use super::building::variance;
use super::keys::Keys;
use super::measure::Measure;
use crate::counts::Sums;
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, Mean, computed, share};
use libm::{erfc, sqrt};
use std::f64::consts::SQRT_2;

/// All outcomes of a point.
pub fn of(
    measure: Measure,
    keys: &Keys,
    sums: &Sums,
    trials: u64,
    confidence: f64,
) -> Vec<Estimate> {
    let share =
        |outcome, hits, trials, unit| share(outcome, Tally { hits, trials }, unit, confidence);
    match measure {
        Measure::Alarm => {
            let counts = &sums.counts;
            let [at_once, again] = bounds(keys);
            vec![
                share("alarmed", counts[0], trials, "trials"),
                share("alarmed_again", counts[1], trials, "trials"),
                computed("bound", at_once),
                computed("bound_again", again),
                share("false_alarms", counts[3], counts[2], "stops"),
                share("false_again", counts[4], counts[2], "stops"),
                share("false_any", counts[5], counts[2], "stops"),
            ]
        }
        Measure::Stops => {
            let counts = &sums.counts;
            let names = ["false_alarms", "false_again", "false_any", "wrong_floors"];
            let shares = names.iter().zip(&counts[1..]);
            shares
                .map(|(name, hits)| share(name, *hits, counts[0], "stops"))
                .collect()
        }
        Measure::Healing => vec![share("healed", sums.counts[0], trials, "trials")],
        Measure::Position => {
            let mean = |at: usize| Mean::new(sums, at, trials, confidence);
            let mut estimates: Vec<Estimate> = ["position", "reckoned", "map"]
                .iter()
                .zip(0..)
                .map(|(name, at)| mean(at).root().named(name, trials, "trials"))
                .collect();
            estimates.push(mean(3).named("nees", trials, "trials"));
            estimates
        }
    }
}

/// The probability of an alarm at once and judged again, if the map is exact and the start of the trip known to σ_s.
/// The offset then has the variance of the trip and of two stops; of two trips that of their weighted mean.
fn bounds(keys: &Keys) -> [f64; 2] {
    let level = keys.level * keys.level;
    let trip = |storeys: usize| {
        let noise = keys.noise * keys.noise;
        noise * variance(storeys as f64 * keys.storey) + level
    };
    let (inward, outward) = (trip(keys.storeys), trip(keys.next_storeys));
    let both = inward * outward / (inward + outward);
    let gate = sqrt(keys.settings().threshold);
    [inward, both].map(|variance| {
        let offset = keys.offset / sqrt(variance + level);
        0.5 * (erfc((gate - offset) / SQRT_2) + erfc((gate + offset) / SQRT_2))
    })
}
