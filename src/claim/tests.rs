//! Every verdict of every test on made-up results, and the boundaries between verdicts.

use super::*;
use crate::experiment::SweepConfig;
use crate::plan::Plan;
use crate::results::Row;
use crate::stats::tally::Tally;

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

/// A curve that grows: three steps, and the last against the first.
const GROWING: [(f64, f64); 4] = [UP, UP, FLAT, UP];

fn growth(second: [(f64, f64); 4]) -> Verdict {
    verdict("\"grows\"", &[GROWING, second].concat())
}

/// The pairs of growth are later minus earlier, within a curve, and the last one is end to end. A
/// swapped pair would turn every growth into a fall; a pair across curves would compare noise.
#[test]
fn growth_compares_later_with_earlier() {
    let config = config("\"grows\"");
    let plan = Plan::new(&config).unwrap();
    let pairs = plan.pairs(&config);
    let place = |curve: &str, value: &str| Place {
        curve: curve.to_owned(),
        value: value.to_owned(),
    };
    assert_eq!(pairs.len(), 8);
    assert_eq!(pairs[0].places, [place("a", "0.5"), place("a", "0")]);
    assert_eq!(pairs[3].places, [place("a", "2"), place("a", "0")]);
    assert_eq!(pairs[7].places, [place("b", "2"), place("b", "0")]);
    for pair in &pairs {
        let (first, second) = (&plan.points[pair.first], &plan.points[pair.second]);
        assert!(first.scenario.motion.delta > second.scenario.motion.delta);
        assert_eq!(first.curve, second.curve);
        assert_eq!(pair.places[0].curve, first.label);
    }
}

/// Where nothing moves the points at rest are compared, also those that another curve has first.
#[test]
fn pairs_at_rest() {
    let text = "question = \"?\"\nseed = 1\n[impulses]\nnu = 0.0\n[axis]\ntraining = [64, 128]\n\
                [[curve]]\nlabel = \"a\"\n[[curve]]\nlabel = \"b\"\nimpulses = { theta = 3.0 }\n\
                [[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { equals = { first = \"a\", second = \"b\" } }\n\
                [[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"grows\"\n";
    let config = SweepConfig::parse("test", text).unwrap();
    let plan = Plan::new(&config).unwrap();
    let pairs = plan.pairs(&config);
    let found: Vec<_> = (pairs.iter())
        .map(|pair| (pair.claim, pair.first, pair.second))
        .collect();
    assert_eq!(plan.points.len(), 2, "θ is no difference at rest");
    assert_eq!(found, [(0, 0, 0), (0, 1, 1), (1, 1, 0), (1, 1, 0)]);
    // A point is as often right as itself: its difference from itself is nought in every trial.
    let tally = Tally {
        hits: 5_000,
        trials: 10_000,
    };
    let claims = &config.narrative.claims;
    let rows = comparisons(claims, &pairs, &[tally; 2], &[None; 4]);
    assert_eq!(
        (rows[0].first_only, rows[0].second_only),
        (Some(0), Some(0))
    );
    assert!(rows[0].high < 0.002 && rows[2].high > 0.02, "{rows:?}");
}

/// The level is shared by the comparisons of one claim, not by those of all.
#[test]
fn level_is_shared_within_a_claim() {
    let config = config("\"grows\"");
    let plan = Plan::new(&config).unwrap();
    let pairs = plan.pairs(&config);
    let tallies = vec![
        Tally {
            hits: 5,
            trials: 10
        };
        plan.points.len()
    ];
    let rows = comparisons(
        &config.narrative.claims,
        &pairs,
        &tallies,
        &[Some([1, 1]); 8],
    );
    for row in rows {
        assert_eq!(row.claim, 1);
        assert!((1.0 - row.confidence - 0.001 / 8.0).abs() < 1e-15);
    }
}

#[test]
fn growth_verdicts() {
    assert_eq!(growth(GROWING), Verdict::Holds);
    // A fall is named away, range by range: one that loses ranges would say "a" alone.
    let fallen = [UP, DOWN, UP, UP];
    let places = "\"a\"; \"b\": Δ/σ_ξ in [0, 0.5], Δ/σ_ξ in [1, 2]";
    assert_eq!(growth(fallen), holds_where(places));
    // Flat steps add up to no growth, so there is no range to name: the curve is a counter-example.
    assert_eq!(growth([FLAT, DOWN, FLAT, DOWN]), Verdict::DoesNotHold);
    // A curve that is flat over all refutes growth without a single fall.
    let flat = judged("\"grows\"", &[GROWING, [FLAT; 4]].concat());
    assert_eq!(flat.verdict, Verdict::DoesNotHold);
    assert!(
        flat.evidence
            .ends_with("; 1 of 2 curves is a counter-example"),
        "{flat:?}"
    );
    // One step that is not sure, or growth that is not: more trials, not a verdict.
    assert_eq!(growth([UP, WIDE, UP, UP]), Verdict::Undecided);
    assert_eq!(growth([FLAT, FLAT, FLAT, WIDE]), Verdict::Undecided);
}

/// A fall everywhere, or a fall and no growth, refutes; "undecided" would spare a false claim.
#[test]
fn growth_refuted() {
    let both = |curve: [(f64, f64); 4]| verdict("\"grows\"", &[curve, curve].concat());
    assert_eq!(both([UP, DOWN, UP, UP]), Verdict::DoesNotHold);
    assert_eq!(both([FLAT; 4]), Verdict::DoesNotHold);
    let mixed = [[WIDE, WIDE, WIDE, WIDE], [UP, DOWN, FLAT, FLAT]].concat();
    assert_eq!(verdict("\"grows\"", &mixed), Verdict::DoesNotHold);
}

/// At the margin itself: a step may reach −margin, a rise must pass +margin, a fall must pass −margin.
/// A strict sign in the place of a weak one shows here.
#[test]
fn growth_boundaries() {
    let step = |low: f64| growth([UP, (low, 0.1), UP, UP]);
    assert_eq!(step(-MARGIN), Verdict::Holds);
    assert_eq!(step(-MARGIN - 1e-9), Verdict::Undecided);
    let rise = |low: f64| growth([UP, UP, UP, (low, 0.2)]);
    assert_eq!(rise(MARGIN), Verdict::Undecided);
    assert_eq!(rise(MARGIN + 1e-9), Verdict::Holds);
    let fall = |high: f64| growth([UP, (-0.1, high), UP, UP]);
    assert_eq!(fall(-MARGIN), Verdict::Undecided);
    assert!(matches!(fall(-MARGIN - 1e-9), Verdict::HoldsWhere(_)));
}

/// Two values have one pair, which is both the step and the whole.
#[test]
fn growth_between_two_values() {
    let text = "question = \"?\"\nseed = 1\n[axis]\ndelta = [0.0, 1.0]\n\
                [[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"grows\"\n";
    let config = SweepConfig::parse("test", text).unwrap();
    let plan = Plan::new(&config).unwrap();
    let pairs = plan.pairs(&config);
    assert_eq!(pairs.len(), 1);
    let trials = 10_000;
    let tallies = [10, 3000, 6000].map(|hits| Tally { hits, trials });
    let claims = &config.narrative.claims;
    let comparisons = comparisons(claims, &pairs, &tallies, &[Some([3200, 200])]);
    let judgement = judge_first(&config, &[], comparisons.clone()).unwrap();
    assert_eq!(judgement.verdict, Verdict::Holds);
    assert!(judgement.evidence.contains("0.300 ["), "{judgement:?}");
    assert!(
        judgement.how.contains("1 paired comparison,"),
        "{judgement:?}"
    );
    // Comparisons of another claim say nothing here.
    let of_second = comparisons
        .into_iter()
        .map(|c| Comparison { claim: 2, ..c });
    assert!(matches!(
        judge_first(&config, &[], of_second.collect()),
        Err(ClaimError::NotCompared(_))
    ));
}

const EXCEEDS: &str = "{ exceeds = { first = \"a\", second = \"b\" } }";
const EQUALS: &str = "{ equals = { first = \"b\", second = \"a\" } }";

#[test]
fn exceeds_verdicts() {
    let verdict = |intervals: [(f64, f64); 4]| verdict(EXCEEDS, &intervals);
    assert_eq!(verdict([FLAT, UP, UP, FLAT]), Verdict::Holds);
    // Neighbours make a range, a lone value none; a wrong run would join across the fall.
    assert_eq!(verdict([UP, DOWN, UP, UP]), holds_where("Δ/σ_ξ in [1, 2]"));
    assert_eq!(verdict([UP, DOWN, UP, DOWN]), Verdict::DoesNotHold);
    assert_eq!(verdict([FLAT; 4]), Verdict::DoesNotHold);
    assert_eq!(verdict([DOWN, FLAT, WIDE, FLAT]), Verdict::DoesNotHold);
    assert_eq!(verdict([WIDE, FLAT, FLAT, FLAT]), Verdict::Undecided);
    // Somewhere above, elsewhere perhaps below: not yet.
    assert_eq!(verdict([UP, WIDE, UP, UP]), Verdict::Undecided);
    // Above or equal, whichever, is not below.
    assert_eq!(verdict([UP, (0.001, 0.1), UP, UP]), Verdict::Holds);
    // What is sure to be no more than the margin is no superiority.
    assert_eq!(verdict([(-0.1, MARGIN); 4]), Verdict::DoesNotHold);
}

#[test]
fn equals_verdicts() {
    let verdict = |intervals: [(f64, f64); 4]| verdict(EQUALS, &intervals);
    assert_eq!(verdict([FLAT; 4]), Verdict::Holds);
    // The ends belong to the range of equivalence.
    assert_eq!(verdict([(-MARGIN, MARGIN); 4]), Verdict::Holds);
    // Not visibly different is not equivalent.
    assert_eq!(verdict([FLAT, FLAT, FLAT, WIDE]), Verdict::Undecided);
    assert_eq!(verdict([WIDE; 4]), Verdict::Undecided);
    assert_eq!(
        verdict([FLAT, FLAT, DOWN, WIDE]),
        holds_where("Δ/σ_ξ in [0, 0.5]")
    );
    assert_eq!(verdict([UP, WIDE, DOWN, WIDE]), Verdict::DoesNotHold);
}

/// The pair of a contrast is the first curve minus the second at the same value.
#[test]
fn contrasts_compare_like_with_like() {
    let config = config(EQUALS);
    let plan = Plan::new(&config).unwrap();
    for pair in plan.pairs(&config) {
        let (first, second) = (&plan.points[pair.first], &plan.points[pair.second]);
        assert_eq!((first.label.as_str(), second.label.as_str()), ("b", "a"));
        assert_eq!(first.scenario.motion, second.scenario.motion);
        assert_eq!(pair.places[0].value, pair.places[1].value);
    }
    let evidence = judged(EQUALS, &[FLAT, DOWN, UP, FLAT]).evidence;
    assert_eq!(
        evidence,
        "differences from −0.150 [−0.200, −0.100] at Δ/σ_ξ = 0.5 to 0.150 [0.100, 0.200] at Δ/σ_ξ = 1; \
         2 of 4 comparisons are counter-examples"
    );
}

fn false_alarms(trials: u64, at_rest: [u64; 2], test: &str) -> Judgement {
    let config = config(test);
    let hits = at_rest.map(|hits| [hits, 0, 0, 0, 0]);
    let rows = rows(&config, trials, hits);
    judge_first(&config, &rows, Vec::new()).unwrap()
}

#[test]
fn false_alarm_verdicts() {
    let n = 200_000;
    let verdict = |trials, hits| false_alarms(trials, hits, "\"alpha_held\"").verdict;
    assert_eq!(verdict(n, [2000, 1990]), Verdict::Holds);
    // Half again too many in one curve: a counter-example, whatever the other does.
    assert_eq!(verdict(n, [3000, 1990]), Verdict::DoesNotHold);
    let evidence = false_alarms(n, [3000, 1990], "\"alpha_held\"").evidence;
    assert!(
        evidence.starts_with("1 of 2 pass, 1 are above α beyond doubt;"),
        "{evidence}"
    );
    assert_eq!(verdict(n, [3000, 3000]), Verdict::DoesNotHold);
    // Few trials cannot exclude 1.2 α; to call that held would be to look at a picture.
    assert_eq!(verdict(2_000, [20, 20]), Verdict::Undecided);
    // Only the rows of the curves named count.
    let one = "{ alpha_held = { curves = [\"b\"] } }";
    assert_eq!(false_alarms(n, [3000, 1990], one).verdict, Verdict::Holds);
    // A narrower excess takes more trials.
    let strict = "{ alpha_held = { excess = 1.01 } }";
    assert_eq!(
        false_alarms(n, [2000, 2000], strict).verdict,
        Verdict::Undecided
    );
}

/// At the boundary of rejection Holm's first step is half of level/2 for two rows; half the level as it is
/// would reject more, and so break the family-wise promise.
#[test]
fn false_alarm_boundary() {
    let (trials, level) = (200_000, 0.001);
    let p = |hits| Tally { hits, trials }.p_value_above(0.01);
    let critical = (2000..3000).find(|&hits| p(hits) <= level / 4.0).unwrap();
    let verdict = |hits| false_alarms(trials, [hits, 1900], "\"alpha_held\"").verdict;
    assert!(
        p(critical - 1) <= level / 2.0,
        "half the level would reject"
    );
    assert_eq!(verdict(critical - 1), Verdict::Holds);
    assert_eq!(verdict(critical), Verdict::DoesNotHold);
}

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
    // An open side says nothing: the other decides, or nothing does.
    let (down, up) = (f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(verdict(2.0, up, "from = 1"), Verdict::Holds);
    assert_eq!(verdict(2.0, up, "from = 1, to = 3"), Verdict::Undecided);
    assert_eq!(verdict(2.0, up, "to = 1"), Verdict::DoesNotHold);
    assert_eq!(verdict(down, 2.0, "to = 3"), Verdict::Holds);
    assert_eq!(verdict(down, 2.0, "from = 0, to = 3"), Verdict::Undecided);
    assert_eq!(verdict(down, 2.0, "from = 3"), Verdict::DoesNotHold);
}

/// What is missing is said, not judged.
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

/// Digits follow the interval; nought has no sign.
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
    assert_eq!(exact(0.009_972_063_095), "0.00997206");
}

/// Where the sweep of two curves has rows at rest for each of four rules or sizes, held by some.
fn held_along(axis: &str, hits: [[u64; 3]; 2]) -> Judgement {
    let text = format!(
        "question = \"?\"\nseed = 1\n[impulses]\nnu = 0.0\n[axis]\n{axis}\n[[curve]]\nlabel = \"a\"\n\
         [[curve]]\nlabel = \"b\"\nwhitening = {{ order = 3 }}\n\
         [[claim]]\nclaim = \"?\"\ntest = \"alpha_held\"\n"
    );
    let config = SweepConfig::parse("test", &text).unwrap_or_else(|error| panic!("{error}"));
    let points = Plan::new(&config).unwrap().points;
    let trials = 200_000;
    let rows: Vec<Row> = (points.iter().zip(hits.into_iter().flatten()))
        .map(|(point, hits)| Row::new(point, None, Tally { hits, trials }, 0.95))
        .collect();
    assert_eq!(rows.len(), 6);
    judge_first(&config, &rows, Vec::new()).unwrap()
}

/// α is held in ranges of an axis where every curve has one, of numbers and of more than a single value.
#[test]
fn false_alarms_along_an_axis() {
    let training = "training = [64, 128, 256]";
    let verdict = |axis, hits| held_along(axis, hits).verdict;
    assert_eq!(
        verdict(training, [[1990, 1990, 1990], [3000, 1990, 1990]]),
        holds_where("\"a\"; \"b\": training in [128, 256]")
    );
    let lone = [[1990, 1990, 1990], [3000, 3000, 1990]];
    assert_eq!(verdict(training, lone), Verdict::DoesNotHold);
    let rules = "rule = [\"wilcoxon\", \"product\", \"disjunction\"]";
    let named = [[1990, 1990, 1990], [3000, 1990, 1990]];
    assert_eq!(verdict(rules, named), Verdict::DoesNotHold);
    let judged = held_along(rules, named);
    assert!(
        judged
            .evidence
            .starts_with("5 of 6 pass, 1 are above α beyond doubt;"),
        "{judged:?}"
    );
}

/// A rate of 1.08 α passes in enough trials: the words of the rule must not promise more.
#[test]
fn false_alarms_in_words() {
    // 1040 of 100 000 is 1.04 α, p = 0.1; its upper limit is 0.0115.
    let held = false_alarms(100_000, [1040, 990], "\"alpha_held\"");
    assert_eq!(held.verdict, Verdict::Holds);
    assert_eq!(
        held.how,
        "no rate above α beyond doubt (exact tests, Holm), and each surely at most 1.2 α; 2 scenarios, \
         family-wise level 0.001"
    );
}
