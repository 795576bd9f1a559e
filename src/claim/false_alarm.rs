//! The test `alpha_held`: whether the false-alarm rates are at most α.

use super::words::{count, curve as named, exact, interval};
use super::{Claim, ClaimError, Evidence, Judgement, Outcome, Verdict};
use crate::stats::tally::holm;

/// One row at rest.
struct Rest<'a> {
    label: &'a str,
    value: &'a str,
    outcome: &'a Outcome,
    /// The exact p-value of "the rate is at most α".
    p_value: f64,
    is_rejected: bool,
    /// Whether the rate is surely at most excess · α.
    is_low: bool,
}

impl Rest<'_> {
    fn passes(&self) -> bool {
        self.is_low && !self.is_rejected
    }
}

pub(super) fn judge(
    claim: &Claim,
    curves: Option<&[String]>,
    excess: f64,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let rests = rests(claim, curves, excess, evidence)?;
    let verdict = if rests.iter().any(|rest| rest.is_rejected) {
        let by_curve = rests.chunk_by(|a, b| a.label == b.label);
        Verdict::where_shown(by_curve.map(|of_curve| {
            let values: Vec<(&str, bool)> = of_curve
                .iter()
                .map(|rest| (rest.value, rest.passes()))
                .collect();
            evidence
                .scope
                .axis
                .shown(&named(of_curve[0].label), &values)
        }))
    } else if rests.iter().all(Rest::passes) {
        Verdict::Holds
    } else {
        Verdict::Undecided
    };
    Ok(Judgement {
        verdict,
        evidence: worst(&rests, evidence),
        how: format!(
            "no rate above α beyond doubt (exact tests, Holm), and each surely at most {excess} α; {}, \
             family-wise level {}",
            count(rests.len(), "scenario"),
            claim.level.get(),
        ),
    })
}

fn rests<'a>(
    claim: &Claim,
    curves: Option<&[String]>,
    excess: f64,
    evidence: &'a Evidence,
) -> Result<Vec<Rest<'a>>, ClaimError> {
    let mut found: Vec<(&str, (&str, &Outcome))> = Vec::new();
    for curve in evidence.scope.named(curves) {
        let label = &evidence.scope.curves[curve].label;
        let outcomes = evidence.along(label, true);
        if outcomes.is_empty() {
            return Err(ClaimError::NoRest(label.clone()));
        }
        found.extend(
            outcomes
                .into_iter()
                .map(|outcome| (label.as_str(), outcome)),
        );
    }
    let p_values: Vec<f64> = found
        .iter()
        .map(|(_, (_, outcome))| outcome.tally.p_value_above(outcome.alpha))
        .collect();
    // Half the level for rejections, half for the upper limits.
    let rejected = holm(&p_values, claim.level.get() / 2.0);
    let confidence = 1.0 - claim.level.get() / found.len() as f64;
    let judged = found.into_iter().zip(p_values.into_iter().zip(rejected));
    Ok(judged
        .map(|((label, (value, outcome)), (p_value, is_rejected))| Rest {
            label,
            value,
            outcome,
            p_value,
            is_rejected,
            is_low: outcome.tally.interval(confidence).1 <= excess * outcome.alpha,
        })
        .collect())
}

/// The number of rows that pass, the worst row for its level, and the rows that never decide, in words.
fn worst(rests: &[Rest], evidence: &Evidence) -> String {
    let excess = |rest: &Rest| rest.outcome.tally.rate() / rest.outcome.alpha;
    let worst = rests.iter().max_by(|a, b| excess(a).total_cmp(&excess(b)));
    let worst = worst.expect("a claim names a curve");
    let outcome = worst.outcome;
    let place = |rest: &Rest| {
        let value = evidence.scope.axis.at(rest.value);
        format!("{}, {value}", named(rest.label))
    };
    format!(
        "{} of {} pass, {} are above α beyond doubt; the largest for its α: {} at α = {}, p {}, {}{}",
        rests.iter().filter(|rest| rest.passes()).count(),
        rests.len(),
        rests.iter().filter(|rest| rest.is_rejected).count(),
        interval(outcome.tally.rate(), outcome.low, outcome.high),
        outcome.alpha,
        in_short(worst.p_value),
        place(worst),
        never(
            rests
                .iter()
                .filter(|rest| rest.outcome.tally.hits == 0)
                .map(place)
        ),
    )
}

/// A rule that decides nothing keeps every level, and says so: `; no decision at all on "drift", rule wilcoxon`.
fn never(places: impl Iterator<Item = String>) -> String {
    let places: Vec<String> = places.collect();
    if places.is_empty() {
        return String::new();
    }
    format!("; no decision at all on {}", places.join(" and on "))
}

/// A p-value with two digits, as a power of ten if it is small.
fn in_short(p_value: f64) -> String {
    match p_value {
        p if p < 1e-300 => "< 1e−300".to_owned(),
        p if p < 1e-3 => format!("= {p:.1e}").replace('-', "−"),
        p => format!("= {}", exact(format!("{p:.1e}").parse().unwrap_or(p))),
    }
}
