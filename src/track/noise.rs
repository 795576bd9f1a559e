//! How noisy the sensor and the cage are.
//!
//! A data sheet's noise density is one-sided and in g/√Hz: S_a = density²/2 in m²/s³, and a mean over T seconds has the
//! variance S_a/T. Densities serve every sampling rate; deviations of a sample, as the patent has them, fit one.

use crate::recording::GRAVITY;
use serde::{Deserialize, Serialize};

/// Densities of the noise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Densities {
    /// S_a of the acceleration, m²/s³.
    pub acceleration: f64,
    /// S_b of the bias' random walk, m²/s⁵.
    pub bias: f64,
    /// What is left of S_a in uniform motion, as a share.
    pub uniform: f64,
    /// S_v of the speed of a standing cage, m²/s.
    pub standing: f64,
}

/// Standard deviations of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deviations {
    /// m/s².
    pub acceleration: f64,
    /// m/s².
    pub bias: f64,
    /// m/s.
    pub uniform: f64,
    /// m/s.
    pub standing: f64,
}

/// Either of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Noise {
    /// For any rate.
    Density(Densities),
    /// For one.
    Sample(Deviations),
}

/// Variances of one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Variances {
    /// (m/s²)².
    pub acceleration: f64,
    /// (m/s²)².
    pub bias: f64,
    /// (m/s)².
    pub uniform: f64,
    /// (m/s)².
    pub standing: f64,
}

impl Default for Densities {
    /// Those of an MPU-6050, 400 µg/√Hz.
    fn default() -> Self {
        let acceleration = Self::of_sheet(400e-6);
        Self {
            acceleration,
            bias: 1e-8,
            uniform: 0.1,
            standing: acceleration / 400.0,
        }
    }
}

impl Densities {
    /// S_a of a data sheet's density, g/√Hz.
    pub fn of_sheet(density: f64) -> f64 {
        (density * GRAVITY).powi(2) / 2.0
    }

    /// Those of a sensor with so many times the S_a.
    pub(super) fn noisier(self, times: f64) -> Self {
        Self {
            acceleration: self.acceleration * times,
            standing: self.standing * times,
            ..self
        }
    }
}

impl Noise {
    /// S_a where steps take so many seconds, m²/s³.
    pub fn density(&self, seconds: f64) -> f64 {
        self.of_step(seconds).acceleration * seconds
    }

    /// Those of a step of so many seconds.
    pub(super) fn of_step(&self, seconds: f64) -> Variances {
        match *self {
            Self::Density(of) => Variances {
                acceleration: of.acceleration / seconds,
                bias: of.bias * seconds,
                uniform: of.uniform * of.acceleration * seconds,
                standing: of.standing / seconds,
            },
            Self::Sample(of) => Variances {
                acceleration: of.acceleration.powi(2),
                bias: of.bias.powi(2),
                uniform: of.uniform.powi(2),
                standing: of.standing.powi(2),
            },
        }
    }
}
