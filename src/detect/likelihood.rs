//! The `likelihood-ratio` rule: the most powerful region of (W, T) against one alternative.
//!
//! By the lemma of Neyman and Pearson the most powerful region of a size takes the cells (w, t) in the
//! order of P(w, t | H₁) / P(w, t | H₀). The denominator is exact. The numerator is counted in a pilot
//! run, with sampling noise: ordering thousands of cells by raw counts would select cells by chance. So the
//! ratio is first made monotone in the score at every t, by the maximum-likelihood fit among non-decreasing
//! functions, which pools neighbouring cells whose counts contradict the order (isotonic regression by
//! pooling adjacent violators [^1]). Every rule here assumes that a larger W indicates a shift, which gives
//! regions of the form W ≥ C_W(T). No order is imposed along t.
//!
//! [^1]: R. E. Barlow et al., "Statistical inference under order restrictions", Wiley, 1972.

use super::design::NullLaws;
use super::law::NullLaw;
use super::region::{NEVER, Region};
use super::statistics::Statistics;
use crate::stats::bisect::largest_below_one;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How often each W, T and T′ occurred.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Histogram {
    counts: BTreeMap<Statistics, u64>,
}

/// Neighbouring scores at one t that share one likelihood ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pool {
    exceedances: usize,
    /// Its lowest score.
    score: u64,
    count: f64,
    /// P(pool | H₀).
    null: f64,
}

impl Histogram {
    /// Adds one trial.
    pub fn add(&mut self, statistics: Statistics) {
        *self.counts.entry(statistics).or_default() += 1;
    }

    /// Adds another histogram.
    pub fn merge(&mut self, other: &Self) {
        for (cell, count) in &other.counts {
            *self.counts.entry(*cell).or_default() += count;
        }
    }

    /// The number of trials with `is_inside`.
    pub fn count(&self, is_inside: impl Fn(Statistics) -> bool) -> u64 {
        let inside = (self.counts.iter()).filter(|(statistics, _)| is_inside(**statistics));
        inside.map(|(_, count)| count).sum()
    }
}

impl Pool {
    fn ratio(&self) -> f64 {
        self.count / self.null
    }
}

/// The order in which the cells of the plane enter a region.
#[derive(Clone, Debug)]
pub struct LikelihoodOrder {
    /// From the largest ratio down.
    pools: Vec<Pool>,
    /// P(score | T) from the smallest on, and P(T), at rest.
    scores: Vec<Arc<[f64]>>,
    exceedances: Vec<f64>,
}

impl LikelihoodOrder {
    /// The order found in the trials of a pilot under the alternative.
    pub fn new(laws: &NullLaws, pilot: &Histogram) -> Self {
        let mut counts: BTreeMap<(usize, u64), f64> = BTreeMap::new();
        for (&statistics, &count) in &pilot.counts {
            let cell = (laws.of.of(statistics), laws.score_of(statistics.rank_sum));
            *counts.entry(cell).or_default() += count as f64;
        }
        let scores = laws.scores();
        let exceedances = masses(&laws.exceedances);
        let mut pools: Vec<Pool> = Vec::new();
        for (t, mass) in exceedances.iter().enumerate() {
            let cells = (laws.score.first()..)
                .zip(&*scores[t])
                .map(|(score, null)| Pool {
                    exceedances: t,
                    score,
                    count: counts.get(&(t, score)).copied().unwrap_or(0.0),
                    null: null * mass,
                });
            pools.extend(monotone(cells).into_iter().filter(|pool| pool.count > 0.0));
        }
        pools.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
        Self {
            pools,
            scores,
            exceedances,
        }
    }

    /// The critical scores of the region of size at most `alpha`: pools from the largest ratio down, the last
    /// one from its highest score down as far as the level allows. The remaining level goes to cells that the
    /// pilot never saw.
    fn critical(&self, laws: &NullLaws, alpha: f64) -> Vec<u64> {
        let mut critical = vec![NEVER; laws.columns.len()];
        let mut size = 0.0;
        for pool in &self.pools {
            let t = pool.exceedances;
            let top = critical[t].min(laws.score.last() + 1);
            for score in (pool.score..top).rev() {
                let index = (score - laws.score.first()) as usize;
                let mass = self.scores[t][index] * self.exceedances[t];
                // Rounding must not admit a cell that the exact size would exclude.
                if size + mass > alpha * (1.0 - 1e-12) {
                    return critical;
                }
                size += mass;
                critical[t] = score;
            }
        }
        self.fill(laws, alpha, &critical)
    }

    /// Adds the cells with P(S ≥ s) · P(T ≥ t) ≤ k, for the largest k that the level allows: without pilot
    /// counts the order is that of the `product` rule.
    fn fill(&self, laws: &NullLaws, alpha: f64, critical: &[u64]) -> Vec<u64> {
        let (scores, exceedances) = (tails(&laws.score), tails(&laws.exceedances));
        let first = laws.score.first();
        let filled = |k: f64| -> Vec<u64> {
            (critical.iter().zip(&exceedances))
                .map(|(critical, exceedance)| {
                    let reached = scores.partition_point(|tail| tail * exceedance > k);
                    *critical.min(&(first + reached as u64))
                })
                .collect()
        };
        let size = |region: &[u64]| -> f64 {
            let columns = region.iter().zip(&laws.columns).zip(&self.exceedances);
            columns
                .map(|((&c, column), mass)| column.score.tail(c) * mass)
                .sum()
        };
        filled(largest_below_one(|k| {
            size(&filled(k)) <= alpha * (1.0 - 1e-9)
        }))
    }
}

/// P(S = s) from the smallest s on.
fn masses(law: &NullLaw) -> Vec<f64> {
    (law.first()..=law.last()).map(|s| law.mass(s)).collect()
}

/// P(S ≥ s) from the smallest s on.
fn tails(law: &NullLaw) -> Vec<f64> {
    (law.first()..=law.last()).map(|s| law.tail(s)).collect()
}

impl NullLaws {
    /// P(score | T) for every T; one list serves all T if they are independent.
    fn scores(&self) -> Vec<Arc<[f64]>> {
        let mut scores: Vec<Arc<[f64]>> = Vec::new();
        for (t, column) in self.columns.iter().enumerate() {
            let is_known = t > 0 && Arc::ptr_eq(&column.score, &self.columns[t - 1].score);
            scores.push(match scores.last() {
                Some(known) if is_known => Arc::clone(known),
                _ => masses(&column.score).into(),
            });
        }
        scores
    }

    /// The most powerful region of size at most `alpha` against the alternative of the order; empty if no
    /// cell fits the level.
    pub fn likelihood_region(&self, order: &LikelihoodOrder, alpha: f64) -> Region {
        self.with_critical(order.critical(self, alpha))
    }
}

/// Pools the cells of one t, given from the lowest score up, until their ratios strictly increase.
fn monotone(cells: impl Iterator<Item = Pool>) -> Vec<Pool> {
    let mut pools: Vec<Pool> = Vec::new();
    for mut pool in cells.filter(|cell| cell.null > 0.0) {
        while let Some(below) = pools.last().filter(|below| below.ratio() >= pool.ratio()) {
            pool = Pool {
                score: below.score,
                count: below.count + pool.count,
                null: below.null + pool.null,
                ..pool
            };
            pools.pop();
        }
        pools.push(pool);
    }
    pools
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::{Alternative, Exceedances, Samples};

    /// For any number of pilot trials the exact size is at most α; without trials the region is that of the
    /// product rule except for its last cells.
    #[test]
    fn size_is_at_most_alpha_and_used() {
        let samples = Samples::contiguous(9, 6, 7).unwrap();
        for alternative in [
            Alternative::Greater,
            Alternative::Less,
            Alternative::TwoSided,
        ] {
            let laws = NullLaws::new(Exceedances::Scale, alternative, &samples).unwrap();
            for trials in [0u64, 1, 40, 5000] {
                let mut pilot = Histogram::default();
                for i in 0..trials {
                    let rank_sum = laws.rank_sum().last() - (i * i * 31 + 7 * i) % 40;
                    let exceedances = (i * 13 % 8) as usize;
                    pilot.add(Statistics {
                        rank_sum,
                        exceedances,
                        shift_exceedances: 0,
                    });
                }
                let order = LikelihoodOrder::new(&laws, &pilot);
                for alpha in [0.3, 0.05, 0.01, 0.0013, 1e-5] {
                    let size = laws.likelihood_region(&order, alpha).size();
                    assert!(size <= alpha, "{alternative} {trials}: {size} > {alpha}");
                    assert!(
                        size > 0.5 * alpha || alpha < 1e-4,
                        "{trials}: {size} of {alpha}"
                    );
                }
            }
        }
    }

    /// The pooled ratios against an independent definition: at each cell the isotonic fit is the maximum over
    /// starts at or before it of the minimum over ends at or after it of the mean.
    #[test]
    fn pools_are_the_isotonic_fit() {
        let counts = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0, 5.0, 3.0, 0.0, 8.0];
        let nulls = [2.0, 1.0, 3.0, 1.0, 1.0, 2.0, 2.0, 1.0, 4.0, 1.0, 1.0, 0.5];
        let cells = (0..).zip(counts.into_iter().zip(nulls));
        let pools = monotone(cells.map(|(score, (count, null))| Pool {
            exceedances: 0,
            score,
            count,
            null,
        }));
        let mean = |from: usize, to: usize| {
            counts[from..=to].iter().sum::<f64>() / nulls[from..=to].iter().sum::<f64>()
        };
        for cell in 0..counts.len() {
            let least = |from: usize| {
                (cell..12)
                    .map(move |to| mean(from, to))
                    .fold(f64::MAX, f64::min)
            };
            let fit = (0..=cell).map(least).fold(0.0, f64::max);
            let pool = pools
                .iter()
                .rev()
                .find(|pool| pool.score <= cell as u64)
                .unwrap();
            assert!((pool.ratio() - fit).abs() < 1e-12, "{cell}");
        }
        assert!(
            pools
                .windows(2)
                .all(|pair| pair[0].ratio() < pair[1].ratio())
        );
    }
}
