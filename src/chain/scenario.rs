//! What one point simulates and decides, every parameter resolved.

use crate::detect::{Alternative, Rule, Samples};
use crate::signal::{DeltaAt, Digitiser, Impulses, Motion, Noise, Profile, Sensor};
use crate::whiten::Whitening;

/// The parameters of one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The colour of the noise.
    pub sensor: Sensor,
    /// The law of the white noise behind it.
    pub noise: Noise,
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
    /// How ϑ is filled.
    pub rule: Rule,
    /// The sign of Δ it is made for.
    pub alternative: Alternative,
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
}
