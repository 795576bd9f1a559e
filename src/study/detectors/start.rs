//! The starts, and the times of a record.

use crate::detect::running::{self, Told};
use crate::rule::{OutOfRange, Rule};
use crate::signal::{Motion, Profile};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Samples of a second.
pub const SECOND: usize = running::RATE;

/// Rest at the beginning of a record, samples: every detector has learnt.
pub const LEARNING: usize = running::LEARNING;

/// What is looked at of a record at rest, samples.
pub const REST: usize = 120 * SECOND;

/// A pulse of acceleration: straight up, level, straight down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// Its name.
    pub label: String,
    /// How long it lasts, s.
    pub lasts: f64,
    /// How long it takes up, and down, s; 0: a step.
    #[serde(default)]
    pub rise: f64,
}

impl Start {
    /// # Errors
    /// If it has no length, or does not reach its height.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(0.1, 60.0, "s").check("detectors.start.lasts", &self.lasts)?;
        let half = Rule::Within(0.0, self.lasts / 2.0, "s");
        half.check("detectors.start.rise", &self.rise)
    }

    /// Everything but its name.
    pub fn subject(&self) -> String {
        format!("{} s, up in {} s", self.lasts, self.rise)
    }

    /// The acceleration so many samples after the start, in units of Δ.
    pub fn shape(&self, time: f64) -> f64 {
        let samples = |seconds: f64| seconds * SECOND as f64;
        let profile = Profile::Trapezoid {
            rise: samples(self.rise),
        };
        let motion = Motion {
            profile,
            duration: samples(self.lasts) as usize,
            ..Motion::default()
        };
        motion.shape(time)
    }

    /// Its mean in each of the first blocks that the clairvoyant looks at.
    pub fn blocks(&self) -> Vec<f64> {
        let mean = |block: usize| {
            let samples = block * Told::BLOCK..(block + 1) * Told::BLOCK;
            let sum: f64 = samples.map(|i| self.shape(i as f64 + 0.5)).sum();
            sum / Told::BLOCK as f64
        };
        (0..Told::BLOCKS).map(mean).collect()
    }
}
