//! How many decibels of Δ does one curve save over another at the same power?
//!
//! # Where a curve reaches the power
//! Let p be the power and Δ* the smallest Δ ≥ 0 at which a curve has it. Assumption: the true power does not
//! fall along the axis v₁ < … < vₙ. Then a value whose upper limit lies below p lies below Δ*, and one whose
//! lower limit is p or more does not, which brackets Δ* = [low, high]:
//! - low is the last value before the upper limits first reach p; nothing (0) where they do at v₁, and vₙ where
//!   they never do;
//! - high is the first value after the lower limits were last below p; v₁ where they never are, and nothing (∞)
//!   where they still are at vₙ.
//!
//! The estimate joins neighbouring rates by a straight line. Before v₁ and beyond vₙ there is no line, and it
//! is a bracket too: [0, v₁] or [vₙ, ∞].
//!
//! # The gain
//! 20 log₁₀(b/a) grows with b and falls with a, so for a in [a₋, a₊] and b in [b₋, b₊] it lies in
//! [20 log₁₀(b₋/a₊), 20 log₁₀(b₊/a₋)]. An end that is nothing (0 below, ∞ above) makes an infinite side, and the
//! other side stays as good as it is; 0/0 says nothing. The estimate is the same of two estimates: a number
//! where both curves cross within the axis, a bound where that is all there is, else unknown.
//!
//! A bracket misses only if a limit fails at one of the two values around the crossing: two upper limits and
//! two lower ones. Two curves make eight such events, so limits at level/8 each, that is two-sided intervals of
//! confidence 1 − level/4, keep the claim's level. The narrower the steps around the crossing, the narrower
//! the bracket.

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

/// `gain_N_db` for the N-th claim (from 1), for each claim of a gain.
///
/// # Errors
/// Where a curve has no rows.
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

/// Of b over a, in decibels.
fn gain([a_low, a_high]: [f64; 2], [b_low, b_high]: [f64; 2]) -> [f64; 2] {
    let decibels = |b: f64, a: f64| 20.0 * (libm::log10(b) - libm::log10(a));
    let or_nothing = |side: f64, nothing| if side.is_nan() { nothing } else { side };
    [
        or_nothing(decibels(b_low, a_high), f64::NEG_INFINITY),
        or_nothing(decibels(b_high, a_low), f64::INFINITY),
    ]
}

/// The number, or the bound, that an estimate is; NaN where it is unknown.
fn bound([low, high]: [f64; 2]) -> f64 {
    if low == high || low.is_finite() && high.is_infinite() {
        low
    } else if high.is_finite() {
        high
    } else {
        f64::NAN
    }
}

/// An estimate in words; `equals` comes before a number.
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

/// Where a curve reaches the power.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing {
    estimate: [f64; 2],
    interval: [f64; 2],
}

impl Crossing {
    /// Of at least one level along the axis.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Axis, Outcome, Scope, judge as judge_claim};
    use crate::stats::tally::Tally;

    /// A claim that a gains more than `from` over b at power one half.
    fn claim(from: f64) -> Claim {
        serde_json::from_value(serde_json::json!({
            "claim": "?",
            "test": { "gain": { "first": "a", "second": "b", "power": 0.5, "from": from } },
        }))
        .unwrap()
    }

    /// What two curves on these values show, whose powers are these functions of Δ.
    fn evidence(values: &[f64], trials: u64, powers: [&dyn Fn(f64) -> f64; 2]) -> Evidence {
        let outcomes = ["a", "b"]
            .into_iter()
            .zip(powers)
            .flat_map(|(label, power)| {
                values.iter().map(move |&delta| Outcome {
                    label: label.to_owned(),
                    value: delta.to_string(),
                    is_at_rest: false,
                    tally: Tally {
                        hits: (power(delta) * trials as f64).round() as u64,
                        trials,
                    },
                    low: 0.0,
                    high: 1.0,
                    alpha: 0.01,
                    size: None,
                    reachable: None,
                })
            });
        let axis = Axis {
            name: "delta",
            symbol: "Δ",
            values: values.iter().map(|&v| (v.to_string(), Some(v))).collect(),
        };
        Evidence {
            outcomes: outcomes.collect(),
            scope: Scope {
                curves: Vec::new(),
                axis,
            },
            ..Evidence::default()
        }
    }

    /// Steps of 0.1 up to 2; the power is Δ times the slope of each curve, in a million trials.
    fn of_slopes([a, b]: [f64; 2]) -> Evidence {
        let values: Vec<f64> = (1..=20).map(|step| f64::from(step) / 10.0).collect();
        let line = |slope: f64| move |delta: f64| (slope * delta).min(1.0);
        evidence(&values, 1_000_000, [&line(a), &line(b)])
    }

    fn judged(evidence: &Evidence, from: f64) -> Judgement {
        judge_claim(&claim(from), 1, evidence).unwrap()
    }

    fn verdict(slopes: [f64; 2], from: f64) -> Verdict {
        judged(&of_slopes(slopes), from).verdict
    }

    /// Curve a reaches one half at Δ = 0.5, curve b at 1: six decibels, between 20 lg(0.9/0.6) = 3.52 and
    /// 20 lg(1.1/0.4) = 8.79. A gain with the curves exchanged would be −6, one in 10 lg would be 3.
    #[test]
    fn within_the_axis() {
        let gained = judged(&of_slopes([1.0, 0.5]), 3.4);
        assert_eq!(gained.verdict, Verdict::Holds);
        assert!(
            gained.evidence.starts_with("gain 6.0 [3.5, 8.8] dB"),
            "{gained:?}"
        );
        assert_eq!(verdict([1.0, 0.5], 3.6), Verdict::Undecided);
        assert_eq!(verdict([1.0, 0.5], 8.9), Verdict::DoesNotHold);
        assert_eq!(verdict([0.5, 1.0], 0.0), Verdict::DoesNotHold);
    }

    /// A curve that never reaches the power needs more than Δ = 2: over it a gains at least
    /// 20 lg(2/0.6) = 10.46 dB, and that is all that is known. Two such curves say nothing.
    #[test]
    fn beyond_the_axis() {
        assert_eq!(verdict([1.0, 0.1], 10.0), Verdict::Holds);
        assert_eq!(verdict([1.0, 0.1], 10.5), Verdict::Undecided);
        assert_eq!(verdict([1.0, 0.1], 100.0), Verdict::Undecided);
        assert_eq!(verdict([0.1, 1.0], 0.0), Verdict::DoesNotHold);
        assert_eq!(verdict([0.1, 1.0], -10.5), Verdict::Undecided);
        assert_eq!(verdict([0.1, 0.1], 0.0), Verdict::Undecided);
        assert_eq!(verdict([9.0, 9.0], 0.0), Verdict::Undecided);
        let open = judged(&of_slopes([1.0, 0.1]), 10.0).evidence;
        assert_eq!(
            open,
            "gain at least 12.04 [10.46, ∞] dB; \"a\" reaches 0.5 at Δ/σ_ξ = 0.50 [0.40, 0.60], \
             \"b\" at Δ/σ_ξ at least 2.00 [2.00, ∞]"
        );
    }

    /// On a short axis, for crossings below its first value, inside, beyond its last and close to either end,
    /// of either curve: the interval has the truth in it, an end is open where a curve leaves it open, and no
    /// verdict is wrong.
    #[test]
    fn the_truth_is_never_refuted() {
        let values: Vec<f64> = (6..=12).map(|step| f64::from(step) / 20.0).collect();
        let places = [0.02, 0.25, 0.299, 0.301, 0.45, 0.599, 0.601, 0.7, 5.0];
        for trials in [1_000, 100_000] {
            for (a, b) in places.into_iter().flat_map(|a| places.map(|b| (a, b))) {
                let logistic = |middle: f64| {
                    move |delta: f64| 1.0 / (1.0 + libm::exp(20.0 * (middle - delta)))
                };
                let evidence = evidence(&values, trials, [&logistic(a), &logistic(b)]);
                let truth = 20.0 * libm::log10(b / a);
                let Quantity {
                    value, low, high, ..
                } = gains(&[claim(0.0)], &evidence).unwrap().remove(0);
                assert!(
                    low <= truth && truth <= high,
                    "{a} {b}: {low} {truth} {high}"
                );
                assert!(
                    value.is_nan() || low <= value && value <= high,
                    "{a} {b}: {value}"
                );
                if [a, b]
                    .iter()
                    .all(|place| ![0.299, 0.301, 0.599, 0.601].contains(place))
                {
                    let is_open = |below: f64, beyond: f64| below < 0.3 || beyond > 0.6;
                    assert_eq!(low == f64::NEG_INFINITY, is_open(b, a), "{a} {b}: {low}");
                    assert_eq!(high == f64::INFINITY, is_open(a, b), "{a} {b}: {high}");
                }
                let verdict = |from| judged(&evidence, from).verdict;
                assert_ne!(verdict(truth + 0.001), Verdict::Holds, "{a} {b}");
                assert_ne!(verdict(truth - 0.001), Verdict::DoesNotHold, "{a} {b}");
            }
        }
    }

    /// A curve that touches the power twice is bracketed from before the first touch to after the last.
    #[test]
    fn brackets_are_widest() {
        let rates = [(0.0, 0.1), (1.0, 0.6), (2.0, 0.4), (3.0, 0.9)];
        let levels = rates.map(|(delta, rate)| Level {
            delta,
            rate,
            low: rate,
            high: rate,
        });
        let crossing = |power| Crossing::new(&levels, power);
        assert!((crossing(0.35).estimate[0] - 0.5).abs() < 1e-12);
        assert_eq!(crossing(0.5).interval, [0.0, 3.0]);
        assert_eq!(crossing(0.7).interval, [2.0, 3.0]);
        assert_eq!(crossing(0.05).interval, [0.0, 0.0]);
        assert_eq!(crossing(0.95).interval, [3.0, f64::INFINITY]);
        assert_eq!(crossing(0.95).estimate, [3.0, f64::INFINITY]);
    }
}
