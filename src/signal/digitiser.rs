//! The sensor's converter: a step (quantum) and limits (range), in σ_ξ.
//!
//! A quantised record has ties, and a clipped one is not linear in Δ; both violate an assumption of the exact
//! laws, so simulation has to show their effect.

use crate::rule::OutOfRange;
use crate::values::{Positive, bounded_f64};

/// Rounds to multiples of a quantum, then clips.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Digitiser {
    quantum: Option<Quantum>,
    range: Option<Positive>,
}

bounded_f64! {
    /// The step of a converter.
    Quantum: "lie in [1e-9, 1e9] (leave it out for a continuous record)", |x| (1e-9..=1e9).contains(&x),
        { "type": "number", "minimum": 1e-9, "maximum": 1e9 };
}

impl From<(Option<Quantum>, Option<Positive>)> for Digitiser {
    fn from((quantum, range): (Option<Quantum>, Option<Positive>)) -> Self {
        Self { quantum, range }
    }
}

impl Digitiser {
    /// A converter with step `quantum` and limits ± `range`, each optional.
    ///
    /// # Errors
    /// If a value is out of its range.
    pub fn new(quantum: Option<f64>, range: Option<f64>) -> Result<Self, OutOfRange> {
        Ok(Self {
            quantum: quantum.map(Quantum::new).transpose()?,
            range: range.map(Positive::new).transpose()?,
        })
    }

    /// The step.
    pub fn quantum(&self) -> Option<f64> {
        self.quantum.map(Quantum::get)
    }

    /// The limit.
    pub fn range(&self) -> Option<f64> {
        self.range.map(Positive::get)
    }

    /// Whether it leaves the record unchanged, and so linear in the motion.
    pub fn is_transparent(&self) -> bool {
        self.quantum.is_none() && self.range.is_none()
    }

    /// The output code for `x`: a whole number of steps, if there is a step.
    /// Codes add without rounding, so that equal block means stay equal.
    #[inline]
    pub fn code(&self, x: f64) -> f64 {
        let limit = |limit: f64, code: f64| code.clamp(-limit, limit);
        match (self.quantum(), self.range()) {
            (None, None) => x,
            (None, Some(range)) => limit(range, x),
            (Some(quantum), None) => (x / quantum).round_ties_even(),
            (Some(quantum), Some(range)) => {
                // A range of 0.3 has three steps of 0.1, in spite of rounding.
                let last = (range / quantum * (1.0 + 1e-12)).floor();
                limit(last, (x / quantum).round_ties_even())
            }
        }
    }

    /// The value of one code.
    #[inline]
    pub fn unit(&self) -> f64 {
        self.quantum.map_or(1.0, Quantum::get)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_and_clips() {
        let digitiser = Digitiser::new(Some(0.5), Some(2.2)).unwrap();
        assert_eq!(digitiser.code(0.6), 1.0);
        assert_eq!(digitiser.code(-0.8), -2.0);
        assert_eq!(digitiser.code(9.0) * digitiser.unit(), 2.0);
        let meant = Digitiser::new(Some(0.1), Some(0.3)).unwrap();
        assert_eq!(meant.code(9.0), 3.0);
        let limited = Digitiser::new(None, Some(2.2)).unwrap();
        assert_eq!((limited.code(1.3), limited.code(-5.0)), (1.3, -2.2));
        assert!(Digitiser::default().is_transparent());
        assert_eq!(Digitiser::default().code(0.123), 0.123);
    }

    #[test]
    fn refusals() {
        assert!(Digitiser::new(Some(0.0), None).is_err());
        assert!(Digitiser::new(None, Some(f64::NAN)).is_err());
    }
}
