//! Disturbances of rest, which occur in real cages but not in [^1].
//!
//! Rest is modelled as stationary noise. Real rest is not stationary: the sensor drifts, machines start and
//! stop, people walk. Each of these acts in rest and motion alike, and makes X, Y₁ and Y₂ differ:
//!
//! - drift: the record rises by a constant amount with every raw sample, training included;
//! - swell: after X the noise is multiplied by a factor;
//! - footfalls: after X, with a given probability per sample, a step jolts the cage by ± its strength, and
//!   the jolt decays by a constant factor per sample.
//!
//! [^1]: see [`crate::signal`].

use crate::rule::OutOfRange;
use crate::simd::Value;
use crate::values::{Probability, bounded_f64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What disturbs the rest; the swell multiplies what the sensor gives, its colour included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Disturbance {
    /// Drift of the sensor, σ_ξ per raw sample.
    pub drift: Drift,
    /// Factor of the sensor's output after X.
    pub swell: Swell,
    /// Probability of a footfall per raw sample after X.
    pub footfalls: Probability,
    /// Strength of a footfall, σ_ξ.
    pub jolt: Jolt,
}

bounded_f64! {
    /// σ_ξ per raw sample.
    Drift: "lie in [-1e6, 1e6]", |x| (-1e6..=1e6).contains(&x),
        { "type": "number", "minimum": -1e6, "maximum": 1e6 };
    /// A factor of the noise.
    Swell: "be positive and at most 1e6 (1 leaves the noise as it is)", |x| x > 0.0 && x <= 1e6,
        { "type": "number", "exclusiveMinimum": 0, "maximum": 1e6 };
    /// σ_ξ.
    Jolt: "lie in [0, 1e6]", |x| (0.0..=1e6).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 1e6 };
}

/// The share of a jolt left after one sample.
const DECAY: f64 = 0.8;

impl Default for Disturbance {
    /// No disturbance.
    fn default() -> Self {
        Self::new(0.0, 1.0, 0.0, 10.0).expect("each is in its range")
    }
}

impl Disturbance {
    /// A drift in σ_ξ per raw sample, a factor `swell` of the noise after X, and footfalls of ± `jolt` σ_ξ with
    /// probability `footfalls` per raw sample after X.
    ///
    /// # Errors
    /// If a value is out of its range.
    pub fn new(drift: f64, swell: f64, footfalls: f64, jolt: f64) -> Result<Self, OutOfRange> {
        Ok(Self {
            drift: Drift::new(drift)?,
            swell: Swell::new(swell)?,
            footfalls: Probability::new(footfalls)?,
            jolt: Jolt::new(jolt)?,
        })
    }

    /// Whether there are footfalls, which need draws.
    pub fn has_footfalls(&self) -> bool {
        self.footfalls.get() > 0.0 && self.jolt.get() > 0.0
    }

    /// Disturbs `record`, whose sample `after` is the first after X. `draws` gives 64 random bits for each
    /// sample of each trial from there on; without footfalls it is not called.
    pub fn act<V: Value>(&self, record: &mut [V], after: usize, mut draws: impl FnMut() -> u64) {
        if *self == Self::default() {
            return;
        }
        let mut jolt = V::default();
        for (i, x) in record.iter_mut().enumerate() {
            if i >= after {
                *x = *x * self.swell.get();
                if self.has_footfalls() {
                    jolt = jolt * DECAY;
                    for jolt in jolt.lanes_mut() {
                        *jolt += self.footfall(draws());
                    }
                    *x = *x + jolt;
                }
            }
            let drift = self.drift.get() * (i as f64 - after as f64);
            x.lanes_mut().iter_mut().for_each(|x| *x += drift);
        }
    }

    /// The jolt of a draw: 53 bits decide whether there is a step, the lowest bit gives its sign.
    fn footfall(&self, draw: u64) -> f64 {
        let uniform = (draw >> 11) as f64 * (1.0 / (1u64 << 53) as f64);
        match (uniform < self.footfalls.get(), draw & 1) {
            (false, _) => 0.0,
            (true, 1) => self.jolt.get(),
            (true, _) => -self.jolt.get(),
        }
    }
}

impl fmt::Display for Disturbance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (drift, swell) = (self.drift.get(), self.swell.get());
        let (footfalls, jolt) = (self.footfalls.get(), self.jolt.get());
        write!(
            f,
            "drift {drift} swell {swell} footfalls {footfalls} {jolt}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acts_as_it_says() {
        let mut record = [1.0; 4];
        let disturbance = Disturbance::new(0.5, 3.0, 0.0, 1.0).unwrap();
        disturbance.act(&mut record, 2, || unreachable!("no footfalls"));
        assert_eq!(record, [0.0, 0.5, 3.0, 3.5]);
        let mut record = [0.0; 4];
        // The first draw is a step upwards; the others are not steps.
        let mut draws = [1, u64::MAX, u64::MAX].into_iter();
        let walking = Disturbance::new(0.0, 1.0, 0.5, 2.0).unwrap();
        walking.act(&mut record, 1, || draws.next().unwrap());
        assert_eq!(record, [0.0, 2.0, 1.6, 1.6 * 0.8]);
    }

    #[test]
    fn refusals() {
        assert!(Disturbance::new(f64::NAN, 1.0, 0.0, 0.0).is_err());
        assert!(Disturbance::new(0.0, 0.0, 0.0, 0.0).is_err());
        assert!(Disturbance::new(0.0, 1.0, 1.1, 0.0).is_err());
        assert!(Disturbance::new(0.0, 1.0, 0.1, -1.0).is_err());
    }
}
