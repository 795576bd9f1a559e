//! What the means of half seconds say of a sensor: its bias and its noise.
//!
//! A cage at rest and in uniform motion reads the same, so most means are near the bias, and their half-sample mode [^1] does
//! not feel the others. Noise is what neighbouring means differ by where nothing moves the sensor.
//!
//! [^1]: D. R. Bickel, R. Frühwirth, "On a fast, robust estimator of the mode", Computational Statistics & Data Analysis
//! 50 (2006) 3500–3530.

use crate::recording::Sample;
use serde::Serialize;
use std::ops::Range;

/// Length of a mean, s.
const WINDOW: f64 = 0.5;

/// The median of |x| in deviations of a normal x.
const MEDIAN: f64 = 0.674_489_75;

/// A sensor as a record shows it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Level {
    /// m/s².
    pub bias: f64,
    /// S_a, m²/s³.
    pub density: f64,
    /// From so many differences of means.
    #[serde(skip)]
    pub differences: usize,
}

impl Level {
    /// That of a record which nothing moves at these times, s.
    pub fn of(samples: &[Sample], quiet: &[Range<f64>]) -> Self {
        let mut differences = Vec::new();
        for part in quiet {
            let place = |time: f64| samples.partition_point(|sample| sample.time < time);
            let mut means = means(&samples[place(part.start)..place(part.end)]);
            // The last may be of a few samples.
            means.pop();
            differences.extend(means.windows(2).map(|pair| (pair[1] - pair[0]).abs()));
        }
        let deviation = median(&mut differences) / MEDIAN;
        Self {
            bias: half_sample_mode(means(samples)),
            density: WINDOW * deviation * deviation / 2.0,
            differences: differences.len(),
        }
    }

    /// How many times S_a is more than `density`, if it clearly is. From n differences the median's estimate has a relative
    /// error of 2.6/√n; four of them are not chance.
    pub(super) fn excess(&self, density: f64) -> Option<f64> {
        let chance = 4.0 * 2.6 / (self.differences as f64).sqrt();
        let ratio = self.density / density;
        (ratio > 1.0 + chance).then_some(ratio)
    }
}

/// The means of half seconds from the first sample on.
fn means(samples: &[Sample]) -> Vec<f64> {
    let first = samples.first().map_or(0.0, |first| first.time);
    let window = |sample: &Sample| ((sample.time - first) / WINDOW) as u64;
    let windows = samples.chunk_by(|a, b| window(a) == window(b));
    let mean = |samples: &[Sample]| {
        let sum: f64 = samples.iter().map(|sample| sample.acceleration).sum();
        sum / samples.len() as f64
    };
    windows.map(mean).collect()
}

/// Zero of nothing.
fn median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
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

    /// A third of the record accelerates. The median of 260 differences has a relative error of 16 %.
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
        let level = Level::of(&samples, &quiet);
        let density = 0.03f64.powi(2) / 100.0;
        assert!((level.bias - 9.81).abs() < 0.01, "{level:?}");
        assert!((level.density / density - 1.0).abs() < 0.8, "{level:?}");
        assert_eq!(level.excess(density), None);
        assert!(level.excess(density / 4.0).is_some());
        assert_eq!(Level::of(&[], &[]), Level::default());
    }
}
