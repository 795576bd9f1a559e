//! Exact laws of W and T under H₀, eqs (13)–(15) of [^1], for any sizes, in integers.
//!
//! Under H₀ every assignment of the pooled ranks to X, Y₁ and Y₂ is equally likely (13), so a law
//! is a list of counts. Those of W are the coefficients of the Gaussian binomial
//!
//! ∏_{i=1}^{M₁} (1 − q^{N+M₂+i}) / (1 − q^i),
//!
//! built one factor at a time: a division is a running sum, a multiplication a running difference, and both
//! are exact in integers. For T, the N − 1 gaps between the ordered X and the two ends outside them give
//! P(T = t) = (t+1)·C(N+M₂−t−2, N−2)/C(N+M₂, N). For N = 1 nothing lies between min X and max X.
//! The formula does not apply, and the law is computed separately.
//!
//! # W and T are independent: (14)
//! W depends only on *which* positions of the pooled order belong to Y₁. T depends only on the relative
//! order of X and Y₂ with Y₁ left out. Under exchangeability, given any set of positions for Y₁, every
//! assignment of the remaining positions to X and Y₂ is equally likely, so T does not depend on W. The tests
//! enumerate all rank vectors of small sizes.
//!
//! [^1]: see [`crate::signal`].

use super::rule::Exceedances;
use super::samples::Samples;
use super::statistics::smallest_rank_sum;
use num_bigint::BigUint;

pub(super) mod needs;
#[cfg(test)]
mod tests;

pub use needs::NullLawError;
pub(super) use needs::{Needs, check};

/// The law of an integer statistic, as counts of equally likely cases.
#[derive(Clone, Debug)]
pub struct NullLaw {
    first: u64,
    /// The number of cases with `first + i` or more.
    tails: Vec<BigUint>,
}

impl NullLaw {
    /// The law of the rank sum W.
    ///
    /// # Errors
    /// If its counts do not fit in memory.
    pub fn rank_sum(samples: &Samples) -> Result<Self, NullLawError> {
        let (m1, others) = shift_and_others(samples);
        check(Exceedances::Scale, samples, |samples| Needs {
            bytes: Self::rank_sum_bytes(samples),
            ..Needs::default()
        })?;
        Ok(Self::from_counts(
            smallest_rank_sum(m1),
            gaussian_binomial(m1, others),
        ))
    }

    /// The law of the exceedances T; with M₁ + M₂ for M₂ that of T′.
    ///
    /// # Errors
    /// If its counts do not fit in memory.
    pub fn exceedances(of: Exceedances, samples: &Samples) -> Result<Self, NullLawError> {
        let (n, m2) = (samples.reference(), of.most(samples));
        check(of, samples, |samples| Needs {
            bytes: Self::exceedances_bytes(of, samples),
            ..Needs::default()
        })?;
        if n == 1 {
            let mut counts = vec![BigUint::ZERO; m2];
            counts.push(BigUint::from(m2 + 1));
            return Ok(Self::from_counts(0, counts));
        }
        // C(N+M₂−t−2, N−2) for t = M₂ … 0, each from the one before.
        let mut counts = Vec::with_capacity(m2 + 1);
        let mut inside = BigUint::from(1u8);
        for t in (0..=m2).rev() {
            counts.push(&inside * (t + 1));
            let (top, chosen) = (n + m2 - t - 2, n - 2);
            inside = inside * (top + 1) / (top + 1 - chosen);
        }
        counts.reverse();
        Ok(Self::from_counts(0, counts))
    }

    /// Memory for the counts of W.
    pub(super) fn rank_sum_bytes(samples: &Samples) -> f64 {
        let (m1, others) = shift_and_others(samples);
        bytes(m1 as f64 * others as f64 + 1.0, &[m1, others])
    }

    /// Memory for the counts of T or T′.
    pub(super) fn exceedances_bytes(of: Exceedances, samples: &Samples) -> f64 {
        let (n, m2) = (samples.reference(), of.most(samples));
        bytes(m2 as f64 + 1.0, &[n, m2])
    }

    /// The law of |2S − 2E S|, the score of a two-sided rule. S must be symmetric.
    pub fn doubled_deviation(&self) -> Self {
        let last = 2 * self.first + self.tails.len() as u64 - 1;
        let mut counts = vec![BigUint::ZERO; self.tails.len()];
        for (i, count) in self.counts().enumerate() {
            // By symmetry 2E S = first + last, a whole number, so doubling avoids fractions.
            let doubled = 2 * (self.first + i as u64);
            counts[doubled.abs_diff(last) as usize] += count;
        }
        Self::from_counts(0, counts)
    }

    pub(super) fn from_counts(first: u64, counts: Vec<BigUint>) -> Self {
        let mut tails = counts;
        for i in (1..tails.len()).rev() {
            let (head, rest) = tails.split_at_mut(i);
            head[i - 1] += &rest[0];
        }
        Self { first, tails }
    }

    /// Smallest value.
    pub fn first(&self) -> u64 {
        self.first
    }

    /// Largest value.
    pub fn last(&self) -> u64 {
        self.first + self.tails.len() as u64 - 1
    }

    /// Number of equally likely cases.
    pub fn total(&self) -> &BigUint {
        &self.tails[0]
    }

    /// The number of cases with `value` or more.
    pub fn tail_count(&self, value: u64) -> BigUint {
        match value.checked_sub(self.first) {
            None => self.total().clone(),
            Some(i) => self.tails.get(i as usize).cloned().unwrap_or_default(),
        }
    }

    /// The number of cases with exactly `value`.
    pub fn count(&self, value: u64) -> BigUint {
        self.tail_count(value) - self.tail_count(value + 1)
    }

    /// P(S ≥ value), correctly rounded.
    pub fn tail(&self, value: u64) -> f64 {
        ratio(&self.tail_count(value), self.total())
    }

    /// P(S = value), correctly rounded.
    pub fn mass(&self, value: u64) -> f64 {
        ratio(&self.count(value), self.total())
    }

    /// The smallest value v with P(S ≥ v) ≤ `level`; at most one past the last value.
    pub fn critical(&self, level: f64) -> u64 {
        let reached = self
            .tails
            .partition_point(|tail| ratio(tail, self.total()) > level);
        self.first + reached as u64
    }

    fn counts(&self) -> impl Iterator<Item = BigUint> {
        (self.first..=self.last()).map(|value| self.count(value))
    }
}

/// M₁, and N + M₂.
fn shift_and_others(samples: &Samples) -> (usize, usize) {
    let others = samples.reference().saturating_add(samples.scale());
    (samples.shift(), others)
}

/// `numerator`/`denominator` as the nearest f64.
pub(super) fn ratio(numerator: &BigUint, denominator: &BigUint) -> f64 {
    if *numerator == BigUint::ZERO {
        return 0.0;
    }
    // 66 or 67 bits of quotient, and a last bit set if there is a remainder, so that the conversion to f64
    // rounds correctly and only once.
    let shift = (denominator.bits() + 66).saturating_sub(numerator.bits());
    let scaled = numerator << shift;
    let mut quotient = &scaled / denominator;
    if &quotient * denominator != scaled {
        quotient |= BigUint::from(1u8);
    }
    let mantissa = u128::try_from(quotient).expect("the quotient has at most 67 bits") as f64;
    // Two exact steps, since 2^−shift alone may underflow where the result does not.
    let half = (shift / 2) as i32;
    mantissa * 2f64.powi(-half) * 2f64.powi(half - shift as i32)
}

/// Coefficients of the Gaussian binomial [chosen + others choose chosen], from q⁰ to
/// q^{chosen·others}. They are symmetric, so only the lower half is computed.
pub(super) fn gaussian_binomial(chosen: usize, others: usize) -> Vec<BigUint> {
    let degree = chosen * others;
    let half = degree / 2;
    let (short, long) = (chosen.min(others), chosen.max(others));
    let mut counts = vec![BigUint::ZERO; half + 1];
    counts[0] = BigUint::from(1u8);
    for i in 1..=short {
        // In place: ascending order divides by 1 − q^i, descending order multiplies by 1 − q^step.
        for u in i..=half {
            let (low, high) = counts.split_at_mut(u);
            high[0] += &low[u - i];
        }
        let step = long + i;
        for u in (step..=half).rev() {
            let (low, high) = counts.split_at_mut(u);
            high[0] -= &low[u - step];
        }
    }
    let mirrored: Vec<BigUint> = counts[..degree - half].iter().rev().cloned().collect();
    counts.extend(mirrored);
    counts
}

/// Memory for `values` counts up to the number of ways to divide a whole into these parts: their digits, and the
/// overhead of a vector of digits.
pub(super) fn bytes(values: f64, parts: &[usize]) -> f64 {
    values * (bits(parts) / 8.0 + 40.0)
}

/// Bits of the number of ways to divide a whole into these parts, at most.
pub(super) fn bits(parts: &[usize]) -> f64 {
    let whole: f64 = parts.iter().map(|&part| part as f64).sum();
    let entropy = parts.iter().map(|&part| {
        let share = part as f64 / whole;
        -share * libm::log2(share)
    });
    whole * entropy.sum::<f64>()
}
