//! Numbers of a claim that keep one rule, checked once, where they are read.

use serde::Deserialize;

/// A value outside its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("must {rule}, got {got}")]
pub struct OutOfRange {
    rule: &'static str,
    got: f64,
}

/// Declares numbers with a rule: a name, the rule in words and as a test.
macro_rules! bounded_f64 {
    ($($(#[$doc:meta])* $name:ident: $rule:literal, $holds:expr;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        #[serde(try_from = "f64")]
        pub struct $name(f64);

        impl $name {
            /// Takes a value that keeps the rule.
            ///
            /// # Errors
            /// Where it does not; NaN never does.
            pub fn new(got: f64) -> Result<Self, OutOfRange> {
                let holds: fn(f64) -> bool = $holds;
                if holds(got) { Ok(Self(got)) } else { Err(OutOfRange { rule: $rule, got }) }
            }

            /// The number.
            pub fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = OutOfRange;

            fn try_from(value: f64) -> Result<Self, OutOfRange> {
                Self::new(value)
            }
        })*
    };
}

bounded_f64! {
    /// A level or a power: a probability that is neither 0 nor 1.
    Level: "lie strictly between 0 and 1", |x| x > 0.0 && x < 1.0;
    /// A difference of two rates that does not count.
    Margin: "lie in [0, 1)", |x| (0.0..1.0).contains(&x);
    /// A multiple of α.
    Excess: "be at least 1", |x| x >= 1.0;
}
