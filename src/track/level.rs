//! What the means of short windows say of a sensor: its bias and its noise.
//!
//! A cage at rest and in uniform motion reads the same, so most means are near the bias, and their half-sample mode [^1] does
//! not feel the others. Noise is what neighbouring means differ by where nothing changes the speed: at rest that of the sensor,
//! in motion that of the cage too.
//!
//! [^1]: D. R. Bickel, R. Frühwirth, "On a fast, robust estimator of the mode", Computational Statistics & Data Analysis
//! 50 (2006) 3500–3530.

use crate::recording::Sample;
use crate::stats::binomial::upper_tail;
use crate::stats::quantile::median;
use libm::{erfc, sqrt};
use serde::Serialize;
use std::ops::Range;

/// Length of a mean, s, for the bias and for the noise.
const OF_BIAS: f64 = 0.5;
const OF_NOISE: f64 = 0.25;

/// The median of |x| in deviations of a normal x.
const MEDIAN: f64 = 0.674_489_75;

/// A record is noisier if chance would make it look so once in so many.
const CHANCE: f64 = 1e-4;

/// A sensor as a record shows it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Level {
    /// m/s².
    pub bias: f64,
    /// Its noise at rest.
    pub rest: Scatter,
    /// And in uniform motion.
    pub motion: Scatter,
}

/// How noisy a sensor is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Scatter {
    /// S_a, m²/s³; zero where nothing is known of it.
    pub density: f64,
    /// From so many differences of means.
    #[serde(skip)]
    pub differences: usize,
}

impl Level {
    /// That of a record in which the cage rests and moves uniformly at these times, s, and nothing else moves it.
    pub fn of(samples: &[Sample], rest: &[Range<f64>], motion: &[Range<f64>]) -> Self {
        Self {
            bias: half_sample_mode(means(samples, OF_BIAS)),
            rest: Scatter::of(samples, rest),
            motion: Scatter::of(samples, motion),
        }
    }
}

impl Scatter {
    fn of(samples: &[Sample], quiet: &[Range<f64>]) -> Self {
        let mut differences = Vec::new();
        for part in quiet {
            let place = |time: f64| samples.partition_point(|sample| sample.time < time);
            let mut means = means(&samples[place(part.start)..place(part.end)], OF_NOISE);
            // The last may be of a few samples.
            means.pop();
            differences.extend(means.windows(2).map(|pair| (pair[1] - pair[0]).abs()));
        }
        let number = differences.len();
        let deviation = median(differences) / MEDIAN;
        Self {
            density: OF_NOISE * deviation * deviation / 2.0,
            differences: number,
        }
    }

    /// How many times S_a is more than `density`, if it clearly is: half of the differences are so large that chance would
    /// hardly have made them.
    pub(super) fn excess(&self, density: f64) -> Option<f64> {
        let ratio = self.density / density;
        let is_clear = self.half_by_chance(erfc(MEDIAN * sqrt(ratio / 2.0))) < CHANCE;
        is_clear.then_some(ratio)
    }

    /// Whether S_a is clearly less than `density`: half of the differences are that small.
    pub(super) fn lacks(&self, density: f64) -> bool {
        let ratio = self.density / density;
        self.half_by_chance(1.0 - erfc(MEDIAN * sqrt(ratio / 2.0))) < CHANCE
    }

    /// How probable it is that half of the differences are what each is with a probability. Neighbours share a mean, for
    /// which this is some times too small: of white noise 4e-4 to 6e-4 were below 1e-4.
    fn half_by_chance(&self, each: f64) -> f64 {
        let half = (self.differences - self.differences / 2) as u64;
        upper_tail(half, self.differences as u64, each)
    }
}

/// The means of windows from the first sample on.
fn means(samples: &[Sample], seconds: f64) -> Vec<f64> {
    let first = samples.first().map_or(0.0, |first| first.time);
    let window = |sample: &Sample| ((sample.time - first) / seconds) as u64;
    let windows = samples.chunk_by(|a, b| window(a) == window(b));
    let mean = |samples: &[Sample]| {
        let sum: f64 = samples.iter().map(|sample| sample.acceleration).sum();
        sum / samples.len() as f64
    };
    windows.map(mean).collect()
}

/// Zero of nothing. Again and again the half of them that lie closest together.
fn half_sample_mode(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    values.sort_by(f64::total_cmp);
    let mut left = &values[..];
    while left.len() > 2 {
        let half = left.len().div_ceil(2);
        let range = |from: &usize| left[from + half - 1] - left[*from];
        let from = (0..=left.len() - half).min_by(|a, b| range(a).total_cmp(&range(b)));
        let from = from.expect("there is a half");
        left = &left[from..from + half];
    }
    left.iter().sum::<f64>() / left.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lift::{Pickup, Ride};

    #[test]
    fn the_mode_is_where_values_crowd() {
        assert_eq!(half_sample_mode(vec![3.0]), 3.0);
        assert_eq!(
            half_sample_mode(vec![9.0, 1.0, 8.0, 2.0, 2.1, 20.0, 2.2]),
            2.05
        );
    }

    /// A third of the record accelerates. The median of 500 differences has a relative error of 12 %.
    #[test]
    fn trips_do_not_matter() {
        let noise = Ride::still(100.0, 200.0).unwrap();
        let noise = noise.simulate(&Pickup::white(0.03), 2014, 0).record;
        let samples = (0..).zip(noise).map(|(place, noise)| {
            let time = f64::from(place) / 100.0;
            let pulse = if time % 9.0 < 3.0 { 0.8 } else { 0.0 };
            let acceleration = 9.81 + pulse + noise;
            Sample { time, acceleration }
        });
        let samples: Vec<Sample> = samples.collect();
        let quiet: Vec<Range<f64>> = (0..22)
            .map(|trip| 9.0 * f64::from(trip))
            .map(|start| start + 3.0..start + 9.0)
            .collect();
        let level = Level::of(&samples, &quiet, &[]);
        let density = 0.03f64.powi(2) / 100.0;
        let found = level.rest.density / density;
        assert!((level.bias - 9.81).abs() < 0.01, "{level:?}");
        assert!((found - 1.0).abs() < 0.8, "{level:?}");
        assert_eq!(level.rest.excess(density), None);
        assert!(level.rest.excess(density / 4.0).is_some());
        assert_eq!(level.motion.excess(density), None);
        assert_eq!(Level::of(&[], &[], &[]), Level::default());
    }
}
