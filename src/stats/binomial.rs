//! The binomial distribution to full precision: mass, tails, critical counts.
//!
//! The mass is Loader's saddle-point form [^1], whose relative error stays near 1e-14 for any n that
//! a run can reach; the tails add masses outward from the far side of the mean, so no term is
//! subtracted. Elementary functions come from `libm`, because those of the system differ between
//! processors and these numbers reach result files.
//!
//! [^1]: C. Loader, "Fast and accurate computation of binomial probabilities", 2000.

use crate::stats::bisect::first;
use libm::{exp, log, sqrt};
use std::f64::consts::PI;

/// P(K = k) for K ~ Binomial(n, p).
pub fn mass(k: u64, n: u64, p: f64) -> f64 {
    if k > n {
        return 0.0;
    }
    let (x, size, q) = (k as f64, n as f64, 1.0 - p);
    match (k, p) {
        (_, 0.0) => return f64::from(u8::from(k == 0)),
        (_, 1.0) => return f64::from(u8::from(k == n)),
        (0, _) => return exp(size * libm::log1p(-p)),
        _ if k == n => return exp(size * log(p)),
        _ => {}
    }
    let exponent = stirling_error(n)
        - stirling_error(k)
        - stirling_error(n - k)
        - deviance(x, size * p)
        - deviance(size - x, size * q);
    exp(exponent) * sqrt(size / (2.0 * PI * x * (size - x)))
}

/// P(K ≥ k) for K ~ Binomial(n, p).
pub fn upper_tail(k: u64, n: u64, p: f64) -> f64 {
    if k == 0 {
        1.0
    } else if k > n {
        0.0
    } else if (k as f64) < n as f64 * p {
        1.0 - lower_tail(k - 1, n, p)
    } else {
        let odds = p / (1.0 - p);
        let ratio = |j: u64| (n - j) as f64 / (j + 1) as f64 * odds;
        sum_outward(mass(k, n, p), (k..n).map(ratio))
    }
}

/// P(K ≤ k) for K ~ Binomial(n, p).
pub fn lower_tail(k: u64, n: u64, p: f64) -> f64 {
    if k >= n {
        1.0
    } else if k as f64 > n as f64 * p {
        1.0 - upper_tail(k + 1, n, p)
    } else {
        sum_outward(mass(k, n, p), lower_ratios(k, n, p))
    }
}

/// P(K = j − 1) / P(K = j) for j = k, k − 1, … 1.
fn lower_ratios(k: u64, n: u64, p: f64) -> impl Iterator<Item = f64> {
    let odds = (1.0 - p) / p;
    (1..=k)
        .rev()
        .map(move |j| j as f64 / (n - j + 1) as f64 * odds)
}

/// The smallest k in 0 … n + 1 with P(K ≥ k) ≤ `level`.
pub fn critical_count(level: f64, n: u64, p: f64) -> u64 {
    first(0..n + 1, |count| upper_tail(count, n, p) <= level)
}

/// `first` · (1 + r₁ + r₁r₂ + …), cut off where nothing more can change the sum. The series is summed
/// by itself, so that a tiny first term does not drag it through subnormal numbers.
fn sum_outward(first: f64, ratios: impl Iterator<Item = f64>) -> f64 {
    if first == 0.0 {
        return 0.0;
    }
    let (mut term, mut sum) = (1.0, 1.0);
    for ratio in ratios {
        term *= ratio;
        sum += term;
        // From here on the ratios only fall, so the rest is below term · ratio / (1 − ratio).
        if ratio < 1.0 && term * ratio <= sum * (1.0 - ratio) * 1e-17 {
            break;
        }
    }
    (first * sum).min(1.0)
}

/// ln n! − ln(√(2πn) (n/e)ⁿ), Loader's δ(n).
fn stirling_error(n: u64) -> f64 {
    let x = n as f64;
    if n <= 15 {
        let factorial = (1..=n).map(|i| i as f64).product::<f64>();
        return if n == 0 {
            0.0
        } else {
            log(factorial) - (x + 0.5) * log(x) + x - 0.5 * log(2.0 * PI)
        };
    }
    let square = x * x;
    let series = 1.0 / 1260.0 - (1.0 / 1680.0 - 1.0 / 1188.0 / square) / square;
    (1.0 / 12.0 - (1.0 / 360.0 - series / square) / square) / x
}

/// x ln(x/μ) + μ − x, Loader's deviance, by its series where x and μ are close.
fn deviance(x: f64, mean: f64) -> f64 {
    let difference = x - mean;
    if difference.abs() >= 0.1 * (x + mean) {
        return x * log(x / mean) + mean - x;
    }
    let v = difference / (x + mean);
    let mut sum = difference * v;
    let mut term = 2.0 * x * v;
    let mut odd = 1.0;
    loop {
        term *= v * v;
        odd += 2.0;
        let next = sum + term / odd;
        if next == sum {
            return sum;
        }
        sum = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{Binomial, Discrete};
    use statrs::function::beta::beta_reg;

    /// Against an independent library, whose continued fraction is good to about 1e-8 at the mean of
    /// a large n; and there against ratios of terms summed with 60 digits.
    #[test]
    fn agrees_with_statrs() {
        for (n, p) in [(20, 0.3), (1000, 0.01), (200_000, 0.01), (200_000, 0.73)] {
            let oracle = Binomial::new(p, n).unwrap();
            let mean = (n as f64 * p) as u64;
            for k in [1, 2, mean / 2 + 1, mean, mean + 1, mean + mean / 5 + 1] {
                let expected = oracle.pmf(k);
                if expected > 1e-250 {
                    assert!((mass(k, n, p) / expected - 1.0).abs() < 1e-9, "{k} {n} {p}");
                }
                let tail = beta_reg(k as f64, (n - k + 1) as f64, p);
                if tail > 1e-250 {
                    let error = upper_tail(k, n, p) / tail - 1.0;
                    assert!(error.abs() < 1e-8, "{k} {n} {p}: {error}");
                }
            }
        }
        let summed = 0.501_158_712_203_799_4;
        assert!((upper_tail(146_000, 200_000, 0.73) / summed - 1.0).abs() < 1e-13);
    }

    /// Against rationals: C(n, k) p^k q^(n−k) with p = 1/4 is a ratio of integers below 2¹²⁸.
    #[test]
    fn agrees_with_integers() {
        let n = 40u64;
        let mut binomials = vec![1u128];
        for k in 0..n {
            binomials.push(binomials[k as usize] * u128::from(n - k) / u128::from(k + 1));
        }
        let exact: Vec<f64> = (0..=n)
            .map(|k| (binomials[k as usize] * 3u128.pow((n - k) as u32)) as f64 / 2f64.powi(80))
            .collect();
        for k in 0..=n {
            assert!((mass(k, n, 0.25) / exact[k as usize] - 1.0).abs() < 1e-13);
            let tail: f64 = exact[k as usize..].iter().rev().sum();
            assert!((upper_tail(k, n, 0.25) / tail - 1.0).abs() < 1e-13);
            let tail: f64 = exact[..=k as usize].iter().sum();
            assert!((lower_tail(k, n, 0.25) / tail - 1.0).abs() < 1e-13);
        }
    }

    /// Far tails need no more terms than near ones, which need about ten standard deviations.
    #[test]
    fn far_tails_take_few_terms() {
        let (k, n) = (46_000_000u64, 92_000_000u64);
        let mut most = 10 * sqrt(n as f64 / 4.0) as usize;
        for shift in 0..200 {
            let p = 0.5 + 2e-5 * f64::from(shift);
            let mut terms = 0;
            let ratios = lower_ratios(k, n, p).inspect(|_| terms += 1);
            assert!(sum_outward(mass(k, n, p), ratios) <= 0.51);
            assert!(terms <= most, "{terms} at {p}");
            most = terms.max(1);
        }
    }

    #[test]
    fn edges() {
        assert_eq!(mass(0, 10, 0.0), 1.0);
        assert_eq!(mass(10, 10, 1.0), 1.0);
        assert_eq!(mass(11, 10, 0.5), 0.0);
        assert_eq!(upper_tail(0, 10, 0.5), 1.0);
        assert_eq!(upper_tail(11, 10, 0.5), 0.0);
        assert_eq!(lower_tail(10, 10, 0.5), 1.0);
        assert_eq!(critical_count(0.0, 10, 0.5), 11);
        let k = critical_count(1e-4, 200_000, 0.01);
        assert!(upper_tail(k, 200_000, 0.01) <= 1e-4);
        assert!(upper_tail(k - 1, 200_000, 0.01) > 1e-4);
    }
}
