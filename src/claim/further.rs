//! How many trials would decide what is undecided.

use super::{Claim, ClaimError, Comparison, Evidence, Outcome, Place, Quantity, Verdict, judge};
use crate::stats::tally::Tally;

/// The trials per point, in two digits, that would decide a claim if every rate and number stayed as it is; none if
/// not even `most` would. `trials` have been run.
///
/// # Errors
/// As [`judge`].
pub fn trials_to_decide(
    claim: &Claim,
    number: usize,
    evidence: &Evidence,
    trials: u64,
    most: u64,
) -> Result<Option<u64>, ClaimError> {
    let decides = |factor: u64| {
        let judgement = judge(claim, number, &times(evidence, factor))?;
        Ok(judgement.verdict != Verdict::Undecided)
    };
    let mut enough = 1;
    while !decides(enough)? {
        enough *= 2;
        if trials.saturating_mul(enough) > most {
            return Ok(None);
        }
    }
    // The factor lies between half of that and it.
    let mut little = enough / 2;
    while little > 0 && enough - little > enough.div_ceil(16) {
        let middle = little.midpoint(enough);
        if decides(middle)? {
            enough = middle;
        } else {
            little = middle;
        }
    }
    Ok(Some(trials * enough))
}

/// The evidence of so many times the trials, if all of them came out like these.
fn times(evidence: &Evidence, factor: u64) -> Evidence {
    let more = |tally: Tally| Tally {
        hits: tally.hits * factor,
        trials: tally.trials * factor,
    };
    let outcome = |outcome: &Outcome| Outcome {
        tally: more(outcome.tally),
        ..outcome.clone()
    };
    let comparison = |of: &Comparison| {
        let Comparison { trials, .. } = *of;
        let tally = |hits| more(Tally { hits, trials });
        let places = [
            (&of.first_curve, &of.first_value),
            (&of.second_curve, &of.second_value),
        ];
        let discordant = of.first_only.zip(of.second_only);
        Comparison::new(
            of.claim,
            places.map(|(curve, value)| Place {
                curve: curve.clone(),
                value: value.clone(),
            }),
            [tally(of.first), tally(of.second)],
            discordant.map(|(first, second)| [first * factor, second * factor]),
            of.confidence,
        )
    };
    // An interval of an estimate shrinks with the root of the trials.
    let quantity = |of: &Quantity| {
        let nearer = |end: f64| of.value + (end - of.value) / (factor as f64).sqrt();
        Quantity {
            low: nearer(of.low),
            high: nearer(of.high),
            ..of.clone()
        }
    };
    Evidence {
        quantities: evidence.quantities.iter().map(quantity).collect(),
        outcomes: evidence.outcomes.iter().map(outcome).collect(),
        comparisons: evidence.comparisons.iter().map(comparison).collect(),
        ..evidence.clone()
    }
}
