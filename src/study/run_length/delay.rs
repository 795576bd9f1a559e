//! The delay of a change of normal noise: exact with a long reference, simulated with one of N blocks.
//!
//! The change begins with the first block after the reference and does not end. With N blocks the changed ones soon make up
//! much of the ranks, and S climbs no longer: a change not seen within 3 N blocks, when they are three in four, within 50 times
//! its mean delay with a long reference, or within 10 000 blocks, counts as not seen.

use crate::detect::sequential::{Change, Chart, Detector, Step};
use crate::rng::{Generator, Stream, unit};
use crate::signal::white_noise;
use crate::stats::normal::two_sided_quantile;
use crate::stats::tally::Tally;
use libm::sqrt;
use rayon::prelude::*;

/// The delay of one change, in blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// What begins.
    pub change: Change,
    /// The mean with a long reference: at most this.
    pub long: f64,
    /// Of the trials with N blocks, those in which it was seen.
    pub seen: Tally,
    /// The mean of those, and its 95 % interval.
    pub mean: f64,
    #[allow(missing_docs)]
    pub interval: (f64, f64),
}

impl Delay {
    /// Whether it is seen in 99 % of the trials, so that its mean says something.
    pub fn is_nearly_always_seen(&self) -> bool {
        self.seen.rate() >= 0.99
    }
}

/// Seed of the trials.
const SEED: u64 = 2014;

/// So many references later a change is no longer seen.
const LATEST: usize = 3;

/// Nor so many times as late as with a long reference.
const LATEST_DELAY: f64 = 50.0;

/// Nor so many blocks later.
const LATEST_BLOCK: usize = 10_000;

/// Blocks for the trials of one change, some tenth of a microsecond each; those of a reference take a quarter of that.
const WORK: f64 = 2.5e6;

/// The fewest trials, however long they take.
const FEWEST: f64 = 100.0;

/// The delays of some changes, whose trials share their noise: `most` trials each, or fewer where they would take seconds.
pub fn delays(chart: &Chart, threshold: i32, changes: &[Change], most: u64) -> Vec<Delay> {
    let planned = changes.iter();
    let planned = planned.map(|change| Planned::new(chart, threshold, *change, most));
    let planned: Vec<Planned> = planned.collect();
    let trials = planned.iter().map(|it| it.trials).max().unwrap_or(0);
    let trials = (0..trials).into_par_iter().map(|trial| {
        let reference = Reference::new(chart, threshold, trial);
        let each = planned.iter().map(|it| {
            let is_due = trial < it.trials;
            is_due.then(|| reference.seen_after(it)).flatten()
        });
        each.collect()
    });
    let all: Vec<Vec<Option<f64>>> = trials.collect();
    let each = planned.iter().enumerate();
    each.map(|(at, it)| it.delay(&all.iter().filter_map(|seen| seen[at]).collect::<Vec<_>>()))
        .collect()
}

/// A change, and what its trials take.
struct Planned {
    change: Change,
    /// As it happens: with its shift the way that is looked for.
    happens: Change,
    long: f64,
    /// Blocks after which it counts as not seen.
    latest: usize,
    trials: u64,
}

impl Planned {
    fn new(chart: &Chart, threshold: i32, change: Change, most: u64) -> Self {
        let reference = chart.reference();
        let long = chart.delay(threshold, change);
        let latest = (LATEST * reference).min(LATEST_BLOCK) as f64;
        let latest = latest.min(LATEST_DELAY * long);
        // Where some are not seen, those take up to `latest`.
        let work = reference as f64 / 4.0 + latest.min(10.0 * long);
        Self {
            change,
            happens: chart.towards(change),
            long,
            latest: latest as usize,
            trials: most.min((WORK / work).max(FEWEST) as u64),
        }
    }

    /// From the delays of the trials in which it was seen.
    fn delay(&self, seen: &[f64]) -> Delay {
        let n = seen.len() as f64;
        let mean = seen.iter().sum::<f64>() / n;
        let squares = seen.iter().map(|blocks| (blocks - mean) * (blocks - mean));
        let half = two_sided_quantile(0.95) * sqrt(squares.sum::<f64>() / (n - 1.0) / n);
        Delay {
            change: self.change,
            long: self.long,
            seen: Tally {
                hits: seen.len() as u64,
                trials: self.trials,
            },
            mean,
            interval: (mean - half, mean + half),
        }
    }
}

/// One trial at the end of its reference.
struct Reference {
    detector: Detector,
    draws: Generator,
}

impl Reference {
    fn new(chart: &Chart, threshold: i32, trial: u64) -> Self {
        let mut draws = Stream::new(SEED, "delay", "").at(trial);
        let mut detector = chart.detector(threshold);
        detector.begin(&white_noise(chart.reference(), &mut draws));
        Self { detector, draws }
    }

    /// The blocks from the start of a change to its alarm.
    fn seen_after(&self, planned: &Planned) -> Option<f64> {
        let (mut detector, mut draws) = (self.detector.clone(), self.draws.clone());
        let mut noise = Vec::new().into_iter();
        let mut alarms = |_: &usize| {
            let z = noise.next().unwrap_or_else(|| {
                noise = white_noise(64, &mut draws).into_iter();
                noise.next().expect("there are 64")
            });
            let x = planned.happens.of(z);
            matches!(detector.step(x, 1.0 - unit(&mut draws)), Step::Alarm(_))
        };
        (1..=planned.latest)
            .find(|block| alarms(block))
            .map(|blocks| blocks as f64)
    }
}
