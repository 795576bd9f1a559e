//! Quantiles by order statistics [^1], with distribution-free intervals.
//!
//! Of n independent values K are at most the quantile ξ_p, and K ~ Binomial(n, p) where the law is continuous. So
//! P(ξ_p < x₍l₎) = P(K < l) and P(ξ_p ≥ x₍u₎) = P(K ≥ u), and l is the largest and u the smallest rank for which
//! these are at most (1 − confidence)/2. Ties only raise the coverage. Values may be infinite: the delay of an
//! event that never happened is +∞.
//!
//! [^1]: H. A. David, H. N. Nagaraja, "Order Statistics", 3rd ed., 2003, section 7.1.

use crate::stats::binomial::critical_count;

/// A quantile and its interval, infinite where no order statistic gives a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantile {
    /// x₍⌈np⌉₎.
    pub value: f64,
    /// x₍l₎, or −∞.
    pub low: f64,
    /// x₍u₎, or +∞.
    pub high: f64,
}

impl Quantile {
    /// The quantile `p` in (0, 1) of ascending values, each with the number of values up to it. For no
    /// values the estimate is +∞ and the interval (−∞, ∞).
    pub fn of(ascending: &[(f64, u64)], p: f64, confidence: f64) -> Self {
        let n = ascending.last().map_or(0, |(_, number)| *number);
        let tail = (1.0 - confidence) / 2.0;
        let place = |place: u64| {
            let at = ascending.partition_point(|(_, number)| *number < place);
            let value = ascending.get(at).filter(|_| place > 0);
            value.map(|(value, _)| *value)
        };
        // P(K < l) = P(n − K ≥ n + 1 − l), and n − K ~ Binomial(n, 1 − p).
        let l = n + 1 - critical_count(tail, n, 1.0 - p);
        let u = critical_count(tail, n, p);
        let middle = (n as f64 * p).ceil().max(1.0) as u64;
        Self {
            value: place(middle).unwrap_or(f64::INFINITY),
            low: place(l).unwrap_or(f64::NEG_INFINITY),
            high: place(u).unwrap_or(f64::INFINITY),
        }
    }
}

/// The median, of an even number of values the upper of the two in the middle; 0 of nothing.
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::binomial::mass;

    /// Against sums of the binomial law, rank by rank: the interval covers, and no narrower one does.
    #[test]
    fn the_narrowest_places_that_cover() {
        for n in [1u64, 5, 6, 20, 59, 200] {
            let values: Vec<(f64, u64)> = (1..=n).map(|i| (i as f64, i)).collect();
            for p in [0.05, 0.5, 0.95] {
                let quantile = Quantile::of(&values, p, 0.8);
                let below = |l: u64| (0..l).map(|k| mass(k, n, p)).sum::<f64>();
                let from = |u: u64| (u..=n).map(|k| mass(k, n, p)).sum::<f64>();
                match quantile.low {
                    f64::NEG_INFINITY => assert!(below(1) > 0.1, "{n} {p}"),
                    low => assert!(below(low as u64) <= 0.1 && below(low as u64 + 1) > 0.1),
                }
                match quantile.high {
                    f64::INFINITY => assert!(from(n) > 0.1, "{n} {p}"),
                    high => assert!(from(high as u64) <= 0.1 && from(high as u64 - 1) > 0.1),
                }
                assert!(quantile.low <= quantile.value && quantile.value <= quantile.high);
            }
        }
    }

    /// The extremes of six values contain the median with 96.9 % confidence; no interval does with 97 %.
    #[test]
    fn a_textbook_case() {
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, f64::INFINITY];
        let values: Vec<(f64, u64)> = values.into_iter().zip(1..).collect();
        let quantile = Quantile::of(&values, 0.5, 0.96);
        assert_eq!(
            (quantile.low, quantile.value, quantile.high),
            (1.0, 3.0, f64::INFINITY)
        );
        assert_eq!(Quantile::of(&values, 0.5, 0.97).low, f64::NEG_INFINITY);
        let equal = Quantile::of(&[(1.0, 2), (3.0, 6)], 0.5, 0.96);
        assert_eq!((equal.low, equal.value, equal.high), (1.0, 3.0, 3.0));
        let nothing = Quantile::of(&[], 0.5, 0.9);
        assert_eq!(
            (nothing.low, nothing.high),
            (f64::NEG_INFINITY, f64::INFINITY)
        );
    }
}
