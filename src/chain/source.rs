//! The parameters that the noise of a trial depends on.

use crate::detect::Samples;
use crate::fields::further;
use crate::scenario::Scenario;
use crate::signal::{Disturbance, Noise, Sensor};
use crate::simd::LANES;

/// The fields that the text of noise that nothing shares has always named: the text addresses the draws.
const MOTION: &[&str] = &["delta", "delta_at", "profile", "duration", "offset"];
const IMPULSES: &[&str] = &["nu", "theta", "during"];

/// The parameters of a trial's noise, and its length.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Source {
    pub sensor: Sensor,
    pub noise: Noise,
    pub disturbance: Disturbance,
    pub samples: Samples,
    /// Observations before X.
    pub lead: usize,
}

/// A record that does not fit in memory.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "one trial of {samples:.3e} raw samples needs {gigabytes:.1} GB, more than the {limit:.1} GB allowed \
     (lower training, order, the sample sizes, gap or decimation)"
)]
pub struct RecordTooLong {
    /// Raw samples in one trial.
    pub samples: f64,
    /// Memory of the trial, in GB.
    pub gigabytes: f64,
    /// The limit, in GB.
    pub limit: f64,
}

/// The most memory the buffers of one trial may take, in GB; every thread has its own.
const MEMORY_LIMIT: f64 = 0.5;

impl Source {
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            sensor: scenario.sensor.clone(),
            noise: scenario.noise,
            disturbance: scenario.disturbance,
            samples: scenario.samples,
            lead: scenario.whitening.lead(),
        }
    }

    /// The identity of a source's noise in words. It leaves out disturbances: a disturbed rest is the same rest
    /// disturbed. It is part of every draw's coordinates, so changing it changes results.
    pub fn subject(&self) -> String {
        let Self {
            sensor,
            noise,
            samples,
            lead,
            disturbance: _,
        } = self;
        let (gap, decimation) = (samples.gap(), samples.decimation());
        format!("{sensor} {noise} lead {lead} samples {samples} gap {gap} decimation {decimation}")
    }

    /// The subject with everything else that a scenario simulates, except the decision: for points that do
    /// not share noise.
    pub fn subject_of_all(&self, scenario: &Scenario) -> String {
        let (motion, impulses) = (&scenario.motion, &scenario.impulses);
        let (whitening, digitiser) = (&scenario.whitening, &scenario.digitiser);
        format!(
            "{} whitening {} {} {} {} digitiser {:?} {:?} motion {} {} {} {} impulses {} {} {}",
            self.subject(),
            whitening.fit,
            whitening.order,
            whitening.training,
            whitening.includes_reference,
            digitiser.quantum(),
            digitiser.range(),
            scenario.record_delta(),
            motion.profile,
            motion.duration,
            motion.offset,
            impulses.nu.get(),
            impulses.theta.get(),
            impulses.during,
        ) + &further(motion, MOTION)
            + &further(impulses, IMPULSES)
    }

    /// Raw samples before the record proper: 0 if the noise starts out stationary.
    pub fn burn_in(&self) -> usize {
        if self.noise.is_normal() {
            0
        } else {
            self.sensor.burn_in()
        }
    }

    /// Observations of a trial.
    pub fn observations(&self) -> usize {
        self.lead + self.samples.span()
    }

    /// Observations up to the last of X.
    pub fn rest(&self) -> usize {
        self.lead + self.samples.reference()
    }

    /// Raw samples of a trial without the burn-in.
    pub fn raw_length(&self) -> usize {
        self.observations() * self.samples.decimation()
    }

    /// Observations after X.
    pub fn motion_observations(&self) -> usize {
        self.samples.span() - self.samples.reference()
    }

    /// Refuses a trial whose buffers do not fit in memory: the raw, observed and whitened noise, the same
    /// again for the motion, and the fit. Returns their size in GB.
    pub fn check_memory(&self, scenario: &Scenario) -> Result<f64, RecordTooLong> {
        let decimation = self.samples.decimation() as f64;
        let span = self.samples.span() as f64;
        let after = span - self.samples.reference() as f64;
        let observations = self.lead as f64 + span;
        let samples = observations * decimation + self.burn_in() as f64;
        let whitening = &scenario.whitening;
        let fit =
            2.0 * whitening.training as f64 + (whitening.highest_order() as f64 + 3.0).powi(2);
        let wide = samples + 2.0 * observations + 3.0 * span + whitening.training as f64;
        let values =
            LANES as f64 * wide + samples + after * (LANES as f64 * decimation + 10.0) + fit;
        let gigabytes = 8.0 * values / 1e9;
        if gigabytes > MEMORY_LIMIT {
            Err(RecordTooLong {
                samples,
                gigabytes,
                limit: MEMORY_LIMIT,
            })
        } else {
            Ok(gigabytes)
        }
    }
}
