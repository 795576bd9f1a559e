//! Impulse noise λ of a moving cage, eqs (4)–(6) of [^1], in units of θ.
//!
//! With probability ν a sample carries an impulse. If the sum S of the impulses so far is not zero,
//! the impulse is −S; else it is +1 or −1 with probability ½ each. So impulses alternate and
//! S ∈ {−1, 0, 1}: vibration causes no net motion.
//!
//! (5), the law of one λ, is exact at every sample. (6), the law of S, is the limit: from S = 0,
//! P(S_i = 0) = (1 + (1 − 2ν)^i)/2.
//!
//! [^1]: see [`crate::signal`].

use crate::rule::OutOfRange;
use crate::values::{NonNegative, Probability};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Impulse noise: how often, how strong, from when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Impulses {
    /// ν, probability of an impulse per raw sample.
    pub nu: Probability,
    /// θ/σ_ξ, strength of an impulse.
    pub theta: NonNegative,
    /// From when on impulses act.
    pub during: During,
}

/// From when on impulses act.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum During {
    /// From the first observation after X.
    Motion,
    /// From the first observation of Y₂.
    Inertial,
}

impl Default for Impulses {
    fn default() -> Self {
        Self::new(0.1, 2.0, During::Motion).expect("each is in its range")
    }
}

impl Impulses {
    /// Impulses of strength `theta`/σ_ξ with probability `nu` a sample.
    ///
    /// # Errors
    /// If `nu` is not a probability or `theta` is negative.
    pub fn new(nu: f64, theta: f64, during: During) -> Result<Self, OutOfRange> {
        Ok(Self {
            nu: Probability::new(nu)?,
            theta: NonNegative::new(theta)?,
            during,
        })
    }

    /// No impulses.
    pub fn none() -> Self {
        Self::new(0.0, 0.0, During::Motion).expect("each is in its range")
    }

    /// Whether impulses never occur or have strength zero.
    pub fn are_absent(&self) -> bool {
        self.nu.get() == 0.0 || self.theta.get() == 0.0
    }

    /// λ/θ for each 64-bit draw, from S = 0. Draws may serve impulses of any ν: a sample that
    /// carries an impulse at some ν carries one at every larger ν.
    #[inline(always)]
    pub fn pattern(&self, draws: &[[u8; 8]], pattern: &mut [f64]) {
        let mut memory = ImpulseMemory::default();
        let chance = chance(self.nu.get());
        pattern.fill(0.0);
        for (draws, pattern) in draws.chunks(64).zip(pattern.chunks_mut(64)) {
            // One bit per sample marks the impulses, since most draws give none.
            let mut fired = 0u64;
            for (i, bits) in draws.iter().enumerate() {
                fired |= u64::from(u64::from_le_bytes(*bits) >> 11 < chance) << i;
            }
            while fired != 0 {
                let i = fired.trailing_zeros() as usize;
                pattern[i] = memory.fire(u64::from_le_bytes(draws[i]));
                fired &= fired - 1;
            }
        }
    }
}

/// The number of impulses among the 2⁵³ values of the upper bits of a draw.
fn chance(nu: f64) -> u64 {
    (nu * (1u64 << 53) as f64).ceil() as u64
}

/// S, the sum of the impulses so far, in units of θ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImpulseMemory(f64);

impl ImpulseMemory {
    /// λ/θ of the next sample: 53 bits of `draw` decide whether there is an impulse, its lowest bit
    /// the sign of one that starts from S = 0.
    #[inline]
    pub fn step(&mut self, nu: f64, draw: u64) -> f64 {
        if draw >> 11 < chance(nu) {
            self.fire(draw)
        } else {
            0.0
        }
    }

    /// λ/θ of a sample that carries an impulse.
    fn fire(&mut self, draw: u64) -> f64 {
        let fresh = if draw & 1 == 1 { 1.0 } else { -1.0 };
        let impulse = if self.0 == 0.0 { fresh } else { -self.0 };
        self.0 += impulse;
        impulse
    }

    /// S/θ.
    pub fn sum(self) -> f64 {
        self.0
    }
}

impl fmt::Display for During {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;
    use crate::stats::binomial;
    use rand::Rng;

    /// Two-sided exact binomial p-value, doubled smaller tail.
    fn p_value(hits: u64, trials: u64, p: f64) -> f64 {
        let low = binomial::lower_tail(hits, trials, p);
        2.0 * low.min(binomial::upper_tail(hits, trials, p))
    }

    /// (5) at several i, and (6) in its finite form. 4 × (3 + 2) exact tests at 5e-8 each: the
    /// false-failure rate is at most 1e-6.
    #[test]
    fn laws_of_one_impulse_and_of_the_sum() {
        let (nu, trials) = (0.3, 200_000u64);
        for steps in [1, 2, 5, 24] {
            let (mut plus, mut minus, mut none) = (0, 0, 0);
            let (mut at_zero, mut positive) = (0, 0);
            let mut generator = Stream::new(2014, "impulses", &steps.to_string()).at(0);
            for _ in 0..trials {
                let mut memory = ImpulseMemory::default();
                let mut last = 0.0;
                for _ in 0..steps {
                    last = memory.step(nu, generator.next_u64());
                }
                plus += u64::from(last > 0.0);
                minus += u64::from(last < 0.0);
                none += u64::from(last == 0.0);
                at_zero += u64::from(memory.sum() == 0.0);
                positive += u64::from(memory.sum() > 0.0);
            }
            let zero = f64::midpoint(1.0, (1.0 - 2.0 * nu).powi(steps));
            for (name, hits, p) in [
                ("+θ", plus, nu / 2.0),
                ("−θ", minus, nu / 2.0),
                ("none", none, 1.0 - nu),
                ("S = 0", at_zero, zero),
                ("S = +θ", positive, (1.0 - zero) / 2.0),
            ] {
                let p_value = p_value(hits, trials, p);
                println!(
                    "i = {steps}, {name}: {hits}/{trials} at p = {p:.6}, p-value {p_value:.3}"
                );
                assert!(p_value > 5e-8);
            }
        }
    }

    #[test]
    fn impulses_alternate() {
        let impulses = Impulses::new(0.4, 2.0, During::Motion).unwrap();
        let mut generator = Stream::new(1, "impulses", "").at(0);
        let draws: Vec<u64> = (0..10_000).map(|_| generator.next_u64()).collect();
        let bytes: Vec<[u8; 8]> = draws.iter().map(|draw| draw.to_le_bytes()).collect();
        let mut pattern = vec![0.0; draws.len()];
        impulses.pattern(&bytes, &mut pattern);
        let mut memory = ImpulseMemory::default();
        let mut sum: f64 = 0.0;
        for (impulse, draw) in pattern.into_iter().zip(draws) {
            assert_eq!(impulse, memory.step(0.4, draw));
            sum += impulse;
            assert!(sum.abs() <= 1.0);
        }
    }

    #[test]
    fn refusals() {
        let new = |nu, theta| Impulses::new(nu, theta, During::Motion);
        assert_eq!(
            new(1.5, 1.0).unwrap_err().to_string(),
            "must lie in [0, 1], got 1.5"
        );
        assert!(new(f64::NAN, 1.0).is_err());
        let error = new(0.5, -1.0).unwrap_err().to_string();
        assert_eq!(error, "must be zero or positive, got -1");
        assert!(new(0.5, f64::INFINITY).is_err());
    }
}
