//! How many trials would decide what is undecided.

use super::{Claim, ClaimError, Comparison, Evidence, Outcome, Test, Verdict, judge};
use crate::stats::tally::Tally;

/// What further trials would do to an undecided claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enough {
    /// About so many per point would decide it, if every rate stayed as it is.
    Trials(u64),
    /// So far nothing is known: the rates are too uncertain, or its numbers are no rates.
    Unknown,
}

/// Rates that do not decide by so many times their trials may not stay as they are.
const MOST_TIMES: u64 = 64;

/// How many trials per point would decide a claim, the `number`-th (from 1) of its config, of which `trials` have been
/// run: the least multiple, to a sixteenth, whose counts in the same proportions decide it. Rates at rest are taken to
/// be at least α, since a run without a false alarm does not show that there are none.
///
/// # Errors
/// As [`judge`].
pub fn trials_to_decide(
    claim: &Claim,
    number: usize,
    evidence: &Evidence,
    trials: u64,
) -> Result<Enough, ClaimError> {
    if matches!(claim.test, Test::Quantity { .. }) {
        return Ok(Enough::Unknown);
    }
    let decides = |factor: u64| {
        let judgement = judge(claim, number, &times(evidence, number, factor))?;
        Ok(judgement.verdict != Verdict::Undecided)
    };
    let mut enough = 1;
    while !decides(enough)? {
        enough *= 2;
        if enough > MOST_TIMES {
            return Ok(Enough::Unknown);
        }
    }
    let mut little = enough / 2;
    while enough - little > enough.div_ceil(16) {
        let middle = little.midpoint(enough);
        if decides(middle)? {
            enough = middle;
        } else {
            little = middle;
        }
    }
    Ok(Enough::Trials(trials * enough))
}

/// The evidence on a claim of so many times the trials, if all of them came out like these.
fn times(evidence: &Evidence, claim: usize, factor: u64) -> Evidence {
    let compared = evidence.compared(claim).iter();
    Evidence {
        outcomes: (evidence.outcomes.iter())
            .map(|outcome| repeated_outcome(outcome, factor))
            .collect(),
        comparisons: compared.map(|of| narrowed(of, factor)).collect(),
        ..evidence.clone()
    }
}

fn repeated(Tally { hits, trials }: Tally, factor: u64) -> Tally {
    Tally {
        hits: hits.saturating_mul(factor),
        trials: trials.saturating_mul(factor),
    }
}

fn repeated_outcome(outcome: &Outcome, factor: u64) -> Outcome {
    let mut tally = repeated(outcome.tally, factor);
    if outcome.is_at_rest {
        let expected = (outcome.alpha * tally.trials as f64) as u64;
        tally.hits = tally.hits.max(expected);
    }
    Outcome {
        tally,
        ..outcome.clone()
    }
}

/// Exact intervals of many comparisons would take long; these shrink with the root of the trials.
fn narrowed(of: &Comparison, factor: u64) -> Comparison {
    let nearer = |end: f64| of.difference + (end - of.difference) / (factor as f64).sqrt();
    Comparison {
        low: nearer(of.low),
        high: nearer(of.high),
        ..of.clone()
    }
}
