//! Claims: a config's statements about its results, the points compared for them, and the verdicts.
//!
//! The rule is written in the config before the run. Each claim has a family-wise `level`, spread over
//! all its comparisons, and a `margin` below which a difference does not count. "Holds" requires a test
//! of superiority, non-inferiority or equivalence; a difference that is merely not significant proves
//! nothing and leaves the claim undecided.
//!
//! | test | holds | is refuted by | shown at a value, or between two |
//! |---|---|---|---|
//! | `grows` | every step's interval starts at −margin or above, every curve's last − first above margin | a curve that falls, or is flat from first to last | without a fall, and the lower limits of its steps add up to more than the margin |
//! | `exceeds` | every point's interval starts at −margin or above, one above margin | a point below −margin, or all of them at margin or below | every point above margin |
//! | `equals` | every point's interval lies inside ± margin | a point outside | every point inside |
//! | `alpha_held` | no rate is above α beyond doubt, and every upper limit is at most excess · α | a rate above α beyond doubt | every rate passes |
//! | `quantity` | its interval lies in [from, to] | an interval that misses [from, to] | |
//! | `gain` | its interval lies above `from` | an interval that ends at `from` or below | |
//!
//! A step *falls* if its interval ends below −margin; a curve is *flat* if that of last − first ends at
//! margin or below. `alpha_held` does not show that a rate is at most α, which no number of trials can show
//! of a rate equal to α: a rate of 1.08 α passes if the excess is 1.2.
//!
//! A claim is about all its curves. A refuted claim *does not hold*, and its counter-examples are counted and the
//! worst is named, unless it is shown in a connected range of the axis for every curve. Then it *holds where*; for
//! growth some curve must also grow throughout. A claim that is neither shown nor refuted is undecided and needs more
//! trials.
//!
//! A *connected range* is an interval of the values that were tested: two of them at least, in the order of numbers
//! whatever order they are written in, and none between them at which the claim is not shown, be it refuted or open
//! there. All values at which the claim is shown must lie in it. A single value is no range, because curves that
//! cross are equal where they cross; a claim that is shown in two ranges apart is shown in no connected one; and names,
//! such as those of rules, have no order, so that among them only all are a range. Each curve has its own range, and so
//! has each pair where two curves, series or panels are compared: the pair in a panel is one curve here, and curves in
//! different panels need not agree. Growth is shown between two values that no fall lies between and that the lower limits
//! of the steps add up to; a curve with two such stretches has no connected range.
//!
//! # Why the level is kept
//! - `grows`, `exceeds`, `equals`: each of n intervals has confidence 1 − level/n (Bonferroni), so with
//!   probability 1 − level at least all of them cover. A verdict follows from "all cover" alone, whichever
//!   comparison it names.
//! - `alpha_held`: Holm's rule on exact p-values of "the rate is at most α" rejects any true one with
//!   probability at most level/2; n two-sided intervals of confidence 1 − level/n have upper limits that
//!   all hold with probability 1 − level/2 at least.
//! - `gain`: see `gain.rs`. `quantity`: the interval's own confidence.

mod comparison;
mod contrast;
mod evidence;
mod false_alarm;
mod further;
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
mod verdict;
pub mod words;

pub use comparison::{Comparison, Place};
pub use evidence::{Evidence, Outcome};
pub use further::{Enough, trials_to_decide};
pub use gain::gains;
pub use narrative::{Claim, Contrasts, Narrative, Test, Words};
pub use pairs::{Pair, comparisons, confidence, number_of_pairs, pairs};
pub use quantity::{Quantity, named_quantity};
pub use scope::{Axis, ClaimProblem, Curve, Scope};
pub use verdict::{ClaimError, Judgement, Verdict};

/// Judges a claim, the `number`-th (from 1) of its config.
///
/// # Errors
/// If the results lack what the claim is about.
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
