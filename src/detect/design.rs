//! The construction of regions: from the exact laws at given sizes to the critical values of each rule.

use super::joint;
use super::law::{Needs, NullLaw, NullLawError, check, ratio};
use super::region::{Bounds, NEVER, Region, RegionError};
use super::rule::{Alternative, Exceedances, Rule};
use super::samples::Samples;
use crate::stats::bisect::first;
use num_bigint::BigUint;
use std::sync::Arc;

#[cfg(test)]
mod tests;

/// The exact laws shared by all rules on W and T, or on W and T′, at given sizes and alternative.
#[derive(Clone, Debug)]
pub struct NullLaws {
    samples: Samples,
    pub(super) of: Exceedances,
    alternative: Alternative,
    rank_sum: NullLaw,
    /// The law of the score of the alternative.
    pub(super) score: Arc<NullLaw>,
    pub(super) exceedances: NullLaw,
    /// The law of the score given T, for T = 0, 1, ….
    pub(super) columns: Vec<Column>,
    cases: BigUint,
}

/// The law of the score where T has one value.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub score: Arc<NullLaw>,
    /// The number of all cases for each of its counts.
    weight: BigUint,
}

/// The level that `conjunction` gives to T.
const CONJUNCTION_LEVEL: f64 = 0.1;

impl NullLaws {
    /// The laws of W and the exceedances `of` these samples at these sizes.
    ///
    /// # Errors
    /// If their counts do not fit in memory, or take long.
    pub fn new(
        of: Exceedances,
        alternative: Alternative,
        samples: &Samples,
    ) -> Result<Self, NullLawError> {
        // All sizes are checked before any law is computed.
        check(of, samples, |samples| {
            let joint = match of {
                Exceedances::Scale => Needs::default(),
                Exceedances::Motion => joint::needs(samples),
            };
            let marginal =
                NullLaw::rank_sum_bytes(samples) + NullLaw::exceedances_bytes(of, samples);
            Needs {
                bytes: marginal + joint.bytes,
                ..joint
            }
        })?;
        // W is symmetric about its mean, for every T too, so its mirror image has the same law.
        let scored = |law: NullLaw| match alternative {
            Alternative::Greater | Alternative::Less => law,
            Alternative::TwoSided => law.doubled_deviation(),
        };
        let rank_sum = NullLaw::rank_sum(samples)?;
        let score = Arc::new(scored(rank_sum.clone()));
        let exceedances = NullLaw::exceedances(of, samples)?;
        let columns: Vec<Column> = match of {
            Exceedances::Scale => (0..=exceedances.last())
                .map(|t| Column {
                    score: Arc::clone(&score),
                    weight: exceedances.count(t),
                })
                .collect(),
            Exceedances::Motion => (joint::counts(samples).into_iter())
                .map(|counts| Column {
                    score: Arc::new(scored(NullLaw::from_counts(rank_sum.first(), counts))),
                    weight: BigUint::from(1u8),
                })
                .collect(),
        };
        Ok(Self {
            samples: *samples,
            of,
            alternative,
            cases: columns.iter().map(Column::cases).sum(),
            rank_sum,
            score,
            exceedances,
            columns,
        })
    }

    /// Whose exceedances are counted.
    pub fn of(&self) -> Exceedances {
        self.of
    }

    /// The law of W.
    pub fn rank_sum(&self) -> &NullLaw {
        &self.rank_sum
    }

    /// The law of T or T′.
    pub fn exceedances(&self) -> &NullLaw {
        &self.exceedances
    }

    /// The region of `rule` at level `alpha`.
    ///
    /// # Errors
    /// If `alpha` is not a level, the rule cannot reach it, or a table exceeds it.
    pub fn region(&self, rule: &Rule, alpha: f64) -> Result<Region, RegionError> {
        if !(alpha > 0.0 && alpha < 1.0) {
            return Err(RegionError::Alpha(alpha));
        }
        let critical = match rule {
            Rule::Wilcoxon => self.largest(alpha, |w| vec![w; self.columns.len()]),
            Rule::Product => self.product(alpha),
            Rule::Disjunction => {
                let t = self.exceedances.critical(alpha / 2.0);
                self.largest(alpha, |w| self.corner(t, w, self.score.first()))
            }
            Rule::Conjunction => {
                let t = self.exceedances.critical(CONJUNCTION_LEVEL);
                if t > self.exceedances.last() {
                    let sizes = self.sizes();
                    return Err(RegionError::NoExceedanceThreshold { sizes });
                }
                self.largest(alpha, |w| self.corner(t, NEVER, w))
            }
            Rule::Table(entries) => self.table(entries, alpha)?,
        };
        let region = self.with_critical(critical);
        if matches!(rule, Rule::Table(_)) {
            return Ok(region);
        }
        let reachable = self.reachable(rule);
        if region.size > 0.0 {
            Ok(Region {
                reachable: Some(reachable),
                ..region
            })
        } else {
            Err(RegionError::Unreachable {
                rule: rule.clone(),
                sizes: self.sizes(),
                alpha,
                reachable,
            })
        }
    }

    /// A region that never decides H₁.
    pub fn empty_region(&self) -> Region {
        self.with_critical(vec![NEVER; self.columns.len()])
    }

    pub(super) fn with_critical(&self, critical: Vec<u64>) -> Region {
        let reachable = |c| if c > self.score.last() { NEVER } else { c };
        let critical: Vec<u64> = critical.into_iter().map(reachable).collect();
        let bounds = |&c: &u64| Bounds::new(self.alternative, self.twice_mean(), c);
        Region {
            exceedances: self.of,
            bounds: critical.iter().map(bounds).collect(),
            size: self.size(&critical),
            reachable: None,
            critical,
        }
    }

    /// The score of a rank sum under the alternative.
    pub(super) fn score_of(&self, rank_sum: u64) -> u64 {
        self.alternative.score(rank_sum, self.twice_mean())
    }

    /// P(W decides H₁ | T) for T = 0, 1, ….
    pub fn conditional_sizes(&self, region: &Region) -> Vec<f64> {
        let columns = self.columns.iter().zip(&region.critical);
        columns.map(|(column, &c)| column.score.tail(c)).collect()
    }

    /// P(W = w, T = t).
    pub fn cell(&self, rank_sum: u64, exceedances: usize) -> f64 {
        let column = &self.columns[exceedances];
        let mass = column.score.mass(self.score_of(rank_sum));
        let both_signs = match self.alternative {
            Alternative::TwoSided if 2 * rank_sum != self.twice_mean() => 0.5,
            _ => 1.0,
        };
        both_signs * mass * self.exceedances.mass(exceedances as u64)
    }

    /// Eq. (15) in integers: the cases with a score of C(T) or more, divided by the number of all cases.
    pub(super) fn size(&self, critical: &[u64]) -> f64 {
        let columns = self.columns.iter().zip(critical);
        let cases: BigUint = columns
            .map(|(column, &c)| &column.weight * column.score.tail_count(c))
            .sum();
        ratio(&cases, &self.cases)
    }

    /// A table with the entry `below` for values less than t and `from` otherwise.
    fn corner(&self, t: u64, below: u64, from: u64) -> Vec<u64> {
        (0..self.columns.len() as u64)
            .map(|column| if column < t { below } else { from })
            .collect()
    }

    /// The largest region of size at most α in a family that shrinks as w grows. One past the last score gives
    /// the empty region.
    fn largest(&self, alpha: f64, table: impl Fn(u64) -> Vec<u64>) -> Vec<u64> {
        let scores = self.score.first()..self.score.last() + 1;
        table(first(scores, |w| self.size(&table(w)) <= alpha))
    }

    /// The entries of a table as scores.
    fn table(&self, entries: &[Option<u64>], alpha: f64) -> Result<Vec<u64>, RegionError> {
        if entries.len() != self.columns.len() {
            return Err(RegionError::TableLength {
                expected: self.columns.len(),
                got: entries.len(),
            });
        }
        let score = |w: u64| match self.alternative {
            Alternative::Greater | Alternative::Less => w,
            Alternative::TwoSided => (2 * w).saturating_sub(self.twice_mean()),
        };
        let critical: Vec<u64> = entries.iter().map(|w| w.map_or(NEVER, score)).collect();
        let size = self.size(&critical);
        if size > alpha {
            return Err(RegionError::TableTooLarge { size, alpha });
        }
        Ok(critical)
    }

    /// The smallest level at which `rule` is not empty.
    fn reachable(&self, rule: &Rule) -> f64 {
        let (w, t) = (&self.score, &self.exceedances);
        let (last_w, last_t) = (w.tail(w.last()), t.tail(t.last()));
        match rule {
            Rule::Wilcoxon => last_w,
            Rule::Product => {
                let nothing = vec![w.last() + 1; self.columns.len()];
                self.size(&self.with_next_product(&nothing))
            }
            Rule::Disjunction => last_w.min(2.0 * last_t),
            Rule::Conjunction => {
                self.size(&self.corner(t.critical(CONJUNCTION_LEVEL), NEVER, w.last()))
            }
            Rule::Table(_) => 0.0,
        }
    }

    fn twice_mean(&self) -> u64 {
        let (samples, m1) = (&self.samples, self.samples.shift());
        (m1 * (samples.reference() + m1 + samples.scale() + 1)) as u64
    }

    fn sizes(&self) -> String {
        self.samples.to_string()
    }
}

impl Column {
    fn cases(&self) -> BigUint {
        &self.weight * self.score.total()
    }
}
