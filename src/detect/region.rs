//! Decision regions ϑ, eqs (10)–(11) of [^1]: sets of (W, T) whose probability under H₀, eq. (15), is
//! at most α.
//!
//! [^1] fixes only that and the form W ≥ C_W(T). Every rule here ends in such a table of critical
//! values, one for each T, and differs in how it fills it:
//!
//! | rule | region |
//! |---|---|
//! | wilcoxon | W ≥ c, T ignored |
//! | product | P(W ≥ w) · P(T ≥ t) ≤ k, for the largest k the level allows |
//! | disjunction | T ≥ t₀ or W ≥ w₀, with P(T ≥ t₀) ≤ α/2 |
//! | conjunction | T ≥ t₀ and W ≥ w₀, with P(T ≥ t₀) ≤ 0.1 |
//! | table | W ≥ C_W(T) as given, refused above α |
//!
//! The critical values are of a *score*: W itself (`greater`), its mirror image M₁(N+M₁+M₂+1) − W
//! (`less`), or |2W − 2E W| (`two-sided`).
//!
//! [^1]: see [`crate::signal`].

use super::law::{Law, LawError, ratio};
use super::samples::Samples;
use super::statistics::Statistics;
use num_bigint::BigUint;
use num_traits::Zero;
use serde::Serialize;
use std::fmt;

/// How a region is filled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Rule {
    /// W alone.
    Wilcoxon,
    /// The product of both p-values.
    Product,
    /// Either statistic.
    Disjunction,
    /// Both statistics.
    Conjunction,
    /// C_W(0) … C_W(M₂); `None` never decides H₁.
    Table(Vec<Option<u64>>),
}

/// The sign of Δ that a region is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Alternative {
    /// Δ > 0.
    Greater,
    /// Δ < 0.
    Less,
    /// Δ ≠ 0.
    TwoSided,
}

/// Why no region could be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// α is no level.
    #[error("alpha must lie strictly between 0 and 1, got {0}")]
    Alpha(f64),
    /// Every region of this rule has a larger size.
    #[error(
        "alpha: rule {rule} at {sizes} decides H1 nowhere at {alpha}; the smallest alpha it can \
         reach is {} (raise alpha or the sizes)",
        rounded_up(*.reachable)
    )]
    Unreachable {
        /// The rule asked for.
        rule: Rule,
        /// N/M₁/M₂.
        sizes: String,
        /// The level asked for.
        alpha: f64,
        /// The smallest level at which the region is not empty.
        reachable: f64,
    },
    /// No t has P(T ≥ t) ≤ 0.1.
    #[error(
        "rule conjunction at {sizes} decides H1 nowhere: no t <= M2 has P(T >= t) <= 0.1 \
         (raise scale or reference)"
    )]
    NoExceedanceThreshold {
        /// N/M₁/M₂.
        sizes: String,
    },
    /// A table of the wrong length.
    #[error("rule table must have {expected} entries, C_W(0) to C_W(M2), got {got}")]
    TableLength {
        /// M₂ + 1.
        expected: usize,
        /// As given.
        got: usize,
    },
    /// A table that promises more than it keeps.
    #[error(
        "rule table has exact size {size:.6}, above alpha = {alpha} (raise its entries or alpha)"
    )]
    TableTooLarge {
        /// Its exact size.
        size: f64,
        /// The level asked for.
        alpha: f64,
    },
    /// The laws themselves.
    #[error(transparent)]
    Law(#[from] LawError),
}

/// The exact laws that all rules at one set of sizes and one alternative share.
#[derive(Clone, Debug)]
pub struct NullLaws {
    samples: Samples,
    alternative: Alternative,
    rank_sum: Law,
    /// Of what the alternative looks at.
    score: Law,
    exceedances: Law,
}

/// A region ϑ with its exact size.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    alternative: Alternative,
    /// M₁(N+M₁+M₂+1) = 2 E W.
    twice_mean: u64,
    /// The smallest score that decides H₁, for each T; `u64::MAX` where none does.
    critical: Vec<u64>,
    size: f64,
}

/// Four digits, never below the value.
fn rounded_up(value: f64) -> String {
    let nearest = format!("{value:.3e}");
    match nearest.parse::<f64>() {
        Ok(rounded) if rounded < value => format!("{:.3e}", value * 1.001),
        _ => nearest,
    }
}

/// A critical score that nothing reaches.
const NEVER: u64 = u64::MAX;

/// The level that `conjunction` gives to T.
const CONJUNCTION_LEVEL: f64 = 0.1;

impl Region {
    /// The region of `rule` at level `alpha`.
    ///
    /// # Errors
    /// Where `alpha` is no level, the rule cannot reach it, or a table exceeds it.
    pub fn new(
        rule: &Rule,
        alternative: Alternative,
        alpha: f64,
        samples: &Samples,
    ) -> Result<Self, RegionError> {
        NullLaws::new(alternative, samples)?.region(rule, alpha)
    }

    /// δ(W, T) of eq. (10): whether this observation decides H₁.
    #[inline]
    pub fn contains(&self, statistics: Statistics) -> bool {
        let doubled = 2 * statistics.rank_sum;
        let score = match self.alternative {
            Alternative::Greater => statistics.rank_sum,
            Alternative::Less => self.twice_mean - statistics.rank_sum,
            Alternative::TwoSided => doubled.abs_diff(self.twice_mean),
        };
        score >= self.critical[statistics.exceedances]
    }

    /// P(ϑ | H₀), eq. (15), correctly rounded.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// P(W decides H₁ | T) for T = 0 … M₂ under `laws`, those the region was made from.
    pub fn conditional_sizes(&self, laws: &NullLaws) -> Vec<f64> {
        self.critical
            .iter()
            .map(|&score| laws.score.tail(score))
            .collect()
    }

    /// C_W(T) for T = 0 … M₂: (lower, upper) such that W ≤ lower or W ≥ upper decides H₁.
    pub fn critical_values(&self) -> Vec<(Option<u64>, Option<u64>)> {
        let bounds = |&score: &u64| match (score, self.alternative) {
            (NEVER, _) => (None, None),
            (score, Alternative::Greater) => (None, Some(score)),
            (score, Alternative::Less) => (self.twice_mean.checked_sub(score), None),
            (score, Alternative::TwoSided) => {
                let upper = (self.twice_mean + score).div_ceil(2);
                (self.twice_mean.checked_sub(upper), Some(upper))
            }
        };
        self.critical.iter().map(bounds).collect()
    }
}

impl NullLaws {
    /// The laws at these sizes.
    ///
    /// # Errors
    /// Where their counts would not fit in memory.
    pub fn new(alternative: Alternative, samples: &Samples) -> Result<Self, LawError> {
        let rank_sum = Law::rank_sum(samples)?;
        let score = match alternative {
            // W is symmetric about its mean, so its mirror image has the same law.
            Alternative::Greater | Alternative::Less => rank_sum.clone(),
            Alternative::TwoSided => rank_sum.doubled_deviation(),
        };
        Ok(Self {
            samples: *samples,
            alternative,
            rank_sum,
            score,
            exceedances: Law::exceedances(samples),
        })
    }

    /// The law of W.
    pub fn rank_sum(&self) -> &Law {
        &self.rank_sum
    }

    /// The law of T.
    pub fn exceedances(&self) -> &Law {
        &self.exceedances
    }

    /// The region of `rule` at level `alpha`.
    ///
    /// # Errors
    /// As [`Region::new`].
    pub fn region(&self, rule: &Rule, alpha: f64) -> Result<Region, RegionError> {
        if !(alpha > 0.0 && alpha < 1.0) {
            return Err(RegionError::Alpha(alpha));
        }
        let critical = match rule {
            Rule::Wilcoxon => self.largest(alpha, |w| vec![w; self.columns()]),
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
        let size = self.size(&critical);
        if size == 0.0 && !matches!(rule, Rule::Table(_)) {
            return Err(RegionError::Unreachable {
                rule: rule.clone(),
                sizes: self.sizes(),
                alpha,
                reachable: self.reachable(rule),
            });
        }
        Ok(Region {
            alternative: self.alternative,
            twice_mean: self.twice_mean(),
            critical,
            size,
        })
    }

    /// Eq. (15) by integers: Σ_T cases(T) · cases(score ≥ C(T)) over all cases.
    fn size(&self, critical: &[u64]) -> f64 {
        let mut cases = BigUint::zero();
        for (t, &c) in (0..).zip(critical) {
            cases += self.exceedances.count(t) * self.score.tail_count(c);
        }
        ratio(&cases, &(self.exceedances.total() * self.score.total()))
    }

    /// The table `below` t and `from` t on.
    fn corner(&self, t: u64, below: u64, from: u64) -> Vec<u64> {
        (0..self.columns() as u64)
            .map(|column| if column < t { below } else { from })
            .collect()
    }

    /// The largest of a family of regions that shrink as w grows, of size at most α. One past the
    /// last score is the empty choice.
    fn largest(&self, alpha: f64, table: impl Fn(u64) -> Vec<u64>) -> Vec<u64> {
        let (mut low, mut high) = (self.score.first(), self.score.last() + 1);
        while low < high {
            let middle = low + (high - low) / 2;
            match self.size(&table(middle)) <= alpha {
                true => high = middle,
                false => low = middle + 1,
            }
        }
        let past = self.score.last() + 1;
        table(low)
            .into_iter()
            .map(|c| if c >= past { NEVER } else { c })
            .collect()
    }

    /// Entries of a given table as scores.
    fn table(&self, entries: &[Option<u64>], alpha: f64) -> Result<Vec<u64>, RegionError> {
        if entries.len() != self.columns() {
            return Err(RegionError::TableLength {
                expected: self.columns(),
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
                let nothing = vec![w.last() + 1; self.columns()];
                self.size(&self.with_next_product(&nothing))
            }
            Rule::Disjunction => last_w.min(2.0 * last_t),
            Rule::Conjunction => last_w * t.tail(t.critical(CONJUNCTION_LEVEL)),
            Rule::Table(_) => 0.0,
        }
    }

    fn columns(&self) -> usize {
        self.samples.scale() + 1
    }

    fn twice_mean(&self) -> u64 {
        let (n, m1, m2) = (
            self.samples.reference(),
            self.samples.shift(),
            self.samples.scale(),
        );
        (m1 * (n + m1 + m2 + 1)) as u64
    }

    /// The largest region {P(S ≥ s) · P(T ≥ t) ≤ k} of size at most α. Floating point finds a k
    /// just below; from there on cells enter in the exact order of their products, equal products
    /// together, until the size would exceed α.
    fn product(&self, alpha: f64) -> Vec<u64> {
        let mut critical = self.product_start(alpha);
        loop {
            let grown = self.with_next_product(&critical);
            if self.size(&grown) > alpha {
                let past = self.score.last() + 1;
                return critical
                    .into_iter()
                    .map(|c| if c >= past { NEVER } else { c })
                    .collect();
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
            (0..self.columns() as u64).map(column).collect()
        };
        let masses: Vec<f64> = (0..self.columns() as u64)
            .map(|t| self.exceedances.mass(t))
            .collect();
        let size = |k: f64| -> f64 {
            let tails = region(k).into_iter().map(|c| scores[c]);
            tails.zip(&masses).map(|(tail, mass)| tail * mass).sum()
        };
        // Positive floats are ordered like their bits.
        let (mut low, mut high) = (0, 1f64.to_bits());
        while low + 1 < high {
            let middle = low + (high - low) / 2;
            match size(f64::from_bits(middle)) <= alpha * MARGIN {
                true => low = middle,
                false => high = middle,
            }
        }
        let critical = region(f64::from_bits(low) * MARGIN);
        critical
            .into_iter()
            .map(|c| self.score.first() + c as u64)
            .collect()
    }

    /// The region with the cells of the smallest product outside it added.
    fn with_next_product(&self, critical: &[u64]) -> Vec<u64> {
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

    fn sizes(&self) -> String {
        self.samples.to_string()
    }
}

impl Rule {
    /// Its name in a config.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Wilcoxon => "wilcoxon",
            Self::Product => "product",
            Self::Disjunction => "disjunction",
            Self::Conjunction => "conjunction",
            Self::Table(_) => "table",
        }
    }
}

impl fmt::Display for Rule {
    /// Its name, with the entries of a table: `table(291 291 never)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        if let Self::Table(entries) = self {
            let entry = |w: &Option<u64>| w.map_or("never".to_owned(), |w| w.to_string());
            let entries: Vec<String> = entries.iter().map(entry).collect();
            write!(f, "({})", entries.join(" "))?;
        }
        Ok(())
    }
}

impl fmt::Display for Alternative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Greater => "greater",
            Self::Less => "less",
            Self::TwoSided => "two-sided",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(n: usize, m1: usize, m2: usize) -> Samples {
        Samples::contiguous(n, m1, m2).unwrap()
    }

    fn region(rule: Rule, alternative: Alternative, alpha: f64, samples: &Samples) -> Region {
        Region::new(&rule, alternative, alpha, samples).unwrap()
    }

    /// Every cell of the (W, T) plane with its probability.
    fn cells(samples: &Samples) -> Vec<(Statistics, f64)> {
        let w = Law::rank_sum(samples).unwrap();
        let t = Law::exceedances(samples);
        let cell = |rank_sum, exceedances: u64| {
            let probability = w.mass(rank_sum) * t.mass(exceedances);
            let exceedances = exceedances as usize;
            (
                Statistics {
                    rank_sum,
                    exceedances,
                },
                probability,
            )
        };
        (w.first()..=w.last())
            .flat_map(|rank_sum| (0..=t.last()).map(move |e| (rank_sum, e)))
            .map(|(rank_sum, e)| cell(rank_sum, e))
            .collect()
    }

    const RULES: [Rule; 4] = [
        Rule::Wilcoxon,
        Rule::Product,
        Rule::Disjunction,
        Rule::Conjunction,
    ];
    const ALTERNATIVES: [Alternative; 3] = [
        Alternative::Greater,
        Alternative::Less,
        Alternative::TwoSided,
    ];

    /// The size is the sum over the cells that `contains` accepts, and is at most α.
    #[test]
    fn size_is_the_sum_of_the_cells() {
        for samples in [sizes(12, 12, 12), sizes(9, 5, 7), sizes(8, 4, 1)] {
            for rule in &RULES {
                for alternative in ALTERNATIVES {
                    let Ok(region) = Region::new(rule, alternative, 0.01, &samples) else {
                        assert_eq!((rule, samples.scale()), (&Rule::Conjunction, 1));
                        continue;
                    };
                    let inside = cells(&samples)
                        .into_iter()
                        .filter(|(s, _)| region.contains(*s));
                    let sum: f64 = inside.map(|(_, p)| p).sum();
                    assert!((sum - region.size()).abs() < 1e-14, "{rule} {alternative}");
                    assert!(region.size() <= 0.01 && region.size() > 0.0);
                }
            }
        }
    }

    /// The product rule against its definition: order all cells by the exact product of their tail
    /// counts, let groups of equal products enter together, stop before α is exceeded.
    #[test]
    fn product_enters_cells_in_exact_order() {
        for (samples, alpha) in [
            (sizes(12, 12, 12), 0.01),
            (sizes(12, 12, 12), 0.001),
            (sizes(6, 4, 5), 0.05),
            (sizes(2, 3, 9), 0.2),
            (sizes(20, 8, 3), 1e-5),
        ] {
            let w = Law::rank_sum(&samples).unwrap();
            let t = Law::exceedances(&samples);
            let mut ordered: Vec<(BigUint, u64, u64)> = (w.first()..=w.last())
                .flat_map(|rank| (0..=t.last()).map(move |e| (rank, e)))
                .map(|(rank, e)| (w.tail_count(rank) * t.tail_count(e), rank, e))
                .collect();
            ordered.sort();
            let all = w.total() * t.total();
            let mut inside = Vec::new();
            let mut cases = BigUint::zero();
            for group in ordered.chunk_by(|a, b| a.0 == b.0) {
                let more: BigUint = group
                    .iter()
                    .map(|(_, r, e)| w.count(*r) * t.count(*e))
                    .sum();
                if ratio(&(&cases + &more), &all) > alpha {
                    break;
                }
                cases += more;
                inside.extend(group.iter().map(|&(_, r, e)| (r, e)));
            }
            let region = region(Rule::Product, Alternative::Greater, alpha, &samples);
            assert_eq!(region.size(), ratio(&cases, &all));
            for (statistics, _) in cells(&samples) {
                let expected =
                    inside.contains(&(statistics.rank_sum, statistics.exceedances as u64));
                assert_eq!(region.contains(statistics), expected, "{statistics:?}");
            }
        }
    }

    /// The equal products named for 12/12/12: (w − 78, t) = (280, 12) and (288, 10).
    #[test]
    fn equal_products_exist() {
        let samples = sizes(12, 12, 12);
        let (w, t) = (Law::rank_sum(&samples).unwrap(), Law::exceedances(&samples));
        assert_eq!(
            w.tail_count(280 + 78) * t.tail_count(12),
            w.tail_count(288 + 78) * t.tail_count(10)
        );
    }

    #[test]
    fn wilcoxon_is_the_published_test() {
        let region = region(
            Rule::Wilcoxon,
            Alternative::Greater,
            0.01,
            &sizes(12, 12, 12),
        );
        assert_eq!(region.critical_values(), vec![(None, Some(291)); 13]);
        assert!((region.size() - 0.009972063).abs() < 5e-10);
    }

    #[test]
    fn disjunction_and_conjunction_by_hand() {
        let samples = sizes(12, 12, 12);
        let either = region(Rule::Disjunction, Alternative::Greater, 0.01, &samples);
        let values = either.critical_values();
        // P(T ≥ 8) = .0047 ≤ α/2 < P(T ≥ 7), so from T = 8 on any W will do.
        assert!(values[8..].iter().all(|v| *v == (None, Some(78))));
        let w = Law::rank_sum(&samples).unwrap();
        let left = (0.01 - 0.004711267) / (1.0 - 0.004711267);
        assert!(
            values[..8]
                .iter()
                .all(|v| *v == (None, Some(w.critical(left))))
        );
        let both = region(Rule::Conjunction, Alternative::Greater, 0.01, &samples);
        let t = Law::exceedances(&samples).critical(0.1) as usize;
        let values = both.critical_values();
        assert!(values[..t].iter().all(|v| *v == (None, None)));
        assert!(
            values[t..]
                .windows(2)
                .all(|pair| pair[0] == pair[1] && pair[0].1.is_some())
        );
    }

    /// P(T ≥ 2) = .033 at 12/12/2: no t qualifies for α/2, so the disjunction is the rank-sum test.
    #[test]
    fn disjunction_without_a_threshold_is_wilcoxon() {
        let samples = sizes(12, 12, 2);
        let either = region(Rule::Disjunction, Alternative::Greater, 0.01, &samples);
        let alone = region(Rule::Wilcoxon, Alternative::Greater, 0.01, &samples);
        assert_eq!(either.critical_values(), alone.critical_values());
    }

    /// `less` mirrors W; `two-sided` joins both halves.
    #[test]
    fn alternatives_mirror() {
        let samples = sizes(12, 12, 12);
        for rule in &RULES {
            let greater = region(rule.clone(), Alternative::Greater, 0.01, &samples);
            let less = region(rule.clone(), Alternative::Less, 0.01, &samples);
            let both = region(rule.clone(), Alternative::TwoSided, 0.01, &samples);
            for (statistics, _) in cells(&samples) {
                let rank_sum = 12 * 37 - statistics.rank_sum;
                let mirrored = Statistics {
                    rank_sum,
                    ..statistics
                };
                assert_eq!(greater.contains(statistics), less.contains(mirrored));
                assert_eq!(both.contains(statistics), both.contains(mirrored));
            }
            let t = if *rule == Rule::Conjunction { 9 } else { 0 };
            let (lower, upper) = both.critical_values()[t];
            assert_eq!(lower.unwrap() + upper.unwrap(), 12 * 37);
        }
    }

    #[test]
    fn tables() {
        let samples = sizes(12, 12, 2);
        let table = |entries: &[Option<u64>]| {
            Region::new(
                &Rule::Table(entries.to_vec()),
                Alternative::Greater,
                0.01,
                &samples,
            )
        };
        let wilcoxon = region(Rule::Wilcoxon, Alternative::Greater, 0.01, &samples);
        let c = wilcoxon.critical_values()[0].1;
        assert_eq!(table(&[c, c, c]).unwrap().size(), wilcoxon.size());
        assert_eq!(table(&[None, None, None]).unwrap().size(), 0.0);
        assert!(matches!(
            table(&[c, c]),
            Err(RegionError::TableLength { .. })
        ));
        assert!(matches!(
            table(&[c, c, Some(0)]),
            Err(RegionError::TableTooLarge { .. })
        ));
    }

    #[test]
    fn refusals_name_what_can_be_reached() {
        let refuse = |rule: &Rule, alpha, samples: &Samples| {
            Region::new(rule, Alternative::Greater, alpha, samples).unwrap_err()
        };
        for alpha in [0.0, 1.0, -0.1, f64::NAN] {
            let error = refuse(&Rule::Product, alpha, &sizes(3, 3, 3));
            assert!(matches!(error, RegionError::Alpha(_)));
        }
        assert!(matches!(
            refuse(&Rule::Conjunction, 0.01, &sizes(8, 4, 1)),
            RegionError::NoExceedanceThreshold { .. }
        ));
        let samples = sizes(4, 2, 4);
        for rule in &RULES {
            let RegionError::Unreachable { reachable, .. } = refuse(rule, 1e-6, &samples) else {
                panic!("{rule}");
            };
            let at = |alpha| Region::new(rule, Alternative::Greater, alpha, &samples);
            assert!(at(reachable * 1.0001).is_ok(), "{rule} {reachable}");
            assert!(at(reachable * 0.9999).is_err(), "{rule} {reachable}");
        }
    }

    /// Large sizes stay well within the seconds a user will wait.
    #[test]
    fn large_sizes() {
        let region = region(
            Rule::Product,
            Alternative::Greater,
            0.01,
            &sizes(200, 200, 200),
        );
        assert!(region.size() <= 0.01 && region.size() > 0.00999);
    }
}
