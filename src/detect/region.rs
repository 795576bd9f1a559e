//! Decision regions ϑ, eqs (10)–(11) of [^1]: sets of (W, T) whose probability under H₀, eq. (15), is
//! at most α.
//!
//! [^1] fixes only that and the form W ≥ C_W(T). Every rule here gives such a table of critical values, one
//! for each T:
//!
//! | rule | region |
//! |---|---|
//! | wilcoxon | W ≥ c, T ignored |
//! | product | P(W ≥ w) · P(T ≥ t) ≤ k, for the largest k the level allows |
//! | disjunction | T ≥ t₀ or W ≥ w₀, with P(T ≥ t₀) ≤ α/2 |
//! | conjunction | T ≥ t₀ and W ≥ w₀, with P(T ≥ t₀) ≤ 0.1 |
//! | table | W ≥ C_W(T) as given, refused above α |
//!
//! On all of the motion T′ stands for T: the p-values are those of its own law, the probability of the region
//! is that of the joint law of W and T′.
//!
//! The critical values are of a *score*: W itself (`greater`), its mirror image M₁(N+M₁+M₂+1) − W
//! (`less`), or |2W − 2E W| (`two-sided`).
//!
//! [^1]: see [`crate::signal`].

use super::law::NullLawError;
use super::rule::{Alternative, Exceedances, Rule};
use super::statistics::Statistics;
use crate::format::brief;
use serde::{Deserialize, Serialize};

/// A region ϑ with its exact size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    pub(super) exceedances: Exceedances,
    /// The smallest score that decides H₁, for each T; `u64::MAX` where none does.
    pub(super) critical: Vec<u64>,
    /// The rank sums with such a score, for each T.
    pub(super) bounds: Vec<Bounds>,
    pub(super) size: f64,
    pub(super) reachable: Option<f64>,
}

/// A critical score that is never reached.
pub(super) const NEVER: u64 = u64::MAX;

impl Region {
    /// δ(W, T) of eq. (10): whether this observation decides H₁.
    #[inline(always)]
    pub fn contains(&self, statistics: Statistics) -> bool {
        self.bounds(statistics).decide(statistics.rank_sum)
    }

    /// The rank sums that decide H₁ beside these exceedances.
    #[inline(always)]
    pub fn bounds(&self, statistics: Statistics) -> Bounds {
        self.bounds[self.exceedances.of(statistics)]
    }

    /// The number of exceedances that it looks at.
    pub fn exceedances(&self, statistics: Statistics) -> usize {
        self.exceedances.of(statistics)
    }

    /// P(ϑ | H₀), eq. (15), correctly rounded.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The smallest level at which its rule gives a non-empty region; `None` for a region without a rule.
    pub fn reachable(&self) -> Option<f64> {
        self.reachable
    }

    /// C_W(T) for T = 0, 1, …: (lower, upper) such that W ≤ lower or W ≥ upper decides H₁.
    pub fn critical_values(&self) -> Vec<(Option<u64>, Option<u64>)> {
        let values = |&Bounds { below, from }: &Bounds| {
            (below.checked_sub(1), Some(from).filter(|&w| w != NEVER))
        };
        self.bounds.iter().map(values).collect()
    }
}

/// Rank sums that decide H₁: those smaller than `below` and those from `from` on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bounds {
    below: u64,
    from: u64,
}

impl Bounds {
    /// The rank sums whose score is `critical` or more, where `twice_mean` is M₁(N+M₁+M₂+1) = 2 E W.
    pub(super) fn new(alternative: Alternative, twice_mean: u64, critical: u64) -> Self {
        let below = |score: u64| twice_mean.checked_sub(score);
        match alternative {
            Alternative::Greater => Self {
                below: 0,
                from: critical,
            },
            Alternative::Less => Self {
                below: below(critical).map_or(0, |w| w + 1),
                from: NEVER,
            },
            // |2W − 2E W| of the critical score or more.
            Alternative::TwoSided if critical == NEVER => Self {
                below: 0,
                from: NEVER,
            },
            Alternative::TwoSided => Self {
                below: below(critical).map_or(0, |twice| twice / 2 + 1),
                from: (twice_mean + critical).div_ceil(2),
            },
        }
    }

    /// Whether this rank sum decides H₁.
    #[inline(always)]
    pub fn decide(self, rank_sum: u64) -> bool {
        (rank_sum < self.below) | (rank_sum >= self.from)
    }
}

/// Why there is no region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// α is outside (0, 1).
    #[error("alpha must lie strictly between 0 and 1, got {}", brief(*.0))]
    Alpha(f64),
    /// Every region of this rule has a larger size.
    #[error(
        "alpha: rule {rule} at {sizes} decides H1 nowhere at {}; the smallest alpha it can \
         reach is {} (raise alpha or the sizes)",
        brief(*.alpha), rounded_up(*.reachable)
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
        "rule conjunction at {sizes} decides H1 nowhere: no number of exceedances has P(T >= t) <= 0.1 \
         (raise scale or reference)"
    )]
    NoExceedanceThreshold {
        /// N/M₁/M₂.
        sizes: String,
    },
    /// A table of the wrong length.
    #[error("rule table must have {expected} entries, C_W(0) to C_W({}), got {got}", .expected - 1)]
    TableLength {
        /// One more than the largest number of exceedances.
        expected: usize,
        /// The number of entries given.
        got: usize,
    },
    /// A table whose exact size exceeds α.
    #[error(
        "rule table has exact size {size:.6}, above alpha = {} (raise its entries or alpha)",
        brief(*.alpha)
    )]
    TableTooLarge {
        /// Its exact size.
        size: f64,
        /// The level asked for.
        alpha: f64,
    },
    /// The exact laws could not be computed.
    #[error(transparent)]
    Law(#[from] NullLawError),
}

/// Four digits, never below the value.
fn rounded_up(value: f64) -> String {
    let nearest = format!("{value:.3e}");
    match nearest.parse::<f64>() {
        Ok(rounded) if rounded < value => format!("{:.3e}", value * 1.001),
        _ => nearest,
    }
}
