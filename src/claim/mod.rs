//! Claims: what a config says of its results, which points are compared for it, and what the verdict is.
//!
//! The rule is written in the config before the run. Each claim has a family-wise `level`, spread over
//! all its comparisons, and a `margin` below which a difference does not count. "Holds" takes a test
//! of superiority, non-inferiority or equivalence; a difference that is merely not visible proves
//! nothing and ends undecided.
//!
//! | test | holds | is refuted by | shown in a range |
//! |---|---|---|---|
//! | `grows` | every step's interval starts at −margin or above, every curve's last − first above margin | a curve that falls, or is flat from first to last | without a fall, and the lower limits of its steps add up to more than the margin |
//! | `exceeds` | every point's interval starts at −margin or above, one above margin | a point below −margin, or all of them at margin or below | every point above margin |
//! | `equals` | every point's interval lies inside ± margin | a point outside | every point inside |
//! | `alpha_held` | no rate is above α beyond doubt, and every upper limit is at most excess · α | a rate above α beyond doubt | every rate passes |
//! | `quantity` | its interval lies in [from, to] | an interval that misses [from, to] | |
//! | `gain` | its interval lies above `from` | an interval that ends at `from` or below | |
//!
//! A step *falls* where its interval ends below −margin; a curve is *flat* where that of last − first
//! ends at margin or below. `alpha_held` does not say that a rate is at most α, which no number of trials
//! can show of a rate that is α: a rate of 1.08 α passes where the excess is 1.2.
//!
//! A claim is about all its curves. One that is refuted *does not hold*, and its counter-examples are
//! counted, unless it is shown in a stated range of the axis for every curve (pair of curves): two
//! neighbouring values at least of an axis of numbers. Then it *holds where*; for growth some curve must grow
//! throughout, too. A single value is no range: curves that cross are equal where they cross. What is neither shown nor refuted is undecided: it takes more
//! trials.
//!
//! # Why the level is kept
//! - `grows`, `exceeds`, `equals`: each of n intervals has confidence 1 − level/n (Bonferroni), so with
//!   probability 1 − level at least all of them cover. Every word of a verdict follows from "all cover"
//!   and nothing else, however it was selected.
//! - `alpha_held`: Holm's rule on exact p-values of "the rate is at most α" rejects any true one with
//!   probability at most level/2; n two-sided intervals of confidence 1 − level/n have upper limits that
//!   all hold with probability 1 − level/2 at least.
//! - `gain`: see `gain.rs`. `quantity`: the interval's own confidence.

mod comparison;
mod contrast;
mod false_alarm;
mod gain;
mod growth;
mod narrative;
mod pairs;
mod place;
mod quantity;
mod scope;
#[cfg(test)]
mod tests;
mod values;
pub mod words;

pub use comparison::{Comparison, Place};
pub use gain::gains;
pub use narrative::{Claim, Contrasts, Narrative, Test, Words};
pub use pairs::{Pair, comparisons, confidence, number_of_pairs, pairs};
pub use quantity::{Quantity, named_quantity};
pub use scope::{Axis, ClaimProblem, Curve, Scope};

use crate::stats::tally::Tally;

/// The results that claims are judged by.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// Of the sweep, if it is one.
    pub scope: Scope,
    /// Of `points.csv`.
    pub outcomes: Vec<Outcome>,
    /// `comparisons.csv`, claim by claim.
    pub comparisons: Vec<Comparison>,
    /// `quantities.csv`
    pub quantities: Vec<Quantity>,
}

/// A rate, where it stands, and what its rule promises.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the columns of points.csv")]
pub struct Outcome {
    pub label: String,
    /// Its value on the axis, as the axis prints it.
    pub value: String,
    pub is_at_rest: bool,
    pub tally: Tally,
    pub low: f64,
    pub high: f64,
    pub alpha: f64,
    pub size: Option<f64>,
    pub reachable: Option<f64>,
}

impl Evidence {
    /// The comparisons of a claim, from 1.
    fn compared(&self, claim: usize) -> &[Comparison] {
        let of_claim = self.comparisons.chunk_by(|a, b| a.claim == b.claim);
        let mut of_claim = of_claim.filter(|chunk| chunk[0].claim == claim);
        of_claim.next().unwrap_or_default()
    }
}

/// The verdict on a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The conclusion.
    pub verdict: Verdict,
    /// The numbers behind it, in words.
    pub evidence: String,
    /// The rule, in words.
    pub how: String,
}

/// What may be concluded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Shown everywhere.
    Holds,
    /// Refuted, but shown in these ranges of the axis.
    HoldsWhere(String),
    /// Refuted.
    DoesNotHold,
    /// The trials were too few to tell.
    Undecided,
}

/// Why a claim cannot be judged by these results.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ClaimError {
    #[error("quantity `{name}`: not among the results, which have {known} (correct the name)")]
    NoQuantity { name: String, known: String },
    #[error("curve {0}: its points have not been compared for this claim (simulate again)")]
    NotCompared(String),
    #[error("curve {0}: no row at rest of its own (name the first curve that shares its rest)")]
    NoRest(String),
    #[error("curve {0}: no row for each value of the axis (let something move in it)")]
    NoRows(String),
}

/// Judges a claim, the `number`-th (from 1) of its config.
///
/// # Errors
/// Where the results have nothing of what the claim is about.
pub fn judge(claim: &Claim, number: usize, evidence: &Evidence) -> Result<Judgement, ClaimError> {
    match &claim.test {
        Test::Grows { curves } => growth::judge(claim, number, curves.as_deref(), evidence),
        Test::Exceeds(contrasts) => contrast::exceeds(claim, number, contrasts, evidence),
        Test::Equals(contrasts) => contrast::equals(claim, number, contrasts, evidence),
        Test::AlphaHeld { curves, excess } => {
            false_alarm::judge(claim, curves.as_deref(), excess.get(), evidence)
        }
        Test::Quantity { name, from, to } => {
            quantity::judge(name, [*from, *to], &evidence.quantities)
        }
        Test::Gain {
            first,
            second,
            power,
            from,
        } => gain::judge(claim, [first, second], power.get(), *from, evidence),
    }
}
