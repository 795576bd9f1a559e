//! The `product` rule: cells enter in the order of P(S ≥ s) · P(T ≥ t), equal products together.
//!
//! Equal products exist, for example (w − 78, t) = (280, 12) and (288, 10) at 12/12/12, and rounding must
//! not separate them. So the cells near the boundary are ordered in integers.

use super::design::NullLaws;
use crate::stats::bisect::largest_below_one;
use num_bigint::BigUint;

impl NullLaws {
    /// The largest region {P(S ≥ s) · P(T ≥ t) ≤ k} of size at most α. Floating point finds a k
    /// just below; from there on cells enter in the exact order of their products, equal products
    /// together, until the size would exceed α.
    pub(super) fn product(&self, alpha: f64) -> Vec<u64> {
        let mut critical = self.product_start(alpha);
        loop {
            let grown = self.with_next_product(&critical);
            if self.size(&grown) > alpha {
                return critical;
            }
            critical = grown;
        }
    }

    /// The region of a k whose size is below α by more than rounding could change, so that every
    /// cell in it belongs to the exact region too.
    fn product_start(&self, alpha: f64) -> Vec<u64> {
        const MARGIN: f64 = 1.0 - 1e-9;
        let scores: Vec<f64> = (self.score.first()..=self.score.last() + 1)
            .map(|s| self.score.tail(s))
            .collect();
        let region = |k: f64| -> Vec<usize> {
            let column = |t| {
                let tail = self.exceedances.tail(t);
                scores.partition_point(|score| score * tail > k)
            };
            (0..self.columns.len() as u64).map(column).collect()
        };
        let first = self.score.first();
        let masses: Vec<f64> = (0..=self.exceedances.last())
            .map(|t| self.exceedances.mass(t))
            .collect();
        let size = |k: f64| -> f64 {
            let each = region(k).into_iter().zip(&self.columns).zip(&masses);
            each.map(|((c, column), mass)| column.score.tail(first + c as u64) * mass)
                .sum()
        };
        let largest = largest_below_one(|k| size(k) <= alpha * MARGIN);
        let critical = region(largest * MARGIN);
        critical.into_iter().map(|c| first + c as u64).collect()
    }

    /// The region with the cells of the smallest product outside it added.
    pub(super) fn with_next_product(&self, critical: &[u64]) -> Vec<u64> {
        let tails: Vec<BigUint> = (0..)
            .zip(critical)
            .map(|(t, _)| self.exceedances.tail_count(t))
            .collect();
        let next = |t: usize, c: u64| {
            (c > self.score.first()).then(|| self.score.tail_count(c - 1) * &tails[t])
        };
        let smallest = critical
            .iter()
            .enumerate()
            .filter_map(|(t, &c)| next(t, c))
            .min();
        let mut grown = critical.to_vec();
        for (t, c) in grown.iter_mut().enumerate() {
            while next(t, *c).is_some_and(|product| Some(product) <= smallest) {
                *c -= 1;
            }
        }
        grown
    }
}
