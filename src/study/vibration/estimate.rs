//! The outcomes of a measure, from the sums of the trials. Intervals of shares of windows and of trips are those of a mean over
//! lifts, since all of one lift are set beside one guard line.

use super::measure::Measure;
use super::trial::{COUNTS, PAIRS};
use crate::counts::Sums;
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, Mean, share};

/// The means of [`Measure::Baseline`], and what they are of.
const MEANS: [(&str, &str); PAIRS] = [
    ("off", "lifts"),
    ("trips", "lifts"),
    ("windows", "lifts"),
    ("line", "lifts"),
    ("false_windows", "lifts"),
    ("false_trips", "lifts"),
];

/// The shares of a measure, each with the place of the count that it is a share of; none of all trials.
pub fn shares(measure: Measure) -> [(&'static str, Option<usize>); COUNTS] {
    match measure {
        Measure::Baseline => [("stopped", None), ("early", Some(0)), ("guarded", None)],
        Measure::Knock => [("rides", None), ("found", Some(0)), ("elsewhere", Some(0))],
    }
}

/// All outcomes of a point.
pub fn of(measure: Measure, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
    let counts = &sums.counts;
    let shares = shares(measure).into_iter().zip(counts);
    let shares = shares.map(|((name, among), hits)| {
        let trials = among.map_or(trials, |among| counts[among]);
        share(
            name,
            Tally {
                hits: *hits,
                trials,
            },
            "lifts",
            confidence,
        )
    });
    let mut all: Vec<Estimate> = shares.collect();
    match measure {
        Measure::Baseline => {
            all.extend(MEANS.iter().enumerate().map(|(pair, (name, unit))| {
                let mean = Mean::new(sums, pair, trials, confidence);
                let mean = if pair == 0 { mean.root() } else { mean };
                mean.named(name, trials, unit)
            }));
        }
        Measure::Knock => {
            let found = counts[1];
            let off = Mean::new(sums, 0, found, confidence).root();
            all.push(off.named("located", found, "knocks found"));
        }
    }
    all
}
