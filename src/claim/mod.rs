//! Claims against results: which points are compared, and what the verdict is.
//!
//! The rule is written in the config before the run. Each claim has a family-wise `level`, spread over
//! all its comparisons, and a `margin` below which a difference does not count. "Holds" takes a test
//! of superiority, non-inferiority or equivalence; a difference that is merely not visible proves
//! nothing and ends undecided.
//!
//! | test | holds | does not hold | holds where |
//! |---|---|---|---|
//! | `grows` | every step's interval starts at −margin or above, every curve's last − first above margin | every curve falls or is flat, or some does and none grows from first to last | one falls or is flat, and others grow: these, and the ranges in which the one grows |
//! | `exceeds` | every point's interval starts at −margin or above, one above margin | none is greater, and one is smaller or all are at most margin | some are greater, some smaller: where greater |
//! | `equals` | every point's interval lies inside ± margin | one lies outside, and no two neighbours inside (curves that cross are equal where they cross) | one lies outside, neighbours inside: these |
//! | `alpha_held` | no row is rejected and every upper limit is at most excess · α | some are rejected, and no other is held | some are rejected: where held |
//! | `quantity` | its interval lies in [from, to] | its interval misses [from, to] | |
//! | `gain` | its interval lies above `from` | its interval ends at `from` or below | |
//!
//! A step *falls* where its interval ends below −margin; a curve is *flat* where that of last − first
//! ends at margin or below. Anything else is undecided: it takes more trials.
//!
//! # Why the level is kept
//! - `grows`, `exceeds`, `equals`: each of n intervals has confidence 1 − level/n (Bonferroni), so with
//!   probability 1 − level at least all of them cover. Every word of a verdict follows from "all cover"
//!   and nothing else, however it was selected. A range inside a fallen curve is said to grow where the
//!   lower limits of its steps add up to more than the margin, which follows from the same event.
//! - `alpha_held`: Holm's rule on exact p-values of "the rate is at most α" rejects any true one with
//!   probability at most level/2; n two-sided intervals of confidence 1 − level/n have upper limits that
//!   all hold with probability 1 − level/2 at least, and only there is a rate called held.
//! - `gain`: see `gain.rs`. `quantity`: the interval's own confidence.

mod contrast;
mod false_alarm;
mod gain;
mod growth;
mod pairs;
mod place;
mod quantity;
#[cfg(test)]
mod tests;
pub mod words;

pub use gain::gains;
pub use pairs::{Pair, comparisons, confidence, pairs};
pub use place::placed;
pub use quantity::named_quantity;

use crate::experiment::{Axis, Claim, Test};
use crate::results::{Comparison, Quantity, Row};
use contrast::Compared;

/// What a claim is judged by.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// Of the sweep, if it is one.
    pub axis: Option<&'a Axis>,
    /// `points.csv`
    pub rows: &'a [Row],
    /// `comparisons.csv`, of every claim.
    pub comparisons: &'a [Comparison],
    /// `quantities.csv`
    pub quantities: &'a [Quantity],
}

/// What became of a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The conclusion.
    pub verdict: Verdict,
    /// The numbers behind it, in a sentence.
    pub evidence: String,
    /// The rule, in a sentence.
    pub how: String,
}

/// What may be concluded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Shown everywhere.
    Holds,
    /// Shown here, refuted elsewhere.
    HoldsWhere(String),
    /// Refuted, and shown nowhere.
    DoesNotHold,
    /// The trials were too few to tell.
    Undecided,
}

/// Why a claim cannot be judged by these results.
#[derive(Debug, thiserror::Error)]
pub enum ClaimError {
    /// No such number.
    #[error("quantity `{name}`: not among the results, which have {known} (correct the name)")]
    NoQuantity {
        /// As the claim has it.
        name: String,
        /// All there are.
        known: String,
    },
    /// The results are from before the claim.
    #[error("curve {0}: its points have not been compared for this claim (simulate again)")]
    NotCompared(String),
    /// Another curve has the row at rest.
    #[error("curve {0}: no row at rest of its own (name the first curve that shares its rest)")]
    NoRest(String),
    /// Not enough points.
    #[error("curve {0}: no row for each value of the axis (let something move in it)")]
    NoRows(String),
}

/// Judges a claim, the `number`-th (from 1) of its config.
///
/// # Errors
/// Where the evidence lacks what the claim is about.
pub fn judge(claim: &Claim, number: usize, evidence: &Evidence) -> Result<Judgement, ClaimError> {
    let of_claim = |comparison: &&Comparison| comparison.claim == number;
    let comparisons: Vec<&Comparison> = evidence.comparisons.iter().filter(of_claim).collect();
    let compared = |contrasts| Compared {
        claim,
        contrasts,
        comparisons: &comparisons,
        axis: evidence.axis,
    };
    match &claim.test {
        Test::Grows { curves } => growth::judge(claim, curves, &comparisons, evidence.axis),
        Test::Exceeds(contrasts) => compared(contrasts).exceeds(),
        Test::Equals(contrasts) => compared(contrasts).equals(),
        Test::AlphaHeld { curves, excess } => false_alarm::judge(claim, curves, *excess, evidence),
        Test::Quantity { name, from, to } => {
            quantity::judge(name, [*from, *to], evidence.quantities)
        }
        Test::Gain {
            first,
            second,
            power,
            from,
        } => gain::judge(claim, [first, second], *power, *from, evidence),
    }
}
