//! The delay of a step in normal noise: exact with a long reference, simulated with one of N blocks.
//!
//! The shift begins with the first block after the reference and does not end. With N blocks the shifted ones soon make up
//! much of the ranks, and S climbs no longer: a shift not seen within 3 N blocks, when they are three in four, counts as not
//! seen.

use crate::detect::sequential::{Chart, Step};
use crate::rng::{Stream, unit};
use crate::signal::white_noise;
use crate::stats::normal::two_sided_quantile;
use crate::stats::tally::Tally;
use libm::sqrt;
use rayon::prelude::*;

/// The delay at one shift, in blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// The shift, in deviations of a block.
    pub shift: f64,
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

/// So many references later a shift is no longer seen.
const LATEST: usize = 3;

/// The delays at some shifts, each simulated by so many trials, whose noise all shifts share.
pub fn delays(chart: &Chart, threshold: i32, shifts: &[f64], trials: u64) -> Vec<Delay> {
    let each = shifts.iter();
    each.map(|shift| delay(chart, threshold, *shift, trials))
        .collect()
}

fn delay(chart: &Chart, threshold: i32, shift: f64, trials: u64) -> Delay {
    let stream = Stream::new(SEED, "delay", "");
    let all = (0..trials).into_par_iter();
    let all: Vec<Option<usize>> = all
        .map(|trial| seen_after(chart, threshold, shift, &stream, trial))
        .collect();
    let seen: Vec<f64> = all.iter().flatten().map(|blocks| *blocks as f64).collect();
    let n = seen.len() as f64;
    let mean = seen.iter().sum::<f64>() / n;
    let squares: f64 = seen
        .iter()
        .map(|blocks| (blocks - mean) * (blocks - mean))
        .sum();
    let half = two_sided_quantile(0.95) * sqrt(squares / (n - 1.0) / n);
    Delay {
        shift,
        long: chart.delay(threshold, shift),
        seen: Tally {
            hits: seen.len() as u64,
            trials,
        },
        mean,
        interval: (mean - half, mean + half),
    }
}

/// The blocks from the start of a shift to its alarm, in one trial.
fn seen_after(
    chart: &Chart,
    threshold: i32,
    shift: f64,
    stream: &Stream,
    trial: u64,
) -> Option<usize> {
    let mut draws = stream.at(trial);
    let mut detector = chart.detector(threshold);
    let latest = LATEST * chart.reference();
    let noise = white_noise(chart.reference() + 64, &mut draws);
    let mut noise = noise.into_iter();
    let mut step = |level: f64| {
        let z = noise.next();
        let z = z.unwrap_or_else(|| white_noise(1, &mut draws)[0]);
        detector.step(z + level, 1.0 - unit(&mut draws))
    };
    for _ in 0..chart.reference() {
        step(0.0);
    }
    let level = chart.sign() * shift;
    (1..=latest).find(|_| matches!(step(level), Step::Alarm(_)))
}
