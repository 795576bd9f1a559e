//! The sections of a config, and the scenario made from them.

use super::check::ScenarioError;
use super::{Detector, Scenario};
use crate::detect::Samples;
use crate::signal::{
    Digitiser, Disturbance, Impulses, Motion, Noise, Quantum, Sensor, SensorChoice,
};
use crate::values::Positive;
use crate::whiten::Whitening;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The sections that a file has and a curve may change.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Sections {
    /// The accelerometer, an autoregression; exactly one key says which.
    #[schemars(with = "SensorChoice")]
    pub sensor: Sensor,
    /// The white noise that drives the sensor, and the sensor's converter.
    pub noise: NoiseSection,
    /// What disturbs the rest.
    pub rest: Disturbance,
    /// The acceleration of the cage.
    pub motion: Motion,
    /// Impulses of a vibrating cage.
    pub impulses: Impulses,
    /// The whitening filter.
    pub whitening: Whitening,
    /// The three samples.
    pub samples: Samples,
    /// The decision.
    pub detector: Detector,
}

/// The white noise that drives the sensor, and the sensor's converter.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NoiseSection {
    /// The law of the noise: of unit variance where it has one, else of unit scale (Cauchy, Student's t with 2
    /// degrees of freedom or fewer).
    #[schemars(with = "crate::signal::Law")]
    pub law: Noise,
    /// The converter's step, σ_ξ; left out, the record is continuous.
    pub quantum: Option<Quantum>,
    /// The converter's limits are ± this, σ_ξ; left out, the record has none.
    pub range: Option<Positive>,
}

impl Sections {
    /// The scenario of these sections: missing values are filled in, and the sections are checked against
    /// each other. `pilot` is the number of trials of a pilot, if one is needed.
    ///
    /// # Errors
    /// If two sections do not fit together.
    pub fn scenario(self, pilot: u64) -> Result<Scenario, ScenarioError> {
        let Self {
            sensor,
            noise,
            mut motion,
            mut detector,
            samples,
            whitening,
            ..
        } = self;
        if motion.duration == 0 {
            motion.duration = samples.acceleration().saturating_sub(motion.offset);
        }
        detector.calibration = detector.calibration.completed(&sensor, noise.law);
        if detector.method.states_its_alternative() {
            detector.stated = Some((motion, self.impulses));
        }
        if detector.needs_pilot() {
            detector.pilot = pilot;
        }
        let scenario = Scenario {
            whitening: whitening.checked(sensor.ar().len())?,
            motion: motion.checked()?,
            digitiser: Digitiser::from((noise.quantum, noise.range)),
            noise: noise.law,
            disturbance: self.rest,
            impulses: self.impulses,
            sensor,
            samples,
            detector,
        };
        scenario.check()?;
        Ok(scenario)
    }
}
