//! The whitening filter of eq. (9) of [^1]: y_i = r_i − Σ a_p r_{i−p}, its coefficients fitted to a
//! record of rest.
//!
//! | fit | minimises | needs |
//! |---|---|---|
//! | least squares | the forward error over the record alone (covariance method) | 2m + 1 samples |
//! | Yule–Walker | the error of the windowed record, by Levinson's recursion | m + 1 |
//! | Burg | forward plus backward error, order by order | m + 2 |
//!
//! The record's mean is removed before the fit: a mean shifts every whitened sample alike, which
//! ranks do not feel, but the fit does. With the sign convention of eq. (3) an impulse λ_i becomes
//! λ_i − Σ a_p λ_{i−p}; (9) prints a plus there, which its own Δ(1 − β) contradicts.
//!
//! The order m is given, or chosen for each record of rest: see [`Order`] and [`Chosen`].
//!
//! [^1]: see [`crate::signal`].

mod chosen;
mod fit;
mod normal_equations;
mod order;
mod portmanteau;
mod schwarz;
#[cfg(test)]
mod tests;

pub use chosen::{Chosen, OrderError, coefficients};
pub use fit::Fitter;
pub use order::{MOST_ORDER, Order};
pub use portmanteau::{LjungBox, PortmanteauError};

use crate::simd::Value;
use order::SAMPLES_PER_COEFFICIENT;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How a filter comes by its coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Fit {
    /// Covariance method.
    LeastSquares,
    /// Autocorrelation method.
    YuleWalker,
    /// Burg's method.
    Burg,
    /// The sensor's own coefficients, padded with zeros.
    Known,
    /// All zero: no whitening, for comparison. The training record is kept, so that the noise can be
    /// shared with a fitted filter.
    None,
}

/// A whitening filter's order and where its coefficients come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Whitening {
    /// m, order of the filter, or "auto": chosen by BIC on the training record of each trial.
    pub order: Order,
    /// How the filter comes by its coefficients.
    pub fit: Fit,
    /// Samples of rest before X that the filter is fitted to, their mean subtracted; not shared with X.
    pub training: usize,
    /// Whether the training record is the `training` samples that end with X's last: a known mistake, kept
    /// for study.
    pub includes_reference: bool,
}

/// The order of the paper's filter.
pub const DEFAULT_ORDER: usize = 2;

impl Default for Whitening {
    fn default() -> Self {
        Self {
            order: Order::Fixed(DEFAULT_ORDER),
            fit: Fit::LeastSquares,
            training: 256,
            includes_reference: false,
        }
    }
}

/// Why a whitening was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WhiteningError {
    /// m = 0.
    #[error("order: must be at least 1, got 0")]
    NoOrder,
    /// The training record cannot determine the coefficients.
    #[error(
        "training: a {fit} fit of order {order} needs at least {needed} samples, got {training} \
         (raise training or lower order)"
    )]
    TrainingTooShort {
        /// The fit asked for.
        fit: Fit,
        /// Its order.
        order: usize,
        /// The samples needed.
        needed: usize,
        /// The samples given.
        training: usize,
    },
    /// The training record is too short to choose an order.
    #[error(
        "training: order = \"auto\" needs at least {needed} samples, got {training} \
         (raise training or give order a number)"
    )]
    TooShortToChoose {
        /// The samples needed.
        needed: usize,
        /// The samples given.
        training: usize,
    },
    /// An automatic order without a fit.
    #[error(
        "order: \"auto\" chooses among fitted filters, got fit = \"{0}\" \
         (leave order out, or fit the filter)"
    )]
    NothingToChoose(Fit),
    /// A known filter with too few coefficients for the sensor.
    #[error(
        "order: the known filter of this sensor has order {sensor}, got {order} \
         (raise order to {sensor} or fit the filter)"
    )]
    BelowSensor {
        /// The sensor's order.
        sensor: usize,
        /// The order asked for.
        order: usize,
    },
}

impl WhiteningError {
    /// The keys to change, the likeliest cause first.
    pub fn keys(&self) -> &'static [&'static str] {
        match self {
            Self::NoOrder => &["whitening.order"],
            Self::NothingToChoose(_) => &["whitening.order", "whitening.fit"],
            Self::TrainingTooShort { .. } | Self::TooShortToChoose { .. } => {
                &["whitening.training", "whitening.order", "whitening.fit"]
            }
            Self::BelowSensor { .. } => &["whitening.order", "whitening.fit", "sensor.ar"],
        }
    }
}

impl Whitening {
    /// A filter of order `order` fitted to `training` samples of rest before X, or, with
    /// `includes_reference`, to the `training` samples that end with X's last: a known mistake.
    /// A known filter of a sensor of order `sensor_order` has no training.
    ///
    /// # Errors
    /// If the order is zero, the training is too short for the fit or for choosing an order, the known filter is
    /// too short for the sensor, or an order is to be chosen without a fit.
    pub fn new(
        order: impl Into<Order>,
        fit: Fit,
        training: usize,
        includes_reference: bool,
        sensor_order: usize,
    ) -> Result<Self, WhiteningError> {
        let whitening = Self {
            order: order.into(),
            fit,
            training,
            includes_reference,
        };
        whitening.checked(sensor_order)
    }

    /// Checks the parts against each other and against a sensor of order `sensor_order`.
    ///
    /// # Errors
    /// Same as [`Whitening::new`].
    pub fn checked(self, sensor_order: usize) -> Result<Self, WhiteningError> {
        match self.order {
            Order::Fixed(order) => self.check_order(order, sensor_order)?,
            Order::Auto => self.check_choice()?,
        }
        if self.fit != Fit::Known {
            return Ok(self);
        }
        Ok(Self {
            training: 0,
            includes_reference: false,
            ..self
        })
    }

    fn check_order(&self, order: usize, sensor: usize) -> Result<(), WhiteningError> {
        let Self { fit, training, .. } = *self;
        if order == 0 {
            return Err(WhiteningError::NoOrder);
        }
        let needed = match fit {
            Fit::LeastSquares => 2 * order + 1,
            Fit::YuleWalker => order + 1,
            Fit::Burg => order + 2,
            Fit::Known | Fit::None => 0,
        };
        if training < needed {
            return Err(WhiteningError::TrainingTooShort {
                fit,
                order,
                needed,
                training,
            });
        }
        if fit == Fit::Known && order < sensor {
            return Err(WhiteningError::BelowSensor { sensor, order });
        }
        Ok(())
    }

    fn check_choice(&self) -> Result<(), WhiteningError> {
        let Self { fit, training, .. } = *self;
        if matches!(fit, Fit::Known | Fit::None) {
            return Err(WhiteningError::NothingToChoose(fit));
        }
        let needed = SAMPLES_PER_COEFFICIENT;
        if training < needed {
            return Err(WhiteningError::TooShortToChoose { needed, training });
        }
        Ok(())
    }

    /// The most coefficients that its filter can have: m if it is given.
    pub fn highest_order(&self) -> usize {
        self.order.highest(self.training)
    }

    /// The number of samples needed before X.
    pub fn lead(&self) -> usize {
        self.training.max(self.highest_order())
    }
}

/// The whitened sample y_i = r_i − Σ a_p r_{i−p}, where `past` ends with r_{i−1}.
#[inline(always)]
pub fn step<V: Value>(coefficients: &[V], past: &[V], sample: V) -> V {
    let mut rest = sample;
    for (a, r) in coefficients.iter().zip(past.iter().rev()) {
        rest = rest - *a * *r;
    }
    rest
}

/// Whitens `record[start..]` into `whitened`; samples before the record count as zero. The result is that of
/// [`step`] at each sample, computed coefficient by coefficient over all samples.
#[inline(always)]
pub fn whiten(coefficients: &[f64], record: &[f64], start: usize, whitened: &mut [f64]) {
    let length = whitened.len().min(record.len() - start);
    whitened[..length].copy_from_slice(&record[start..start + length]);
    for (back, a) in (1..).zip(coefficients) {
        // The first samples get nothing from before the record.
        let missing = length.min(back - back.min(start));
        let past = &record[start + missing - back.min(start + missing)..];
        for (y, r) in whitened[missing..length].iter_mut().zip(past) {
            *y -= a * r;
        }
    }
}

impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
