//! Growth along the axis.

use super::*;

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

/// Without motion the points at rest are compared, including those that an earlier curve shares.
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
    assert_eq!(plan.points.len(), 2, "θ makes no difference at rest");
    assert_eq!(found, [(0, 0, 0), (0, 1, 1), (1, 1, 0), (1, 1, 0)]);
    // The difference of a point from itself is 0 in every trial.
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
    // The range leaves out the fall.
    let places = "\"a\"; \"b\": Δ/σ_ξ in [0.5, 2]";
    assert_eq!(growth([DOWN, UP, UP, UP]), holds_where(places));
    assert_eq!(
        growth([UP, DOWN, FLAT, UP]),
        holds_where("\"a\"; \"b\": Δ/σ_ξ in [0, 0.5]")
    );
    // Growth on both sides of a fall is no connected range.
    assert_eq!(growth([UP, DOWN, UP, UP]), Verdict::DoesNotHold);
    // Flat steps do not add up to growth, so there is no range, and the curve is a counter-example.
    assert_eq!(growth([FLAT, DOWN, FLAT, DOWN]), Verdict::DoesNotHold);
    // A curve that is flat overall refutes growth without a single fall.
    let flat = judged("\"grows\"", &[GROWING, [FLAT; 4]].concat());
    assert_eq!(flat.verdict, Verdict::DoesNotHold);
    assert!(
        flat.evidence
            .ends_with("; 1 of 2 curves is a counter-example"),
        "{flat:?}"
    );
    // An uncertain step or uncertain growth leaves the claim undecided.
    assert_eq!(growth([UP, WIDE, UP, UP]), Verdict::Undecided);
    assert_eq!(growth([FLAT, FLAT, FLAT, WIDE]), Verdict::Undecided);
}

/// A fall everywhere, or a fall without growth, refutes the claim; "undecided" would be wrong.
#[test]
fn growth_refuted() {
    let both = |curve: [(f64, f64); 4]| verdict("\"grows\"", &[curve, curve].concat());
    assert_eq!(both([UP, DOWN, UP, UP]), Verdict::DoesNotHold);
    assert_eq!(both([FLAT; 4]), Verdict::DoesNotHold);
    let mixed = [[WIDE, WIDE, WIDE, WIDE], [UP, DOWN, FLAT, FLAT]].concat();
    assert_eq!(verdict("\"grows\"", &mixed), Verdict::DoesNotHold);
}

/// At the margin itself: a step may reach −margin, a rise must pass +margin, a fall must pass −margin. The
/// test distinguishes < from ≤.
#[test]
fn growth_boundaries() {
    let step = |low: f64| growth([UP, (low, 0.1), UP, UP]);
    assert_eq!(step(-MARGIN), Verdict::Holds);
    assert_eq!(step(-MARGIN - 1e-9), Verdict::Undecided);
    let rise = |low: f64| growth([UP, UP, UP, (low, 0.2)]);
    assert_eq!(rise(MARGIN), Verdict::Undecided);
    assert_eq!(rise(MARGIN + 1e-9), Verdict::Holds);
    let fall = |high: f64| growth([UP, UP, (-0.1, high), UP]);
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
    // Comparisons of another claim do not count.
    let of_second = comparisons
        .into_iter()
        .map(|c| Comparison { claim: 2, ..c });
    assert!(matches!(
        judge_first(&config, &[], of_second.collect()),
        Err(ClaimError::NotCompared(_))
    ));
}
