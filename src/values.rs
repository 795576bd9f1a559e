//! Numbers that satisfy a rule by construction: checked once, when they are made or read from a file.

use crate::rule::OutOfRange;
use serde::{Deserialize, Deserializer, Serialize};

/// Declares numbers with a rule: a name, what it is made from, the rule in words and as a test, its JSON
/// Schema. `new` is the only gate, and serde goes through it.
macro_rules! bounded_f64 {
    ($($(#[$doc:meta])* $name:ident: $rule:literal, $holds:expr, $schema:tt;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd, serde::Serialize, serde::Deserialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            /// Checks a value.
            ///
            /// # Errors
            /// If the value breaks the rule, as NaN always does.
            pub fn new(value: f64) -> Result<Self, $crate::rule::OutOfRange> {
                let holds: fn(f64) -> bool = $holds;
                if holds(value) {
                    Ok(Self(value))
                } else {
                    Err($crate::rule::OutOfRange::of($rule, value))
                }
            }

            /// The number.
            pub fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = $crate::rule::OutOfRange;

            fn try_from(value: f64) -> Result<Self, Self::Error> {
                Self::new(value)
            }
        }

        impl From<$name> for f64 {
            fn from(value: $name) -> f64 {
                value.0
            }
        }

        impl schemars::JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn inline_schema() -> bool {
                true
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                schemars::json_schema!($schema)
            }
        })*
    };
}
pub(crate) use bounded_f64;

bounded_f64! {
    /// A probability.
    Probability: "lie in [0, 1]", |x| (0.0..=1.0).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 1 };
    /// A level or a confidence: a probability that is neither 0 nor 1.
    Level: "lie strictly between 0 and 1", |x| x > 0.0 && x < 1.0,
        { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 };
    /// A size of something that is there.
    Positive: "be positive", |x| x > 0.0 && x.is_finite(),
        { "type": "number", "exclusiveMinimum": 0 };
    /// A strength that may be absent.
    NonNegative: "be zero or positive", |x| x >= 0.0 && x.is_finite(),
        { "type": "number", "minimum": 0 };
    /// Any number.
    Finite: "be finite", |x| x.is_finite(),
        { "type": "number" };
}

/// A number of things of which there must be one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "usize", into = "usize")]
pub struct Size(usize);

impl Size {
    /// Checks a number, which must be at least 1.
    ///
    /// # Errors
    /// If the number is 0.
    pub fn new(value: usize) -> Result<Self, OutOfRange> {
        if value > 0 {
            Ok(Self(value))
        } else {
            Err(OutOfRange::of("be at least 1", value))
        }
    }

    /// The number.
    pub fn get(self) -> usize {
        self.0
    }
}

impl TryFrom<usize> for Size {
    type Error = OutOfRange;

    fn try_from(value: usize) -> Result<Self, OutOfRange> {
        Self::new(value)
    }
}

impl From<Size> for usize {
    fn from(size: Size) -> usize {
        size.0
    }
}

impl schemars::JsonSchema for Size {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Size".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "integer", "minimum": 1 })
    }
}

/// Reads a plain number that satisfies the rule of `T`, for `deserialize_with`.
///
/// # Errors
/// If the number breaks the rule.
pub fn number<'de, T, D>(deserializer: D) -> Result<f64, D::Error>
where
    T: Deserialize<'de> + Into<f64>,
    D: Deserializer<'de>,
{
    T::deserialize(deserializer).map(T::into)
}

impl Default for Probability {
    /// 0.
    fn default() -> Self {
        Self(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_nan() {
        assert!(Probability::new(0.0).is_ok() && Probability::new(1.0).is_ok());
        assert!(Level::new(0.0).is_err() && Level::new(1.0).is_err());
        assert!(Positive::new(0.0).is_err() && NonNegative::new(0.0).is_ok());
        let is_refused = [
            Probability::new(f64::NAN).is_err(),
            Finite::new(f64::NAN).is_err(),
        ];
        assert_eq!(is_refused, [true; 2]);
        let error = Probability::new(1.5).unwrap_err();
        assert_eq!(error.to_string(), "must lie in [0, 1], got 1.5");
        assert_eq!(
            Size::new(0).unwrap_err().to_string(),
            "must be at least 1, got 0"
        );
    }
}
