//! Gains of constructed curves, and the coverage of their brackets.

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

/// The results of two curves on these values whose powers are these functions of Δ.
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
/// 20 lg(2/0.6) = 10.46 dB, and only this bound is known. Two such curves give no bound.
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
/// of either curve: the interval contains the truth, an end is open if a curve leaves it open, and no verdict
/// is wrong.
#[test]
fn the_truth_is_never_refuted() {
    let values: Vec<f64> = (6..=12).map(|step| f64::from(step) / 20.0).collect();
    let places = [0.02, 0.25, 0.299, 0.301, 0.45, 0.599, 0.601, 0.7, 5.0];
    for trials in [1_000, 100_000] {
        for (a, b) in places.into_iter().flat_map(|a| places.map(|b| (a, b))) {
            let logistic =
                |middle: f64| move |delta: f64| 1.0 / (1.0 + libm::exp(20.0 * (middle - delta)));
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
