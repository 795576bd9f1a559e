//! How many decibels of Δ does one curve save over another at the same power?
//!
//! Δ at which a curve crosses the power is bracketed by inverting its pointwise intervals on the axis's own
//! values: from the last value before the upper limits first reach the power, to the first value after the
//! lower limits were last below it. The gain is 20 log₁₀(Δ_second/Δ_first). Only the estimate itself joins
//! neighbouring rates by a straight line.
//!
//! Assumption: the true power does not fall along the axis. Then a bracket misses only if a limit fails
//! at one of the two values around the crossing: two upper limits and two lower ones. Two curves make eight
//! such events, so limits at level/8 each, that is two-sided intervals of confidence 1 − level/4, keep the
//! claim's level. A curve that does not reach the power within the axis has an open bracket, and so has the
//! gain. The narrower the steps around the crossing, the narrower the bracket.

use super::place::placed;
use super::words::{curve as named, decimals, exact, fixed};
use super::{ClaimError, Evidence, Judgement, Verdict};
use crate::experiment::{Claim, Test};
use crate::results::{Quantity, Row, eight_digits};

pub(super) fn judge(
    claim: &Claim,
    [first, second]: [&String; 2],
    power: f64,
    from: f64,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let Gain { a, b, decibels } = measure(claim, [first, second], power, evidence)?;
    let [best, low, high] = decibels;
    let verdict = match () {
        () if low > from => Verdict::Holds,
        () if high <= from => Verdict::DoesNotHold,
        () => Verdict::Undecided,
    };
    let places = decimals(low, high).min(2);
    Ok(Judgement {
        verdict,
        evidence: format!(
            "gain {} [{}, {}] dB; {} reaches {power} at {}, {} at {}",
            match best.is_nan() {
                true => "unknown".to_owned(),
                false => fixed(best, places),
            },
            fixed(low, places),
            fixed(high, places),
            named(first),
            a.in_words(),
            named(second),
            b.in_words(),
        ),
        how: format!(
            "Δ at power {power} of {} against {}: gain above {} dB; pointwise intervals inverted, \
             level {}",
            named(first),
            named(second),
            exact(from),
            claim.level,
        ),
    })
}

/// Both crossings, and the decibels between them with their interval.
struct Gain {
    a: Crossing,
    b: Crossing,
    decibels: [f64; 3],
}

fn measure(
    claim: &Claim,
    [first, second]: [&String; 2],
    power: f64,
    evidence: &Evidence,
) -> Result<Gain, ClaimError> {
    let bracket = |label| crossing(label, power, 1.0 - claim.level / 4.0, evidence);
    let (a, b) = (bracket(first)?, bracket(second)?);
    let low = decibels(b.low, a.high).unwrap_or(f64::NEG_INFINITY);
    let high = decibels(b.high, a.low).unwrap_or(f64::INFINITY);
    let best = decibels(b.best, a.best).unwrap_or(f64::NAN);
    Ok(Gain {
        a,
        b,
        decibels: [best, low, high],
    })
}

/// The gains that claims ask for: `gain_3_db` for the third claim.
///
/// # Errors
/// Where a curve has no row for each value of the axis.
pub fn gains(claims: &[Claim], evidence: &Evidence) -> Result<Vec<Quantity>, ClaimError> {
    let mut quantities = Vec::new();
    for (number, claim) in (1..).zip(claims) {
        let Test::Gain {
            first,
            second,
            power,
            ..
        } = &claim.test
        else {
            continue;
        };
        let [value, low, high] = measure(claim, [first, second], *power, evidence)?
            .decibels
            .map(eight_digits);
        quantities.push(Quantity {
            name: format!("gain_{number}_db"),
            value,
            low,
            high,
        });
    }
    Ok(quantities)
}

/// 20 log₁₀(second/first); none where both are nought or beyond the axis.
fn decibels(second: f64, first: f64) -> Option<f64> {
    let decibels = 20.0 * (libm::log10(second) - libm::log10(first));
    (!decibels.is_nan()).then_some(decibels)
}

/// Where a curve reaches the power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub low: f64,
    pub best: f64,
    pub high: f64,
}

impl Crossing {
    fn in_words(self) -> String {
        let Self { low, best, high } = self;
        let digits = decimals(low, high).min(4);
        let [best, low, high] = [best, low, high].map(|delta| fixed(delta, digits));
        format!("Δ/σ_ξ = {best} [{low}, {high}]")
    }
}

fn crossing(
    label: &str,
    power: f64,
    confidence: f64,
    evidence: &Evidence,
) -> Result<Crossing, ClaimError> {
    let rows = placed(evidence.axis, evidence.rows, label, false);
    let values: Option<Vec<f64>> = rows.iter().map(|(value, _)| value.parse().ok()).collect();
    let values = values.filter(|values| !values.is_empty());
    let values = values.ok_or_else(|| ClaimError::NoRows(label.to_owned()))?;
    let rows: Vec<&Row> = rows.into_iter().map(|(_, row)| row).collect();
    let limits: Vec<(f64, f64)> = rows
        .iter()
        .map(|row| row.tally().interval(confidence))
        .collect();
    let line = |limit: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..rows.len()).map(|i| (values[i], limit(i))).collect()
    };
    Ok(Crossing {
        low: last_before(&line(&|i| limits[i].1), power),
        best: first_reach(&line(&|i| rows[i].rate), power).max(values[0]),
        high: first_after(&line(&|i| limits[i].0), power),
    })
}

/// Where a broken line first reaches `power`: nought where it starts there, infinity where it never
/// does.
pub(super) fn first_reach(line: &[(f64, f64)], power: f64) -> f64 {
    match line.iter().position(|&(_, y)| y >= power) {
        Some(0) => 0.0,
        Some(index) => between(line[index - 1], line[index], power),
        None => f64::INFINITY,
    }
}

/// The last value before a line first reaches `power`: nought where it starts there, infinity where it
/// never does.
pub(super) fn last_before(line: &[(f64, f64)], power: f64) -> f64 {
    match line.iter().position(|&(_, y)| y >= power) {
        Some(0) => 0.0,
        Some(index) => line[index - 1].0,
        None => f64::INFINITY,
    }
}

/// The first value after a line was last below `power`: infinity where it ends below, its start where it
/// is nowhere below.
pub(super) fn first_after(line: &[(f64, f64)], power: f64) -> f64 {
    match line.iter().rposition(|&(_, y)| y < power) {
        Some(index) => line.get(index + 1).map_or(f64::INFINITY, |(x, _)| *x),
        None => line[0].0,
    }
}

fn between((x0, y0): (f64, f64), (x1, y1): (f64, f64), y: f64) -> f64 {
    x0 + (x1 - x0) * (y - y0) / (y1 - y0)
}
