//! Numbers of a claim that keep one rule.

pub use crate::values::Level;
use crate::values::bounded_f64;

bounded_f64! {
    /// A difference of two rates that does not count.
    Margin: "lie in [0, 1)", |x| (0.0..1.0).contains(&x),
        { "type": "number", "minimum": 0, "exclusiveMaximum": 1 };
    /// A multiple of α.
    Excess: "be at least 1", |x| x >= 1.0,
        { "type": "number", "minimum": 1 };
}
