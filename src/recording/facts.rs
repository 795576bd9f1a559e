//! Facts about a recording and its sensor.

use super::error::RecordingProblem;
use super::missing::{SURE, missing};
use super::moment::Moment;
use super::sample::Sample;
use super::steps::{LOOKED_AT, Steps};

/// A time without samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Time of the sample before it, s.
    pub start: f64,
    /// s.
    pub length: f64,
}

/// An interval above this many medians is a gap: four samples or more are missing.
const GAP: f64 = 5.0;

/// Facts about a recording before any resampling.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Samples.
    pub samples: u64,
    /// Time of the first sample, s.
    pub start: f64,
    /// Time of the last sample, s.
    pub end: f64,
    /// One over the median interval, Hz.
    pub rate: f64,
    /// The standard deviation of the intervals over their median, without intervals below 0.5 or above 1.5
    /// medians.
    pub jitter: f64,
    /// How many samples are missing between the first and the last.
    pub missing: u64,
    /// The longest interval.
    pub longest_gap: Gap,
    /// Intervals longer than five medians.
    pub gaps: u64,
    /// The sensor's step, m/s², if its first readings lie on a grid.
    pub quantum: Option<f64>,
    /// The share of samples that equal the one before.
    pub repeats: f64,
    /// The sensor's step along the vertical, m/s², where it is so coarse that many readings repeat the one before.
    pub coarse_step: Option<f64>,
    /// The share of samples at a limit of the sensor, if there clearly is one.
    pub saturated: Option<f64>,
    /// m/s².
    pub mean: f64,
    /// The standard deviation over rest and ride together, m/s².
    pub deviation: f64,
    /// m/s².
    pub least: f64,
    /// m/s².
    pub greatest: f64,
    /// Whether the record has gravity in it.
    pub has_gravity: bool,
    /// What was subtracted from the times of the file, s.
    pub clock_offset: Option<f64>,
    /// The moment of time 0, where the file has dates.
    pub clock_zero: Option<Moment>,
}

impl Facts {
    /// Of samples at increasing times, which come at a rate or else at that of the median interval.
    ///
    /// # Errors
    /// If there are too few samples or only equal ones.
    pub(crate) fn of(
        samples: &[Sample],
        has_gravity: bool,
        rate: Option<f64>,
    ) -> Result<Self, RecordingProblem> {
        let [first, .., last] = samples else {
            let rule = "must have at least 2 readings of the acceleration at different times";
            let remedy = "choose another column with --time or --acceleration";
            return Err(RecordingProblem::must(rule, samples.len(), remedy));
        };
        let accelerations = || samples.iter().map(|sample| sample.acceleration);
        let least = accelerations().fold(f64::INFINITY, f64::min);
        let greatest = accelerations().fold(f64::NEG_INFINITY, f64::max);
        if least == greatest {
            let rule = "readings of the acceleration must differ";
            let remedy = "choose another column with --acceleration";
            return Err(RecordingProblem::must(rule, least, remedy));
        }
        let (mut repeats, mut longest_gap) = (0, Gap::default());
        let mut intervals = Vec::with_capacity(samples.len() - 1);
        for (before, sample) in samples.iter().zip(&samples[1..]) {
            let (start, length) = (before.time, sample.time - before.time);
            intervals.push(length);
            if length > longest_gap.length {
                longest_gap = Gap { start, length };
            }
            repeats += u64::from(sample.acceleration == before.acceleration);
        }
        let middle = (intervals.len() - 1) / 2;
        let median = *intervals.select_nth_unstable_by(middle, f64::total_cmp).1;
        let count = samples.len() as f64;
        let usual = 0.5 * median..=1.5 * median;
        let usual = intervals.iter().filter(|length| usual.contains(length));
        let ((mean, deviation), (period, jitter)) = rayon::join(
            || moments(accelerations()),
            || moments(usual.map(|length| length / median)),
        );
        let steps = Steps::of(accelerations().take(LOOKED_AT).collect());
        let step = steps.quantum.unwrap_or(0.0);
        let at_limits = if steps.levels > FEW_LEVELS {
            at_limit(samples, least, mean, step) + at_limit(samples, greatest, mean, step)
        } else {
            0
        };
        let is_gap = |length: &&f64| **length > GAP * median;
        Ok(Self {
            samples: samples.len() as u64,
            start: first.time,
            end: last.time,
            rate: rate.unwrap_or(1.0 / median),
            jitter,
            missing: missing(samples, period * median, jitter / period),
            gaps: intervals.iter().filter(is_gap).count() as u64,
            longest_gap,
            quantum: steps.quantum,
            repeats: repeats as f64 / count,
            coarse_step: coarse(steps.quantum, repeats as f64 / count),
            saturated: (at_limits > 0).then(|| at_limits as f64 / count),
            mean,
            deviation,
            least,
            greatest,
            has_gravity,
            clock_offset: None,
            clock_zero: None,
        })
    }

    /// The longest interval that is not a gap, s.
    pub fn gap(&self) -> f64 {
        GAP / self.rate
    }

    /// Whether more may be missing: intervals vary so much that one with a lost sample may be usual.
    pub fn may_lack_more(&self) -> bool {
        self.jitter > SURE
    }

    /// The share of the samples that are missing.
    pub fn missing_share(&self) -> f64 {
        self.missing as f64 / (self.missing + self.samples) as f64
    }

    /// What times count from, where that is not the zero of the file.
    pub fn counts_from(&self) -> Option<String> {
        let seconds = self.clock_offset.map(|offset| format!("{offset:.3} s"));
        self.clock_zero.map(|zero| zero.to_string()).or(seconds)
    }

    /// s.
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// A step, where so many readings repeat the one before: half of them do where noise much finer than a step lies between two.
pub(super) fn coarse(step: Option<f64>, repeats: f64) -> Option<f64> {
    step.filter(|_| repeats > 0.4)
}

/// The mean and the standard deviation, by Welford's recursion.
fn moments(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        count += 1.0;
        let deviation = value - mean;
        mean += deviation / count;
        squares += deviation * (value - mean);
    }
    (mean, (squares / f64::max(count, 1.0)).sqrt())
}

/// The number of levels that the noise at rest may cover on a sensor with coarse steps.
const FEW_LEVELS: usize = 20;

/// How many samples are at `extreme`, if that is a limit of the sensor. A signal stays at its extreme for three
/// readings if it is clipped there. By chance this happens only if the steps are so coarse that rest covers few
/// levels, and then the extreme is only a few steps from the mean.
fn at_limit(samples: &[Sample], extreme: f64, mean: f64, step: f64) -> u64 {
    let is_at = |sample: &&Sample| sample.acceleration == extreme;
    let mut runs = samples.chunk_by(|a, b| a.acceleration == b.acceleration);
    let is_limit = runs.any(|run| run.len() >= 3 && is_at(&&run[0]))
        && (extreme - mean).abs() > FEW_LEVELS as f64 * step;
    if is_limit {
        samples.iter().filter(is_at).count() as u64
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lengths: &[f64]) -> Facts {
        let mut time = 0.0;
        let mut samples = vec![Sample {
            time,
            acceleration: 1.0,
        }];
        for length in lengths {
            time += length;
            samples.push(Sample {
                time,
                acceleration: 0.0,
            });
        }
        Facts::of(&samples, false, None).unwrap()
    }

    #[test]
    fn median_jitter_and_gaps() {
        let mut lengths = vec![0.25; 100];
        lengths[50] = 8.0;
        lengths[70] = 0.03125;
        let facts = of(&lengths);
        assert_eq!((facts.rate, facts.jitter, facts.gaps), (4.0, 0.0, 1));
        assert_eq!(
            facts.longest_gap,
            Gap {
                start: 12.5,
                length: 8.0
            }
        );
    }

    /// A third each at 0.99, 1 and 1.01.
    #[test]
    fn jitter_is_relative() {
        for spread in [0.01, 1e-5] {
            let thirds = |i: i32| 1.0 + spread * f64::from(i % 3 - 1);
            let jitter = of(&(0..999).map(thirds).collect::<Vec<_>>()).jitter;
            let expected = spread * (2.0f64 / 3.0).sqrt();
            // Times near 1000 have the deviation of each interval to 1e-13.
            assert!((jitter - expected).abs() < 1e-3 * spread, "{jitter}");
        }
    }
}
