//! What one point simulates and decides, every parameter resolved.

use crate::detect::{Alternative, Method, Samples, Ties};
use crate::signal::{DeltaAt, Digitiser, Disturbance, Impulses, Motion, Noise, Profile, Sensor};
use crate::whiten::Whitening;
use std::fmt;

/// The parameters of one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The colour of the noise.
    pub sensor: Sensor,
    /// The law of the white noise behind it.
    pub noise: Noise,
    /// What disturbs the rest.
    pub disturbance: Disturbance,
    /// The sensor's step and limits.
    pub digitiser: Digitiser,
    /// The acceleration.
    pub motion: Motion,
    /// The vibration.
    pub impulses: Impulses,
    /// The filter.
    pub whitening: Whitening,
    /// X, Y₁ and Y₂.
    pub samples: Samples,
    /// The rule.
    pub detector: Detector,
}

/// A decision rule at its level.
#[derive(Clone, Debug, PartialEq)]
pub struct Detector {
    /// α.
    pub alpha: f64,
    /// What decides.
    pub method: Method,
    /// The sign of Δ it is made for.
    pub alternative: Alternative,
    /// What becomes of equal values.
    pub ties: Ties,
    /// Where its false-alarm rate is measured rather than computed.
    pub calibration: Calibration,
    /// The motion that a method is made for, where it needs one stated.
    pub stated: Option<(Motion, Impulses)>,
    /// Trials of each pilot run, where there is any.
    pub pilot: u64,
}

/// What a pilot run at rest has to say about a region or threshold.
#[derive(Clone, Debug, PartialEq)]
pub enum Calibration {
    /// Nothing: the exact laws are trusted.
    None,
    /// That under each of several laws of noise the false-alarm rate is at most α, with 99.9 %
    /// confidence.
    Promise,
    /// That with this sensor and law the measured false-alarm rate is α, as nearly as can be from below.
    Measured {
        /// The sensor of the pilot.
        sensor: Sensor,
        /// The law of the pilot.
        noise: Noise,
    },
}

impl Scenario {
    /// The same under H₀: no acceleration, no impulses.
    pub fn at_rest(&self) -> Self {
        Self {
            motion: Motion {
                delta: 0.0,
                delta_at: DeltaAt::Record,
                profile: Profile::Rectangular,
                duration: self.samples.acceleration(),
                offset: 0,
            },
            impulses: Impulses::none(),
            ..self.clone()
        }
    }

    /// Whether anything is ever added to the noise.
    pub fn moves(&self) -> bool {
        self.motion.delta != 0.0 || !self.impulses.are_absent()
    }

    /// The shift added to the record.
    pub(super) fn record_delta(&self) -> f64 {
        // Adding zero makes −0 the same as 0.
        self.motion.record_delta(self.sensor.step_gain()) + 0.0
    }

    /// The acceleration in units of Δ at the middle of each raw observation after X.
    pub(super) fn shape(&self) -> Vec<f64> {
        let decimation = self.samples.decimation();
        let raw = (self.samples.span() - self.samples.reference()) * decimation;
        (0..raw)
            .map(|i| self.motion.shape((i as f64 + 0.5) / decimation as f64))
            .collect()
    }
}

impl Detector {
    /// Whether its region or threshold has to be found by a pilot run.
    pub fn needs_pilot(&self) -> bool {
        self.calibration != Calibration::None || self.method == Method::LikelihoodRatio
    }
}

impl fmt::Display for Calibration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("no"),
            Self::Promise => f.write_str("promise"),
            Self::Measured { sensor, noise } => write!(f, "measured({sensor} {noise})"),
        }
    }
}
