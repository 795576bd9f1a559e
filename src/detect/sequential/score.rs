//! Scores of a uniform number, on a lattice.
//!
//! A score is a(U) of mean 0 and variance 1, rounded to a multiple of 1/40 and, where it has no end of its own, cut off
//! at ±4. In steps of 1/40 it is an integer, and so is the CUSUM of it, whose law is then exact. A shift moves the mean
//! of normal scores by ρ times the shift, where ρ² is the share of the information kept. Rounding loses 1/(12·40²) =
//! 5.2e-5 of it and the ends less than 1e-5 (a test sums it up). The threshold of a wanted rate of false alarms lies at
//! most one step above the real one, which multiplies their mean distance by at most e^(2k/40), 4 % at k = 0.8.
//!
//! The lattice is defined by its cuts: the score is s where a⁻¹((s − ½)/40) < U ≤ a⁻¹((s + ½)/40). So the law of the
//! score is a difference of the law of U at the cuts, of uniform U as of any other.

use crate::stats::normal;
use libm::sqrt;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Steps of the lattice in a unit of score.
pub const STEPS: i32 = 40;

/// What a uniform number scores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Score {
    /// Φ⁻¹(U): the best for a shift of normal noise.
    #[default]
    Normal,
    /// √12 (U − ½): the best for a shift of logistic noise. A single block scores no more than √3.
    Ranks,
}

/// The change that raises a score. U, 1 − U and |2U − 1| are uniform alike.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Larger blocks: the score of U.
    Up,
    /// Smaller blocks: the score of 1 − U.
    Down,
    /// Blocks farther out on either side, as by vibration: the score of |2U − 1|.
    Scale,
}

impl Score {
    /// The largest score, in steps; the smallest is its negative.
    pub fn most(self) -> i32 {
        match self {
            Self::Normal => 4 * STEPS,
            Self::Ranks => (f64::from(STEPS) * sqrt(3.0)) as i32,
        }
    }

    /// a⁻¹.
    fn uniform(self, score: f64) -> f64 {
        match self {
            Self::Normal => normal::below(score),
            Self::Ranks => 0.5 + score / sqrt(12.0),
        }
    }
}

impl Side {
    /// Its uniform number.
    pub fn of(self, u: f64) -> f64 {
        match self {
            Self::Up => u,
            Self::Down => 1.0 - u,
            Self::Scale => (2.0 * u - 1.0).abs(),
        }
    }

    /// P(its number ≤ `cut`), where `below` is the distribution function of U.
    fn below(self, cut: f64, below: impl Fn(f64) -> f64) -> f64 {
        match self {
            Self::Up => below(cut),
            Self::Down => 1.0 - below(1.0 - cut),
            Self::Scale => below((1.0 + cut) / 2.0) - below((1.0 - cut) / 2.0),
        }
    }
}

/// The lattice of a score.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lattice {
    /// Scores are −`most` … `most` steps.
    pub(super) most: i32,
    /// Between one score and the next.
    cuts: Vec<f64>,
}

impl Lattice {
    /// The lattice of `score`.
    pub fn new(score: Score) -> Self {
        let most = score.most();
        let middle = |s: i32| (f64::from(s) + 0.5) / f64::from(STEPS);
        let cuts = (-most..most).map(|s| score.uniform(middle(s)));
        Self {
            most,
            cuts: cuts.collect(),
        }
    }

    /// The score of a number in [0, 1], in steps.
    pub fn score(&self, uniform: f64) -> i32 {
        self.cuts.partition_point(|cut| *cut < uniform) as i32 - self.most
    }

    /// The law of the score of one side, where `below` is the distribution function of U.
    pub(super) fn law(&self, side: Side, below: impl Fn(f64) -> f64) -> Law {
        let cuts = self.cuts.iter().map(|cut| side.below(*cut, &below));
        let ends = [0.0].into_iter().chain(cuts).chain([1.0]);
        let ends: Vec<f64> = ends.collect();
        let masses = ends.windows(2).map(|pair| pair[1] - pair[0]);
        Law::new(self.most, masses.collect())
    }
}

/// The law of a score in steps.
pub(super) struct Law {
    most: i32,
    masses: Vec<f64>,
    /// P(score ≤ s), summed from below, and P(score ≥ s), summed from above.
    at_most: Vec<f64>,
    at_least: Vec<f64>,
}

impl Law {
    fn new(most: i32, masses: Vec<f64>) -> Self {
        let sums = |masses: &mut dyn Iterator<Item = &f64>| -> Vec<f64> {
            let sums = masses.scan(0.0, |sum, mass| {
                *sum += mass;
                Some(*sum)
            });
            sums.collect()
        };
        let at_most = sums(&mut masses.iter());
        let mut at_least = sums(&mut masses.iter().rev());
        at_least.reverse();
        Self {
            most,
            masses,
            at_most,
            at_least,
        }
    }

    pub fn mass(&self, score: i32) -> f64 {
        self.entry(&self.masses, score).unwrap_or(0.0)
    }

    pub fn at_most(&self, score: i32) -> f64 {
        let beyond = f64::from(u8::from(score > 0));
        self.entry(&self.at_most, score).unwrap_or(beyond)
    }

    pub fn at_least(&self, score: i32) -> f64 {
        let beyond = f64::from(u8::from(score < 0));
        self.entry(&self.at_least, score).unwrap_or(beyond)
    }

    /// In steps.
    pub fn mean(&self) -> f64 {
        let scores = (-self.most..=self.most).map(f64::from);
        scores.zip(&self.masses).map(|(s, mass)| s * mass).sum()
    }

    fn entry(&self, of: &[f64], score: i32) -> Option<f64> {
        let index = usize::try_from(score + self.most).ok()?;
        of.get(index).copied()
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
