//! What becomes of normal blocks.

use crate::stats::normal;

/// A block z of the standard normal law becomes `growth`·z + `shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// In deviations of a block at rest.
    pub shift: f64,
    /// The deviation over that at rest.
    pub growth: f64,
}

impl Change {
    /// A step of the level.
    pub fn shift(shift: f64) -> Self {
        Self { shift, growth: 1.0 }
    }

    /// Vibration.
    pub fn growth(growth: f64) -> Self {
        Self { shift: 0.0, growth }
    }

    /// A changed block.
    pub fn of(self, z: f64) -> f64 {
        self.growth * z + self.shift
    }

    /// P(U ≤ `u`) of a changed block among many at rest.
    pub(super) fn below(self, u: f64) -> f64 {
        normal::below((normal::quantile(u) - self.shift) / self.growth)
    }
}
