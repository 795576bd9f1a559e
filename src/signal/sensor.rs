//! The sensor as an autoregression, eqs (1)–(3) of [^1]: x_i = Σ φ_p x_{i−p} + ξ_i.
//!
//! A second-order element K(p) = 1/(a p² + b p + c) sampled by impulse invariance at period T₀ has
//! its poles at e^{(−σ ± jω)T₀} with σ = b/2a and ω² = c/a − σ², so φ₁ = 2e^{−σT₀} cos ωT₀ and
//! φ₂ = −e^{−2σT₀}. The numerator only scales the signal; here it is 1, which makes σ_ξ the unit.
//! (The numerator printed in (2) lacks the factors 1/a and T₀; nothing here depends on it.)
//!
//! [^1]: see [`crate::signal`].

use super::autoregression::{LONGEST_BURN_IN, Start, burn_in, predict, starts};
use crate::simd::Value;
use schemars::JsonSchema;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use std::fmt;

#[cfg(test)]
mod tests;

/// A stable autoregression driven by unit-scale white noise.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(from = "Choice")]
pub struct Sensor {
    /// φ₁, φ₂, …; empty for a sensor whose noise is already white.
    ar: Vec<f64>,
    /// The distributions of the first samples of a stationary record, each given the earlier ones.
    starts: Vec<Start>,
    burn_in: usize,
}

/// K(p) = 1/(a p² + b p + c) and the sampling period, eq. (1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Transfer {
    /// Coefficient of p², s².
    pub a: f64,
    /// Coefficient of p, s.
    pub b: f64,
    /// Stiffness, dimensionless.
    pub c: f64,
    /// T₀, s.
    pub period: f64,
}

/// The ways to say what a sensor is, of which a file takes one.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Choice {
    /// A sensor by its name.
    Model(Model),
    /// φ₁, φ₂, … of x_i = φ₁ x_(i−1) + φ₂ x_(i−2) + … + ξ_i; none for white noise.
    Ar(
        #[serde(deserialize_with = "coefficients")]
        #[schemars(with = "Vec<f64>")]
        Sensor,
    ),
    /// K(p) = 1/(a p² + b p + c), sampled with a period in s.
    Transfer(
        #[serde(deserialize_with = "transfer")]
        #[schemars(with = "Transfer")]
        Sensor,
    ),
}

/// A sensor by its name.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// The coefficients printed in (2).
    Adxl105,
}

impl From<Choice> for Sensor {
    fn from(choice: Choice) -> Self {
        match choice {
            Choice::Model(Model::Adxl105) => Self::adxl105(),
            Choice::Ar(sensor) | Choice::Transfer(sensor) => sensor,
        }
    }
}

impl Default for Sensor {
    fn default() -> Self {
        Self::adxl105()
    }
}

fn coefficients<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Sensor, D::Error> {
    Sensor::from_ar(Vec::deserialize(deserializer)?).map_err(D::Error::custom)
}

fn transfer<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Sensor, D::Error> {
    Sensor::from_transfer(Transfer::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// Why a sensor was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// A coefficient is NaN or infinite.
    #[error("coefficients must be finite numbers, got {0}")]
    NotFinite(f64),
    /// More coefficients than any sensor has.
    #[error("must have at most {MOST_COEFFICIENTS} coefficients, got {0}")]
    TooMany(usize),
    /// A pole lies on or outside the unit circle.
    #[error(
        "unstable autoregression {ar:?}: reflection coefficient {index} is {reflection}, outside (-1, 1) \
         (in x_i = ar[0] x_(i-1) + ar[1] x_(i-2) + ... every pole must lie inside the unit circle)"
    )]
    Unstable {
        /// The coefficients.
        ar: Vec<f64>,
        /// Which reflection coefficient fails, from 1.
        index: usize,
        /// Its value.
        reflection: f64,
    },
    /// The state needs too many samples to become stationary.
    #[error(
        "autoregression {ar:?} needs more than {limit} samples to become stationary \
         (move its poles away from the unit circle)"
    )]
    BarelyStable {
        /// The coefficients.
        ar: Vec<f64>,
        /// The longest burn-in allowed.
        limit: usize,
    },
    /// a, c or the period is not positive.
    #[error("transfer.{name} must be positive, got {value}")]
    NotPositive {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// b² ≥ 4ac.
    #[error(
        "transfer has real poles: b^2 = {square:e} is not below 4ac = {bound:e} \
         (the model is an oscillator; lower b)"
    )]
    RealPoles {
        /// b².
        square: f64,
        /// 4ac.
        bound: f64,
    },
}

/// The most coefficients: predictors of all lower orders are stored, so memory grows with the square.
const MOST_COEFFICIENTS: usize = 1000;

impl Sensor {
    /// The ADXL105 by the coefficients printed in (2).
    pub fn adxl105() -> Self {
        Self::from_ar(vec![-1.5365, -0.75056]).expect("a stable autoregression")
    }

    /// A sensor with the coefficients φ₁, φ₂, …; empty for white noise.
    ///
    /// # Errors
    /// If a pole is not inside the unit circle, or so close to it that the burn-in would be too long.
    pub fn from_ar(ar: Vec<f64>) -> Result<Self, SensorError> {
        if ar.len() > MOST_COEFFICIENTS {
            return Err(SensorError::TooMany(ar.len()));
        }
        if let Some(&value) = ar.iter().find(|value| !value.is_finite()) {
            return Err(SensorError::NotFinite(value));
        }
        let starts = match starts(&ar) {
            Ok(starts) => starts,
            Err((index, reflection)) => {
                return Err(SensorError::Unstable {
                    ar,
                    index,
                    reflection,
                });
            }
        };
        let burn_in = burn_in(&ar);
        if burn_in > LONGEST_BURN_IN {
            Err(SensorError::BarelyStable {
                ar,
                limit: LONGEST_BURN_IN,
            })
        } else {
            Ok(Self {
                ar,
                starts,
                burn_in,
            })
        }
    }

    /// By impulse invariance from the transfer function, eq. (1) → eq. (2).
    ///
    /// # Errors
    /// If a, c or the period is not positive, the poles are real, or the system is unstable.
    pub fn from_transfer(transfer: Transfer) -> Result<Self, SensorError> {
        let Transfer { a, b, c, period } = transfer;
        for (name, value) in [("a", a), ("c", c), ("period", period)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SensorError::NotPositive { name, value });
            }
        }
        if !b.is_finite() {
            return Err(SensorError::NotFinite(b));
        }
        let (square, bound) = (b * b, 4.0 * a * c);
        if square >= bound {
            return Err(SensorError::RealPoles { square, bound });
        }
        let decay = b / (2.0 * a);
        let frequency = (c / a - decay * decay).sqrt();
        let radius = libm::exp(-decay * period);
        Self::from_ar(vec![
            2.0 * radius * libm::cos(frequency * period),
            -radius * radius,
        ])
    }

    /// φ₁, φ₂, …
    pub fn ar(&self) -> &[f64] {
        &self.ar
    }

    /// 1 − β = 1 − Σ φ_p: the response of whitening with the true coefficients to a unit step, eq. (9).
    pub fn step_gain(&self) -> f64 {
        1.0 - self.ar.iter().sum::<f64>()
    }

    /// The next sample after `past` (oldest first, at least the sensor's order) for one innovation.
    #[inline]
    pub fn step(&self, past: &[f64], innovation: f64) -> f64 {
        predict(&self.ar, past, innovation)
    }

    /// Turns white noise into sensor noise in place, from the zero state.
    #[inline(always)]
    pub fn colour<V: Value>(&self, record: &mut [V]) {
        self.continue_from(0, record);
    }

    /// Turns white normal noise into stationary sensor noise in place: the first samples are normal with the same
    /// variances and correlations as all later ones. For other laws no such start is known; they need
    /// [`Sensor::burn_in`].
    #[inline(always)]
    pub fn colour_stationary<V: Value>(&self, record: &mut [V]) {
        let starts = self.starts.len().min(record.len());
        for (i, start) in self.starts[..starts].iter().enumerate() {
            record[i] = predict(&start.ar, &record[..i], record[i] * start.deviation);
        }
        self.continue_from(starts, record);
    }

    /// The recursion from sample `first` on.
    #[inline(always)]
    fn continue_from<V: Value>(&self, first: usize, record: &mut [V]) {
        if let [phi_1, phi_2] = self.ar[..] {
            let back = |p: usize| {
                if first >= p {
                    record[first - p]
                } else {
                    V::default()
                }
            };
            let (mut x1, mut x2) = (back(1), back(2));
            for x in &mut record[first..] {
                // The newest sample is added last, because only this addition has to wait for the step before.
                let next = (*x + x2 * phi_2) + x1 * phi_1;
                (x2, x1) = (x1, next);
                *x = next;
            }
            return;
        }
        for i in first..record.len() {
            record[i] = predict(
                &self.ar,
                &record[i.saturating_sub(self.ar.len())..i],
                record[i],
            );
        }
    }

    /// Samples after the zero state until the noise is stationary up to a billionth of its variance.
    pub fn burn_in(&self) -> usize {
        self.burn_in
    }
}

impl fmt::Display for Sensor {
    /// `ar(-1.5365 -0.75056)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let coefficients: Vec<String> = self.ar.iter().map(f64::to_string).collect();
        write!(f, "ar({})", coefficients.join(" "))
    }
}
