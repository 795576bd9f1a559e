//! The scenario of one point: the sections of a config with every parameter resolved.
//!
//! Sections are domain types that serde reads directly, so a parameter is a field of one of them and a line of
//! the table in `parameters`. Rules across sections are in `check`.

mod calibration;
mod check;
mod parameters;
mod sections;

pub use calibration::Calibration;
pub use check::{RECORD_KEYS, ScenarioError, blamed};
pub use parameters::{Caption, Cell, PARAMETERS, Parameter, Values, Words, columns, parameter};
pub use sections::{NoiseSection, Sections};

use crate::detect::{Alternative, Exceedances, Method, Rule, Samples, Ties};
use crate::signal::{Digitiser, Disturbance, Impulses, Motion, Noise, Sensor};
use crate::values::{Level, number};
use crate::whiten::Whitening;
use schemars::JsonSchema;
use serde::Deserialize;

/// The simulation and decision of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The sensor.
    pub sensor: Sensor,
    /// The law of ξ.
    pub noise: Noise,
    /// Disturbances of the rest.
    pub disturbance: Disturbance,
    /// The sensor's converter.
    pub digitiser: Digitiser,
    /// The regular component.
    pub motion: Motion,
    /// The vibration.
    pub impulses: Impulses,
    /// The filter.
    pub whitening: Whitening,
    /// X, Y₁ and Y₂.
    pub samples: Samples,
    /// The decision.
    pub detector: Detector,
}

/// How a point decides.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Detector {
    /// Nominal probability of a false alarm.
    #[serde(deserialize_with = "number::<Level, _>")]
    #[schemars(with = "Level")]
    pub alpha: f64,
    /// What decides. `wilcoxon`: W alone; `product`: the product of both p-values; `disjunction`: either statistic;
    /// `conjunction`: both; `{ table = [...] }`: C_W(0), C_W(1), … for every T, each a rank sum or `"never"`;
    /// `likelihood-ratio`: the best order of (W, T) for the motion of the config, from a pilot. Baselines, which must
    /// be calibrated: `student-t` and `variance-ratio` on the whitened samples, `block-means` (Y₁ of the raw record
    /// against all rest, training included), `clairvoyant` (everything known).
    #[serde(rename = "rule")]
    #[schemars(extend("default" = "product"))]
    pub method: Method,
    /// Whose exceedances of the range of X are counted beside W.
    pub exceedances: Exceedances,
    /// The sign of Δ that is looked for.
    pub alternative: Alternative,
    /// What becomes of equal values.
    pub ties: Ties,
    /// Whether pilot runs at rest set the threshold in place of the exact law: `true` promises α with the fitted
    /// filter under normal, Laplace, uniform and Cauchy noise; a table measures it with the noise it names.
    #[serde(rename = "calibrate")]
    #[schemars(extend("default" = false))]
    pub calibration: Calibration,
    /// What moves, for a method that is made for one motion.
    #[serde(skip)]
    pub stated: Option<(Motion, Impulses)>,
    /// Trials of each pilot; 0 where none is needed.
    #[serde(skip)]
    pub pilot: u64,
}

impl Default for Detector {
    fn default() -> Self {
        Self {
            alpha: 0.01,
            method: Method::Rule(Rule::Product),
            exceedances: Exceedances::Scale,
            alternative: Alternative::Greater,
            ties: Ties::Random,
            calibration: Calibration::None,
            stated: None,
            pilot: 0,
        }
    }
}

impl Scenario {
    /// The same scenario without motion, which determines the false-alarm rate.
    pub fn at_rest(&self) -> Self {
        Self {
            motion: Motion {
                duration: self.samples.acceleration(),
                ..Motion::default()
            },
            impulses: Impulses::none(),
            ..self.clone()
        }
    }

    /// Whether anything moves.
    pub fn moves(&self) -> bool {
        self.motion.delta != 0.0 || !self.impulses.are_absent()
    }

    /// Δ in the record.
    pub(crate) fn record_delta(&self) -> f64 {
        // Adding zero makes −0 the same as 0.
        self.motion.record_delta(self.sensor.step_gain()) + 0.0
    }

    /// The acceleration in units of Δ, for each raw sample after X.
    pub(crate) fn shape(&self) -> Vec<f64> {
        let decimation = self.samples.decimation();
        let raw = (self.samples.span() - self.samples.reference()) * decimation;
        (0..raw)
            .map(|i| self.motion.shape((i as f64 + 0.5) / decimation as f64))
            .collect()
    }
}

impl Detector {
    /// Whether its region or threshold needs a pilot run.
    pub fn needs_pilot(&self) -> bool {
        self.calibration != Calibration::None || self.method == Method::LikelihoodRatio
    }
}
