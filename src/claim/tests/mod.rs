//! Every verdict of every test on constructed results, and the boundaries between verdicts.

use super::*;
use crate::experiment::SweepConfig;
use crate::plan::Plan;
use crate::results::Row;
use crate::stats::tally::Tally;

mod contrast;
mod false_alarm;
mod further;
mod growth;

const MARGIN: f64 = 0.005;

/// Two curves, four values of Δ, and one claim with this test.
fn config(test: &str) -> SweepConfig {
    let text = format!(
        "question = \"?\"\nseed = 1\n[axis]\ndelta = [0.0, 0.5, 1.0, 2.0]\n\
         [[curve]]\nlabel = \"a\"\n[[curve]]\nlabel = \"b\"\nwhitening = {{ order = 3 }}\n\
         [[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = {test}\n"
    );
    SweepConfig::parse("test", &text).unwrap_or_else(|error| panic!("{error}"))
}

/// The rows of that config, by their counts: at rest and along the axis, for either curve.
fn rows(config: &SweepConfig, trials: u64, hits: [[u64; 5]; 2]) -> Vec<Row> {
    let points = Plan::new(config).unwrap().points;
    let hits = hits.into_iter().flatten();
    (points.iter().zip(hits))
        .map(|(point, hits)| Row::new(point, None, Tally { hits, trials }, 0.95))
        .collect()
}

/// The first claim of a config, by its rows and comparisons.
fn judge_first(
    config: &SweepConfig,
    rows: &[Row],
    comparisons: Vec<Comparison>,
) -> Result<Judgement, ClaimError> {
    let outcomes = rows.iter().map(|row| row.outcome(config.parameter()));
    let evidence = Evidence {
        scope: config.scope.clone(),
        outcomes: outcomes.collect(),
        comparisons,
        quantities: Vec::new(),
    };
    judge(&config.narrative.claims[0], 1, &evidence)
}

/// The comparisons of that config with these intervals, in the order of its pairs.
fn judged(test: &str, intervals: &[(f64, f64)]) -> Judgement {
    let config = config(test);
    let pairs = Plan::new(&config).unwrap().pairs(&config);
    assert_eq!(pairs.len(), intervals.len(), "{test}");
    let comparison = |(pair, &(low, high)): (&Pair, &(f64, f64))| {
        let tallies = [Tally { hits: 0, trials: 1 }; 2];
        Comparison {
            difference: (low + high) / 2.0,
            low,
            high,
            ..Comparison::new(1, pair.places.clone(), tallies, None, 0.999)
        }
    };
    let comparisons = pairs.iter().zip(intervals).map(comparison).collect();
    judge_first(&config, &[], comparisons).unwrap()
}

fn verdict(test: &str, intervals: &[(f64, f64)]) -> Verdict {
    judged(test, intervals).verdict
}

fn holds_where(places: &str) -> Verdict {
    Verdict::HoldsWhere(places.to_owned())
}

const UP: (f64, f64) = (0.1, 0.2);
const FLAT: (f64, f64) = (-0.001, 0.001);
const DOWN: (f64, f64) = (-0.2, -0.1);
const WIDE: (f64, f64) = (-0.1, 0.1);

const EQUALS: &str = "{ equals = { first = \"b\", second = \"a\" } }";

#[test]
fn quantity_verdicts() {
    let verdict = |low, high, test: &str| {
        let config = config(&format!("{{ quantity = {{ name = \"x\", {test} }} }}"));
        let quantity = Quantity {
            name: "x".to_owned(),
            value: low,
            low,
            high,
        };
        let evidence = Evidence {
            quantities: vec![quantity],
            ..Evidence::default()
        };
        judge(&config.narrative.claims[0], 1, &evidence)
            .unwrap()
            .verdict
    };
    // The ends belong to the range.
    assert_eq!(verdict(0.0, 1.0, "from = 0, to = 1"), Verdict::Holds);
    assert_eq!(verdict(0.0, 0.0, "from = 0.0, to = 0.0"), Verdict::Holds);
    assert_eq!(verdict(0.0, 1.1, "from = 0, to = 1"), Verdict::Undecided);
    assert_eq!(verdict(1.0, 1.1, "from = 0, to = 1"), Verdict::Undecided);
    assert_eq!(verdict(1.01, 1.1, "to = 1"), Verdict::DoesNotHold);
    assert_eq!(verdict(-1.0, -0.1, "from = 0"), Verdict::DoesNotHold);
    assert_eq!(verdict(5.0, 9.0, "from = 0"), Verdict::Holds);
    // With an open side only the other side can decide.
    let (down, up) = (f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(verdict(2.0, up, "from = 1"), Verdict::Holds);
    assert_eq!(verdict(2.0, up, "from = 1, to = 3"), Verdict::Undecided);
    assert_eq!(verdict(2.0, up, "to = 1"), Verdict::DoesNotHold);
    assert_eq!(verdict(down, 2.0, "to = 3"), Verdict::Holds);
    assert_eq!(verdict(down, 2.0, "from = 0, to = 3"), Verdict::Undecided);
    assert_eq!(verdict(down, 2.0, "from = 3"), Verdict::DoesNotHold);
}

/// Missing results give an error, not a verdict.
#[test]
fn evidence_that_is_missing() {
    let missing = |test: &str, rows: &[Row]| {
        judge_first(&config(test), rows, Vec::new())
            .expect_err("nothing to judge")
            .to_string()
    };
    assert!(missing("\"grows\"", &[]).contains("have not been compared"));
    assert!(missing(EQUALS, &[]).contains("have not been compared"));
    assert!(missing("\"alpha_held\"", &[]).contains("no row at rest"));
    let gain = "{ gain = { first = \"a\", second = \"b\" } }";
    assert!(missing(gain, &[]).contains("no row for each value"));
    let quantity = "{ quantity = { name = \"largest\", from = 0.0 } }";
    assert!(missing(quantity, &[]).contains("`largest`: not among the results, which have none"));
}

/// The number of digits follows the interval; zero has no sign.
#[test]
fn numbers_in_words() {
    use super::words::{exact, interval};
    assert_eq!(
        interval(0.82345, 0.82128, 0.82466),
        "0.8235 [0.8213, 0.8247]"
    );
    assert_eq!(interval(-0.5, -0.9, -0.1), "−0.50 [−0.90, −0.10]");
    assert_eq!(interval(-0.0001, -0.1, 0.1), "0.00 [−0.10, 0.10]");
    assert_eq!(interval(2.0, 2.0, 2.0), "2");
    let endless = |value| interval(value, f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(endless(0.93651), "0.937 (no interval)");
    assert_eq!(endless(0.0004194), "0.000419 (no interval)");
    assert_eq!(exact(0.009_972_063_095), "0.00997206");
}
