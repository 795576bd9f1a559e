//! The rank sum W and the exceedances T, eq. (12) of [^1] and the display above it.
//!
//! W = M₁(M₁+1)/2 + #{(i ∈ Y₁, j ∉ Y₁): y_i > y_j}; T = #{y ∈ Y₂: y < min X or y > max X}.
//!
//! Ties are broken by one random key per sample, which keeps the laws of W and T exact for any exchangeable
//! data. Keys are drawn only if a tie matters, so continuous data do not need them.
//!
//! [^1]: see [`crate::signal`].

use crate::simd::{Vectors, greatest, least};
use serde::{Deserialize, Serialize};

/// The statistics of one trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Statistics {
    /// W.
    pub rank_sum: u64,
    /// T.
    pub exceedances: usize,
    /// The number of samples of Y₁ outside the range of X: T′ less T.
    pub shift_exceedances: usize,
}

/// The whitened samples of one trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pooled<'a> {
    /// X.
    pub reference: &'a [f64],
    /// Y₁.
    pub shift: &'a [f64],
    /// Y₂.
    pub scale: &'a [f64],
}

/// Samples that a sample of Y₁ is compared with at once. The 12 of Fig. 6 are three times as many.
const SIDE_BY_SIDE: usize = 4;

impl Pooled<'_> {
    /// W, T and T′. `keys` gives a random key for each sample, in the order X, Y₁, Y₂.
    #[inline]
    pub fn statistics<'k>(&self, keys: impl FnOnce() -> &'k [u64]) -> Statistics {
        let ((above, reached), (exceedances, on_the_edge)) = Vectors::widest().run(
            #[inline(always)]
            || (self.pairs_won(), self.outside_reference(self.scale)),
        );
        if above != reached || on_the_edge {
            return self.statistics_by_keys(keys());
        }
        Statistics {
            rank_sum: smallest_rank_sum(self.shift.len()) + above,
            exceedances,
            shift_exceedances: self.outside_reference(self.shift).0,
        }
    }

    /// The same by strict comparisons: a tied pair counts in none of them.
    pub fn statistics_strictly(&self) -> Statistics {
        Statistics {
            rank_sum: smallest_rank_sum(self.shift.len()) + self.pairs_won().0,
            exceedances: self.outside_reference(self.scale).0,
            shift_exceedances: self.outside_reference(self.shift).0,
        }
    }

    /// The numbers of pairs (i ∈ Y₁, j ∉ Y₁) with y_i > y_j and with y_i ≥ y_j.
    #[inline(always)]
    fn pairs_won(&self) -> (u64, u64) {
        let (mut above, mut reached) = (0, 0);
        for sample in [self.reference, self.scale] {
            let (arrays, rest) = sample.as_chunks::<SIDE_BY_SIDE>();
            let mut counts = [[0u64; SIDE_BY_SIDE]; 2];
            for others in arrays {
                for &y in self.shift {
                    for lane in 0..SIDE_BY_SIDE {
                        counts[0][lane] += u64::from(y > others[lane]);
                        counts[1][lane] += u64::from(y >= others[lane]);
                    }
                }
            }
            above += counts[0].iter().sum::<u64>();
            reached += counts[1].iter().sum::<u64>();
            for other in rest {
                for y in self.shift {
                    above += u64::from(y > other);
                    reached += u64::from(y >= other);
                }
            }
        }
        (above, reached)
    }

    /// The number of values outside the range of X, and whether one ties with an end of it.
    #[inline(always)]
    fn outside_reference(&self, values: &[f64]) -> (usize, bool) {
        let low = self.reference.iter().copied().fold(f64::INFINITY, least);
        let high = self
            .reference
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, greatest);
        let (mut outside, mut edges) = (0, 0);
        for &y in values {
            outside += usize::from((y < low) | (y > high));
            edges += usize::from((y == low) | (y == high));
        }
        (outside, edges > 0)
    }

    /// W and T by the order of (value, key).
    #[cold]
    fn statistics_by_keys(&self, keys: &[u64]) -> Statistics {
        let (reference_keys, rest) = keys.split_at(self.reference.len());
        let (shift_keys, scale_keys) = rest.split_at(self.shift.len());
        let reference = || keyed(self.reference, reference_keys);
        let shift = || keyed(self.shift, shift_keys);
        let scale = || keyed(self.scale, scale_keys);
        let won: usize = shift()
            .map(|y| {
                reference()
                    .chain(scale())
                    .filter(|other| y.exceeds(*other))
                    .count()
            })
            .sum();
        let is_outside =
            |y: &Keyed| reference().all(|x| y.exceeds(x)) || reference().all(|x| x.exceeds(*y));
        Statistics {
            rank_sum: smallest_rank_sum(self.shift.len()) + won as u64,
            exceedances: scale().filter(is_outside).count(),
            shift_exceedances: shift().filter(is_outside).count(),
        }
    }
}

/// A value and the key that decides its ties.
#[derive(Clone, Copy)]
struct Keyed(f64, u64);

impl Keyed {
    fn exceeds(self, other: Self) -> bool {
        self.0 > other.0 || (self.0 == other.0 && self.1 > other.1)
    }
}

fn keyed(values: &[f64], keys: &[u64]) -> impl Iterator<Item = Keyed> {
    values
        .iter()
        .zip(keys)
        .map(|(&value, &key)| Keyed(value, key))
}

/// M₁(M₁+1)/2.
pub(super) fn smallest_rank_sum(shift: usize) -> u64 {
    (shift as u64) * (shift as u64 + 1) / 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// W and T by their definitions: ranks by sorting the pooled sample, then a sum; exceedances by
    /// comparing with the sorted X.
    fn naive(pooled: Pooled, keys: &[u64]) -> Statistics {
        let (n, m1) = (pooled.reference.len(), pooled.shift.len());
        let values = [pooled.reference, pooled.shift, pooled.scale].concat();
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(keys[a].cmp(&keys[b])));
        let mut rank = vec![0; values.len()];
        for (position, &index) in order.iter().enumerate() {
            rank[index] = position as u64 + 1;
        }
        let low = *rank[..n].iter().min().unwrap();
        let high = *rank[..n].iter().max().unwrap();
        let outside = |ranks: &[u64]| ranks.iter().filter(|&&r| r < low || r > high).count();
        Statistics {
            rank_sum: rank[n..n + m1].iter().sum(),
            exceedances: outside(&rank[n + m1..]),
            shift_exceedances: outside(&rank[n..n + m1]),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Ties are common with few distinct values and rare with many.
        #[test]
        fn agrees_with_the_definition(
            sizes in (1usize..9, 1usize..9, 1usize..9),
            cells in prop::collection::vec(0u8..200, 27),
            distinct in 1u8..200,
            keys in prop::collection::vec(any::<u64>(), 27),
        ) {
            let values: Vec<f64> = cells.iter().map(|c| f64::from(c % distinct) - 3.0).collect();
            let (n, m1, m2) = sizes;
            let pooled = Pooled {
                reference: &values[..n],
                shift: &values[n..n + m1],
                scale: &values[n + m1..n + m1 + m2],
            };
            prop_assert_eq!(pooled.statistics(|| &keys), naive(pooled, &keys));
        }
    }

    #[test]
    fn keys_are_left_alone_without_ties() {
        let pooled = Pooled {
            reference: &[0.0, 1.0],
            shift: &[2.0],
            scale: &[-1.0, 0.5],
        };
        let expected = Statistics {
            rank_sum: 5,
            exceedances: 1,
            shift_exceedances: 1,
        };
        assert_eq!(pooled.statistics(|| unreachable!()), expected);
    }

    /// A tie within one sample changes neither statistic and needs no key.
    #[test]
    fn ties_within_a_sample_do_not_matter() {
        let pooled = Pooled {
            reference: &[0.0, 0.0, 1.0],
            shift: &[2.0, 2.0],
            scale: &[0.5, 0.5],
        };
        assert_eq!(pooled.statistics(|| unreachable!()).exceedances, 0);
    }
}
