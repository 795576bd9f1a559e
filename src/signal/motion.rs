//! The regular component of a motion: Δ during the acceleration, eqs (4) and (8) of [^1].
//!
//! [^1] leaves open whether its Δ/σ_ξ is the shift in the record or after whitening, where it becomes
//! Δ(1 − β) by eq. (9); the two differ by 3.287 for the ADXL105. Here it is a setting.
//!
//! [^1]: see [`crate::signal`].

use crate::format::brief;
use crate::values::Size;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;

/// An acceleration: how strong, of what shape, where in the trial.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// Δ/σ_ξ, of either sign.
    pub delta: f64,
    /// Where Δ is measured.
    pub delta_at: DeltaAt,
    /// The shape in time, taken at the middle of each raw sample.
    pub profile: Profile,
    /// Length of the acceleration, samples; where it is left out, to the last of Y₁.
    #[serde(deserialize_with = "at_least_one")]
    #[schemars(with = "Size", extend("default" = null))]
    pub duration: usize,
    /// Samples between the end of X and the start of the acceleration.
    pub offset: usize,
}

impl Default for Motion {
    /// No motion; `duration` is 0 until a scenario fills in what its samples make of it.
    fn default() -> Self {
        Self {
            delta: 0.0,
            delta_at: DeltaAt::Record,
            profile: Profile::Rectangular,
            duration: 0,
            offset: 0,
        }
    }
}

fn at_least_one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    Size::deserialize(deserializer).map(Size::get)
}

/// Where Δ is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DeltaAt {
    /// The shift in the record.
    Record,
    /// The shift after whitening with the sensor's true coefficients.
    Whitened,
}

/// The shape of an acceleration in time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Profile {
    /// Δ at once, and off at once, as in (8).
    Rectangular,
    /// Δ reached after `rise` samples, and left `rise` samples before the end.
    Trapezoid {
        /// In samples.
        rise: f64,
    },
}

/// Why a motion was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// Δ is NaN or infinite.
    #[error("delta: must be finite, got {}", brief(*.0))]
    Delta(f64),
    /// A duration of no samples.
    #[error(
        "duration: must be at least 1, got {duration} with offset {offset} \
         (by default Δ acts to the last of Y1: lower offset or give a duration)"
    )]
    Duration {
        /// The duration, given or by default.
        duration: usize,
        /// The offset of its start.
        offset: usize,
    },
    /// A rise that does not fit twice into the duration.
    #[error(
        "profile.trapezoid.rise: must lie between 0 and half the duration of {duration} samples, got {rise}"
    )]
    Rise {
        /// The rise given.
        rise: f64,
        /// The duration it has to fit into.
        duration: usize,
    },
}

impl Motion {
    /// Checks that the parts of a motion fit together.
    ///
    /// # Errors
    /// If Δ is not finite, the duration is zero, or the rise does not fit.
    pub fn checked(self) -> Result<Self, MotionError> {
        if !self.delta.is_finite() {
            return Err(MotionError::Delta(self.delta));
        }
        if self.duration == 0 {
            return Err(MotionError::Duration {
                duration: self.duration,
                offset: self.offset,
            });
        }
        if let Profile::Trapezoid { rise } = self.profile
            && !(rise >= 0.0 && 2.0 * rise <= self.duration as f64)
        {
            return Err(MotionError::Rise {
                rise,
                duration: self.duration,
            });
        }
        Ok(self)
    }

    /// The shift added to the record for a sensor whose whitened unit step is `step_gain`.
    pub fn record_delta(&self, step_gain: f64) -> f64 {
        match self.delta_at {
            DeltaAt::Record => self.delta,
            DeltaAt::Whitened => self.delta / step_gain,
        }
    }

    /// The acceleration at `time` samples after the end of X, in units of Δ.
    pub fn shape(&self, time: f64) -> f64 {
        let since = time - self.offset as f64;
        let left = self.duration as f64 - since;
        if since < 0.0 || left <= 0.0 {
            return 0.0;
        }
        match self.profile {
            Profile::Trapezoid { rise } if rise > 0.0 => (since.min(left) / rise).min(1.0),
            Profile::Rectangular | Profile::Trapezoid { .. } => 1.0,
        }
    }
}

impl fmt::Display for DeltaAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rectangular => f.write_str("rectangular"),
            Self::Trapezoid { rise } => write!(f, "trapezoid({rise})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(profile: Profile, duration: usize, offset: usize) -> Motion {
        Motion {
            delta: 1.0,
            delta_at: DeltaAt::Record,
            profile,
            duration,
            offset,
        }
    }

    #[test]
    fn shapes() {
        let shape = |motion: Motion| -> Vec<f64> {
            (0..6).map(|i| motion.shape(f64::from(i) + 0.5)).collect()
        };
        let rectangle = motion(Profile::Rectangular, 3, 1);
        assert_eq!(shape(rectangle), [0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
        let trapezoid = motion(Profile::Trapezoid { rise: 2.0 }, 6, 0);
        assert_eq!(shape(trapezoid), [0.25, 0.75, 1.0, 1.0, 0.75, 0.25]);
        let abrupt = motion(Profile::Trapezoid { rise: 0.0 }, 2, 0);
        assert_eq!(shape(abrupt), [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn whitened_delta_is_scaled_back() {
        let mut motion = motion(Profile::Rectangular, 3, 0);
        assert_eq!(motion.record_delta(4.0), 1.0);
        motion.delta_at = DeltaAt::Whitened;
        assert_eq!(motion.record_delta(4.0), 0.25);
    }

    #[test]
    fn refusals() {
        let long_rise = motion(Profile::Trapezoid { rise: 2.0 }, 3, 0);
        assert!(matches!(long_rise.checked(), Err(MotionError::Rise { .. })));
        assert!(motion(Profile::Rectangular, 0, 0).checked().is_err());
        let mut endless = motion(Profile::Rectangular, 3, 0);
        endless.delta = f64::INFINITY;
        assert!(endless.checked().is_err());
    }
}
