//! Scales: how data become places along an axis.

use crate::stats::normal;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How data become places along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// As they are.
    Linear,
    /// Decimal logarithms, of what is positive.
    Log,
    /// Quantiles of the normal law, of probabilities that are neither 0 nor 1.
    Probit,
}

impl Scale {
    /// All scales by name.
    pub const ALL: [(&'static str, Self); 3] = [
        ("linear", Self::Linear),
        ("log", Self::Log),
        ("probit", Self::Probit),
    ];

    /// Where a value stands; not finite where it has no place.
    pub fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log if value > 0.0 => libm::log10(value),
            Self::Probit if value > 0.0 && value < 1.0 => normal::quantile(value),
            _ => f64::NAN,
        }
    }

    /// The value that stands there.
    pub fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Log => libm::pow(10.0, place),
            Self::Probit => normal::below(place),
        }
    }

    /// What values must do to have a place.
    pub fn rule(self) -> &'static str {
        match self {
            Self::Linear => "be finite",
            Self::Log => "be positive on a logarithmic axis",
            Self::Probit => "lie strictly between 0 and 1 on a probit axis",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_back() {
        for scale in [Scale::Linear, Scale::Log, Scale::Probit] {
            for value in [1e-9, 0.01, 0.3, 0.5, 0.999] {
                let back = scale.value(scale.place(value));
                assert!(
                    (back / value - 1.0).abs() < 1e-9,
                    "{scale:?}: {value} {back}"
                );
            }
        }
        assert!(Scale::Log.place(0.0).is_nan());
        assert!(Scale::Probit.place(1.0).is_nan());
    }
}
