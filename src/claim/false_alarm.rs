//! Do the false-alarm rates stay at or below α?

use super::place::placed;
use super::words::{at, count, curve as named, exact, interval, ranges};
use super::{ClaimError, Evidence, Judgement, Verdict};
use crate::experiment::{Axis, Claim};
use crate::results::Row;
use crate::stats::tally::holm;

/// One row at rest.
struct Rest<'a> {
    label: &'a str,
    value: String,
    row: &'a Row,
    /// Exact, of "the rate is at most α".
    p_value: f64,
    is_rejected: bool,
    /// Whether the rate is surely at most excess · α.
    is_low: bool,
}

impl Rest<'_> {
    fn is_held(&self) -> bool {
        self.is_low && !self.is_rejected
    }
}

pub(super) fn judge(
    claim: &Claim,
    curves: &[String],
    excess: f64,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let rests = rests(claim, curves, excess, evidence)?;
    Ok(Judgement {
        verdict: verdict(&rests, curves, evidence.axis),
        evidence: worst(&rests, evidence.axis),
        how: format!(
            "no rate above α (exact tests, Holm) and every upper limit at most {excess} α; {}, \
             family-wise level {}",
            count(rests.len(), "scenario"),
            claim.level,
        ),
    })
}

fn rests<'a>(
    claim: &Claim,
    curves: &'a [String],
    excess: f64,
    evidence: &Evidence<'a>,
) -> Result<Vec<Rest<'a>>, ClaimError> {
    let mut found: Vec<(&str, String, &Row)> = Vec::new();
    for label in curves {
        let rows = placed(evidence.axis, evidence.rows, label, true);
        if rows.is_empty() {
            return Err(ClaimError::NoRest(label.clone()));
        }
        let named = |(value, row)| (label.as_str(), value, row);
        found.extend(rows.into_iter().map(named));
    }
    let p_value = |row: &Row| row.tally().p_value_above(row.alpha);
    let p_values: Vec<f64> = found.iter().map(|(.., row)| p_value(row)).collect();
    // Half the level for rejections, half for the upper limits.
    let rejected = holm(&p_values, claim.level / 2.0);
    let confidence = 1.0 - claim.level / found.len() as f64;
    let rest = |(index, (label, value, row)): (usize, (&'a str, String, &'a Row))| Rest {
        label,
        value,
        row,
        p_value: p_values[index],
        is_rejected: rejected[index],
        is_low: row.tally().interval(confidence).1 <= excess * row.alpha,
    };
    Ok(found.into_iter().enumerate().map(rest).collect())
}

fn verdict(rests: &[Rest], curves: &[String], axis: Option<&Axis>) -> Verdict {
    let is_any_rejected = rests.iter().any(|rest| rest.is_rejected);
    if rests.iter().all(Rest::is_held) {
        Verdict::Holds
    } else if !is_any_rejected {
        Verdict::Undecided
    } else if !rests.iter().any(Rest::is_held) {
        Verdict::DoesNotHold
    } else {
        let places = curves.iter().filter_map(|label| place(rests, label, axis));
        Verdict::HoldsWhere(places.collect::<Vec<_>>().join("; "))
    }
}

/// Where a curve holds its level: the whole of it by its name.
fn place(rests: &[Rest], label: &str, axis: Option<&Axis>) -> Option<String> {
    let of_curve: Vec<&Rest> = rests.iter().filter(|rest| rest.label == label).collect();
    let values: Vec<(&str, bool)> = of_curve
        .iter()
        .map(|rest| (rest.value.as_str(), rest.is_held()))
        .collect();
    match values.iter().filter(|(_, is_held)| *is_held).count() {
        0 => None,
        all if all == values.len() => Some(named(label)),
        _ => Some(format!("{}: {}", named(label), ranges(axis, &values))),
    }
}

/// The row that is worst for its level.
fn worst(rests: &[Rest], axis: Option<&Axis>) -> String {
    let excess = |rest: &Rest| rest.row.rate / rest.row.alpha;
    let worst = rests.iter().max_by(|a, b| excess(a).total_cmp(&excess(b)));
    let Some(Rest {
        label,
        value,
        row,
        p_value,
        ..
    }) = worst
    else {
        return String::new();
    };
    let held = rests.iter().filter(|rest| rest.is_held()).count();
    let rejected = rests.iter().filter(|rest| rest.is_rejected).count();
    format!(
        "{held} of {} held, {rejected} rejected; the largest for its α: {} at α = {}, p {}, {}, {}",
        rests.len(),
        interval(row.rate, row.low, row.high),
        row.alpha,
        in_short(*p_value),
        named(label),
        at(axis, value),
    )
}

/// Two digits, as a power of ten where they are small.
fn in_short(p_value: f64) -> String {
    match p_value {
        p if p < 1e-300 => "< 1e−300".to_owned(),
        p if p < 1e-3 => format!("= {p:.1e}").replace('-', "−"),
        p => format!("= {}", exact(format!("{p:.1e}").parse().unwrap_or(p))),
    }
}
