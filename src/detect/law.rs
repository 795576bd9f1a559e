//! Exact laws of W and T under H₀, eqs (13)–(15) of [^1], for any sizes, in integers.
//!
//! Under H₀ every assignment of the pooled ranks to X, Y₁ and Y₂ is equally likely (13), so a law
//! is a list of counts. Those of W are the coefficients of the Gaussian binomial
//!
//! ∏_{i=1}^{M₁} (1 − q^{N+M₂+i}) / (1 − q^i),
//!
//! built one factor at a time: a division is a running sum, a multiplication a running difference,
//! and in integers neither loses a digit. For T, N − 1 gaps between the ordered X and the two ends
//! outside them give P(T = t) = (t+1)·C(N+M₂−t−2, N−2)/C(N+M₂, N); for N = 1 nothing can lie between
//! min X and max X, so T = M₂.
//!
//! # W and T are independent: (14)
//! W depends only on *which* positions of the pooled order belong to Y₁. T depends only on the order
//! in which X and Y₂ follow each other once Y₁ is struck out. Under exchangeability, given any set
//! of positions for Y₁, every way of dealing the remaining positions to X and Y₂ is equally likely,
//! so the second does not depend on the first. The tests enumerate all rank vectors of small sizes.
//!
//! [^1]: see [`crate::signal`].

use super::samples::Samples;
use super::statistics::smallest_rank_sum;
use num_bigint::BigUint;

/// The law of an integer statistic whose values are counted by equally likely cases.
#[derive(Clone, Debug)]
pub struct NullLaw {
    first: u64,
    /// How many cases reach `first + i` or more.
    tails: Vec<BigUint>,
}

/// Why laws were refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NullLawError {
    /// The counts would not fit in memory.
    #[error(
        "the exact laws of W and T at {samples} need {megabytes:.0} MB of counts, more than the {limit:.0} MB allowed \
         (lower reference, shift or scale)",
        limit = MEMORY_LIMIT / 1e6
    )]
    TooLarge {
        /// Their sizes.
        samples: Samples,
        /// What it would take.
        megabytes: f64,
    },
}

/// The most memory that counts may take, in bytes: they are minutes of work.
const MEMORY_LIMIT: f64 = 1e8;

impl NullLaw {
    /// The law of the rank sum W.
    ///
    /// # Errors
    /// Where its counts would not fit in memory.
    pub fn rank_sum(samples: &Samples) -> Result<Self, NullLawError> {
        let (m1, others) = (
            samples.shift(),
            samples.reference().saturating_add(samples.scale()),
        );
        check_memory(samples, Self::rank_sum_bytes(samples))?;
        Ok(Self::from_counts(
            smallest_rank_sum(m1),
            gaussian_binomial(m1, others),
        ))
    }

    /// The law of the exceedances T.
    ///
    /// # Errors
    /// Where its counts would not fit in memory.
    pub fn exceedances(samples: &Samples) -> Result<Self, NullLawError> {
        let (n, m2) = (samples.reference(), samples.scale());
        check_memory(samples, Self::exceedances_bytes(samples))?;
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
        let (m1, others) = (
            samples.shift(),
            samples.reference().saturating_add(samples.scale()),
        );
        bytes(m1 as f64 * others as f64 + 1.0, m1, others)
    }

    /// Memory for the counts of T.
    pub(super) fn exceedances_bytes(samples: &Samples) -> f64 {
        let (n, m2) = (samples.reference(), samples.scale());
        bytes(m2 as f64 + 1.0, n, m2)
    }

    /// The law of |2S − 2E S| for this S, which must be symmetric: what a two-sided rule looks at.
    pub fn doubled_deviation(&self) -> Self {
        let last = 2 * self.first + self.tails.len() as u64 - 1;
        let mut counts = vec![BigUint::ZERO; self.tails.len()];
        for (i, count) in self.counts().enumerate() {
            let doubled = 2 * (self.first + i as u64);
            counts[doubled.abs_diff(last) as usize] += count;
        }
        Self::from_counts(0, counts)
    }

    fn from_counts(first: u64, counts: Vec<BigUint>) -> Self {
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

    /// How many cases reach `value` or more.
    pub fn tail_count(&self, value: u64) -> BigUint {
        match value.checked_sub(self.first) {
            None => self.total().clone(),
            Some(i) => self.tails.get(i as usize).cloned().unwrap_or_default(),
        }
    }

    /// How many cases give `value`.
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

    /// The smallest value v with P(S ≥ v) ≤ `level`; one past the last if there is none.
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

/// `numerator`/`denominator` as the nearest f64.
pub(super) fn ratio(numerator: &BigUint, denominator: &BigUint) -> f64 {
    if *numerator == BigUint::ZERO {
        return 0.0;
    }
    // 66 or 67 bits of quotient, and a last bit that remembers whether anything was left over, so
    // that the one rounding is that of the conversion.
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
fn gaussian_binomial(chosen: usize, others: usize) -> Vec<BigUint> {
    let degree = chosen * others;
    let half = degree / 2;
    let (short, long) = (chosen.min(others), chosen.max(others));
    let mut counts = vec![BigUint::ZERO; half + 1];
    counts[0] = BigUint::from(1u8);
    for i in 1..=short {
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

/// Refuses counts that take more memory than is allowed.
pub(super) fn check_memory(samples: &Samples, bytes: f64) -> Result<(), NullLawError> {
    if bytes <= MEMORY_LIMIT {
        return Ok(());
    }
    Err(NullLawError::TooLarge {
        samples: *samples,
        megabytes: bytes / 1e6,
    })
}

/// Memory for `values` counts, none above C(chosen + others, chosen): their digits, and what a vector of digits costs
/// beside them.
fn bytes(values: f64, chosen: usize, others: usize) -> f64 {
    let n = chosen as f64 + others as f64;
    let entropy = [chosen, others].map(|part| {
        let share = part as f64 / n;
        -share * libm::log2(share)
    });
    values * (n * (entropy[0] + entropy[1]) / 8.0 + 40.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    fn sizes(n: usize, m1: usize, m2: usize) -> Samples {
        Samples::contiguous(n, m1, m2).unwrap()
    }

    /// Every way of writing 0 (X), 1 (Y₁) and 2 (Y₂) in a row: all rank vectors, each once.
    fn enumerate(left: [usize; 3], row: &mut Vec<u8>, visit: &mut impl FnMut(&[u8])) {
        if left == [0; 3] {
            return visit(row);
        }
        for label in 0..3 {
            if left[label] > 0 {
                let mut rest = left;
                rest[label] -= 1;
                row.push(label as u8);
                enumerate(rest, row, visit);
                row.pop();
            }
        }
    }

    /// W and T of a row of labels, by their definitions.
    fn statistics(row: &[u8]) -> (u64, u64) {
        let ranks = |label| {
            (1..)
                .zip(row)
                .filter(move |(_, l)| **l == label)
                .map(|(r, _)| r)
        };
        let (low, high) = (ranks(0).min().unwrap(), ranks(0).max().unwrap());
        (
            ranks(1).sum(),
            ranks(2).filter(|&r| r < low || r > high).count() as u64,
        )
    }

    /// (13) and (14) by enumeration: joint counts times the number of all rank vectors equal the
    /// product of the marginal counts, in integers, and the marginals are the laws here.
    #[test]
    fn enumeration_of_all_rank_vectors() {
        for (n, m1, m2) in [
            (1, 1, 1),
            (1, 3, 2),
            (2, 2, 2),
            (2, 3, 4),
            (3, 3, 3),
            (5, 2, 3),
            (4, 4, 4),
        ] {
            let mut joint: HashMap<(u64, u64), u64> = HashMap::new();
            let mut all = 0;
            enumerate([n, m1, m2], &mut Vec::new(), &mut |row| {
                *joint.entry(statistics(row)).or_default() += 1;
                all += 1;
            });
            let samples = sizes(n, m1, m2);
            let (w, t) = (
                NullLaw::rank_sum(&samples).unwrap(),
                NullLaw::exceedances(&samples).unwrap(),
            );
            let cases = w.total() * t.total();
            assert_eq!(cases, BigUint::from(all as u64), "{n}/{m1}/{m2}: (13)");
            for rank_sum in w.first()..=w.last() {
                for exceedances in 0..=m2 as u64 {
                    let counted = joint.get(&(rank_sum, exceedances)).copied().unwrap_or(0);
                    let product = w.count(rank_sum) * t.count(exceedances);
                    assert_eq!(
                        product,
                        BigUint::from(counted),
                        "{n}/{m1}/{m2} {rank_sum} {exceedances}"
                    );
                }
            }
        }
    }

    /// The additive recursion: the largest pooled value belongs to Y₁ or does not.
    fn recursion(m: usize, l: usize) -> Vec<u128> {
        let mut table = vec![vec![vec![1u128]; l + 1]; m + 1];
        for m in 1..=m {
            for l in 1..=l {
                let mut counts = vec![0; m * l + 1];
                for (u, count) in table[m - 1][l].iter().enumerate() {
                    counts[u + l] += count;
                }
                for (u, count) in table[m][l - 1].iter().enumerate() {
                    counts[u] += count;
                }
                table[m][l] = counts;
            }
        }
        table[m][l].clone()
    }

    #[test]
    fn rank_sum_agrees_with_the_recursion() {
        for (n, m1, m2) in [(12, 12, 12), (30, 20, 25)] {
            let law = NullLaw::rank_sum(&sizes(n, m1, m2)).unwrap();
            for (u, count) in recursion(m1, n + m2).into_iter().enumerate() {
                assert_eq!(law.count(law.first() + u as u64), BigUint::from(count));
            }
        }
    }

    fn choose(n: u128, k: u128) -> u128 {
        (0..k).fold(1, |c, i| c * (n - i) / (i + 1))
    }

    #[test]
    fn exceedances_agree_with_the_formula() {
        for (n, m2) in [(12u128, 12u128), (30, 25), (2, 7)] {
            let law = NullLaw::exceedances(&sizes(n as usize, 1, m2 as usize)).unwrap();
            assert_eq!(*law.total(), BigUint::from(choose(n + m2, n)));
            for t in 0..=m2 {
                let count = (t + 1) * choose(n + m2 - t - 2, n - 2);
                assert_eq!(law.count(t as u64), BigUint::from(count));
                let exact = count as f64 / choose(n + m2, n) as f64;
                assert!((law.mass(t as u64) / exact - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn anchors() {
        let samples = sizes(12, 12, 12);
        let (w, t) = (
            NullLaw::rank_sum(&samples).unwrap(),
            NullLaw::exceedances(&samples).unwrap(),
        );
        assert_eq!(w.critical(0.01), 291);
        assert!((w.tail(291) - 0.009972063).abs() < 5e-10);
        assert!((t.tail(7) - 0.0135953695).abs() < 5e-11);
        assert!((t.tail(8) - 0.004711267).abs() < 5e-10);
        assert_eq!((w.first(), w.last()), (78, 366));
        assert_eq!(w.critical(0.0), 367);
    }

    /// Nothing overflows, no tail is lost: the last mass is 1/C(600, 200), about 1e-165.
    #[test]
    fn large_sizes_keep_their_tails() {
        let law = NullLaw::rank_sum(&sizes(200, 200, 200)).unwrap();
        let last = (0..200).fold(1.0, |p, i| p * f64::from(200 - i) / f64::from(600 - i));
        assert!((law.mass(law.last()) / last - 1.0).abs() < 1e-12);
        assert_eq!(law.tail(law.first()), 1.0);
        let t = NullLaw::exceedances(&sizes(200, 200, 200)).unwrap();
        assert!(t.tail(200) > 0.0 && t.tail(0) == 1.0);
    }

    #[test]
    fn doubled_deviation_folds_the_law() {
        for (n, m1, m2) in [(3, 2, 2), (3, 3, 2), (12, 12, 12)] {
            let law = NullLaw::rank_sum(&sizes(n, m1, m2)).unwrap();
            let folded = law.doubled_deviation();
            let centre = law.first() + law.last();
            for deviation in 0..=folded.last() {
                let direct: f64 = (law.first()..=law.last())
                    .filter(|w| (2 * w).abs_diff(centre) >= deviation)
                    .map(|w| law.mass(w))
                    .sum();
                assert!((folded.tail(deviation) - direct).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn refuses_what_does_not_fit_and_says_how_much() {
        let error = NullLaw::rank_sum(&sizes(100_000, 100_000, 100_000)).unwrap_err();
        assert!(error.to_string().contains("MB"), "{error}");
        assert!(NullLaw::rank_sum(&sizes(5000, 12, 5000)).is_ok());
        let error = NullLaw::exceedances(&sizes(300_000, 1, 300_000)).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("laws of W and T at 300000/1/300000"),
            "{error}"
        );
    }

    #[test]
    fn ratio_rounds_to_nearest() {
        let big = |x: u64| BigUint::from(x);
        assert_eq!(ratio(&big(1), &big(100)), 0.01);
        assert_eq!(ratio(&big(1), &big(3)), 1.0 / 3.0);
        assert_eq!(ratio(&big(2), &big(3)), 2.0 / 3.0);
        assert_eq!(ratio(&big(0), &big(3)), 0.0);
        assert_eq!(
            ratio(
                &(BigUint::from(1u8) << 2000u32),
                &(BigUint::from(1u8) << 2900u32)
            ),
            2f64.powi(-900)
        );
    }
}
