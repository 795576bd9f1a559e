//! Samples as steps of time: each stands for the time between the middles to its neighbours. Their sum is the integral by
//! the trapezoidal rule, and a sample's noise is in one step alone.

use crate::recording::Sample;

/// A longer step is beside a hole, s: of what the cage did there nothing is known.
pub const HOLE: f64 = 0.25;

/// A sample and the time it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Of the sample, s.
    pub time: f64,
    /// m/s².
    pub acceleration: f64,
    /// s.
    pub seconds: f64,
}

/// Makes steps of samples as they come, each with its successor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Steps {
    /// The latest sample, and when its step began.
    latest: Option<(Sample, f64)>,
}

impl Steps {
    /// Takes a sample; returns the step before.
    pub fn step(&mut self, sample: Sample) -> Option<Step> {
        let Some((latest, from)) = self.latest else {
            self.latest = Some((sample, sample.time));
            return None;
        };
        let to = f64::midpoint(latest.time, sample.time);
        self.latest = Some((sample, to));
        Some(Step {
            time: latest.time,
            acceleration: latest.acceleration,
            seconds: to - from,
        })
    }

    /// The last step.
    pub fn end(&mut self) -> Option<Step> {
        let (latest, from) = self.latest.take()?;
        (latest.time > from).then_some(Step {
            time: latest.time,
            acceleration: latest.acceleration,
            seconds: latest.time - from,
        })
    }

    /// All steps of a record.
    pub fn of(samples: &[Sample]) -> impl Iterator<Item = Step> {
        let mut steps = Self::default();
        let samples = samples.iter().map(Some).chain([None]);
        samples.filter_map(move |sample| match sample {
            Some(sample) => steps.step(*sample),
            None => steps.end(),
        })
    }
}
