//! The test `gain`: the decibels of Δ that one curve saves over another at the same power.
//!
//! # Where a curve reaches the power
//! Let p be the power and Δ* the smallest Δ ≥ 0 at which a curve reaches it. Assume that the true power does
//! not fall along the axis v₁ < … < vₙ. Then a value whose upper limit is below p lies below Δ*, and a value
//! whose lower limit is at least p does not, which gives a bracket [low, high] of Δ*:
//! - low is the last value before the upper limits first reach p; 0 if they do at v₁, and vₙ if they never do;
//! - high is the first value after the lower limits were last below p; v₁ if they never are, and ∞ if they
//!   still are at vₙ.
//!
//! The estimate interpolates linearly between neighbouring rates. Before v₁ and beyond vₙ it is a bracket too:
//! [0, v₁] or [vₙ, ∞].
//!
//! # The gain
//! 20 log₁₀(b/a) grows with b and falls with a, so for a in [a₋, a₊] and b in [b₋, b₊] it lies in
//! [20 log₁₀(b₋/a₊), 20 log₁₀(b₊/a₋)]. An open end (0 below, ∞ above) makes that side infinite and leaves the
//! other as it is; 0/0 gives no bound. The estimate follows from the two estimates in the same way: a number if
//! both curves cross within the axis, a bound if only one does, else unknown.
//!
//! A bracket misses only if a limit fails at one of the two values around the crossing: two upper limits and
//! two lower ones. Two curves make eight such events, so limits at level/8 each, that is two-sided intervals of
//! confidence 1 − level/4, keep the claim's level. Smaller steps around the crossing give a narrower bracket.

use super::words::{curve as named, decimals, exact, fixed};
use super::{Claim, ClaimError, Evidence, Judgement, Quantity, Test, Verdict};
use crate::format::eight_digits;

pub(super) fn judge(
    claim: &Claim,
    [first, second]: [&str; 2],
    power: f64,
    from: f64,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let [a, b] = crossings(claim, [first, second], power, evidence)?;
    let (estimate, [low, high]) = (gain(a.estimate, b.estimate), gain(a.interval, b.interval));
    let verdict = if low > from {
        Verdict::Holds
    } else if high <= from {
        Verdict::DoesNotHold
    } else {
        Verdict::Undecided
    };
    let places = decimals(low, high).min(2);
    let (first, second) = (named(first), named(second));
    Ok(Judgement {
        verdict,
        evidence: format!(
            "gain {} [{}, {}] dB; {first} reaches {power} at Δ/σ_ξ {}, {second} at Δ/σ_ξ {}",
            estimated(estimate, "", places),
            fixed(low, places),
            fixed(high, places),
            a.in_words(),
            b.in_words(),
        ),
        how: format!(
            "Δ at power {power} of {first} against {second}: gain above {} dB; pointwise intervals \
             inverted, level {}",
            exact(from),
            claim.level.get(),
        ),
    })
}

#[cfg(test)]
mod tests;

/// The quantity `gain_N_db` of each claim of a gain, where N is the number of the claim from 1.
///
/// # Errors
/// If a curve lacks a row for a value of the axis.
pub fn gains(claims: &[Claim], evidence: &Evidence) -> Result<Vec<Quantity>, ClaimError> {
    let mut quantities = Vec::new();
    for (number, claim) in (1..).zip(claims) {
        if let Test::Gain {
            first,
            second,
            power,
            ..
        } = &claim.test
        {
            let [a, b] = crossings(claim, [first, second], power.get(), evidence)?;
            let [low, high] = gain(a.interval, b.interval).map(eight_digits);
            quantities.push(Quantity {
                name: format!("gain_{number}_db"),
                value: eight_digits(bound(gain(a.estimate, b.estimate))),
                low,
                high,
            });
        }
    }
    Ok(quantities)
}

/// The range of 20 log₁₀(b/a).
fn gain([a_low, a_high]: [f64; 2], [b_low, b_high]: [f64; 2]) -> [f64; 2] {
    let decibels = |b: f64, a: f64| 20.0 * (libm::log10(b) - libm::log10(a));
    let or_nothing = |side: f64, nothing| if side.is_nan() { nothing } else { side };
    [
        or_nothing(decibels(b_low, a_high), f64::NEG_INFINITY),
        or_nothing(decibels(b_high, a_low), f64::INFINITY),
    ]
}

/// The number or bound of an estimate; NaN if it is unknown.
fn bound([low, high]: [f64; 2]) -> f64 {
    if low == high || low.is_finite() && high.is_infinite() {
        low
    } else if high.is_finite() {
        high
    } else {
        f64::NAN
    }
}

/// An estimate in words, with `equals` before a number.
fn estimated([low, high]: [f64; 2], equals: &str, digits: usize) -> String {
    if low == high {
        format!("{equals}{}", fixed(low, digits))
    } else if low.is_infinite() && high.is_infinite() {
        "unknown".to_owned()
    } else if high.is_infinite() {
        format!("at least {}", fixed(low, digits))
    } else {
        format!("at most {}", fixed(high, digits))
    }
}

fn crossings(
    claim: &Claim,
    curves: [&str; 2],
    power: f64,
    evidence: &Evidence,
) -> Result<[Crossing; 2], ClaimError> {
    let confidence = 1.0 - claim.level.get() / 4.0;
    let [first, second] = curves.map(|label| crossing(label, power, confidence, evidence));
    Ok([first?, second?])
}

fn crossing(
    label: &str,
    power: f64,
    confidence: f64,
    evidence: &Evidence,
) -> Result<Crossing, ClaimError> {
    let points: Option<Vec<Level>> = (evidence.along(label, false).into_iter())
        .map(|(value, outcome)| {
            let (low, high) = outcome.tally.interval(confidence);
            Some(Level {
                delta: value.parse().ok()?,
                rate: outcome.tally.rate(),
                low,
                high,
            })
        })
        .collect();
    let points = points.filter(|points| !points.is_empty());
    let points = points.ok_or_else(|| ClaimError::NoRows(label.to_owned()))?;
    Ok(Crossing::new(&points, power))
}

/// The power at a value of the axis, and its limits.
#[derive(Clone, Copy, Debug)]
struct Level {
    delta: f64,
    rate: f64,
    low: f64,
    high: f64,
}

/// The Δ at which a curve reaches the power.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing {
    estimate: [f64; 2],
    interval: [f64; 2],
}

impl Crossing {
    /// The crossing of at least one level along the axis.
    fn new(levels: &[Level], power: f64) -> Self {
        let (start, end) = (levels[0].delta, levels[levels.len() - 1].delta);
        let estimate = match levels.iter().position(|level| level.rate >= power) {
            Some(0) => [0.0, start],
            Some(index) => [between(levels[index - 1], levels[index], power); 2],
            None => [end, f64::INFINITY],
        };
        let low = match levels.iter().position(|level| level.high >= power) {
            Some(0) => 0.0,
            Some(index) => levels[index - 1].delta,
            None => end,
        };
        let high = match levels.iter().rposition(|level| level.low < power) {
            Some(index) => levels
                .get(index + 1)
                .map_or(f64::INFINITY, |level| level.delta),
            None => start,
        };
        Self {
            estimate,
            interval: [low, high],
        }
    }

    fn in_words(self) -> String {
        let [low, high] = self.interval;
        let digits = decimals(low, high).min(4);
        let [low, high] = [low, high].map(|delta| fixed(delta, digits));
        format!("{} [{low}, {high}]", estimated(self.estimate, "= ", digits))
    }
}

fn between(below: Level, above: Level, power: f64) -> f64 {
    let share = (power - below.rate) / (above.rate - below.rate);
    below.delta + (above.delta - below.delta) * share
}
