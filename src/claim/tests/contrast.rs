//! One curve against another.

use super::*;

const EXCEEDS: &str = "{ exceeds = { first = \"a\", second = \"b\" } }";

#[test]
fn exceeds_verdicts() {
    let verdict = |intervals: [(f64, f64); 4]| verdict(EXCEEDS, &intervals);
    assert_eq!(verdict([FLAT, UP, UP, FLAT]), Verdict::Holds);
    assert_eq!(
        verdict([DOWN, FLAT, UP, UP]),
        holds_where("Δ/σ_ξ in [1, 2]")
    );
    // Shown on both sides of a fall, or of what is open: the range is not connected.
    assert_eq!(verdict([UP, DOWN, UP, UP]), Verdict::DoesNotHold);
    assert_eq!(verdict([DOWN, UP, FLAT, UP]), Verdict::DoesNotHold);
    assert_eq!(verdict([UP, DOWN, UP, DOWN]), Verdict::DoesNotHold);
    assert_eq!(verdict([FLAT; 4]), Verdict::DoesNotHold);
    assert_eq!(verdict([DOWN, FLAT, WIDE, FLAT]), Verdict::DoesNotHold);
    assert_eq!(verdict([WIDE, FLAT, FLAT, FLAT]), Verdict::Undecided);
    // Above at some values, undetermined at another.
    assert_eq!(verdict([UP, WIDE, UP, UP]), Verdict::Undecided);
    // Not below is enough at values that are not clearly above.
    assert_eq!(verdict([UP, (0.001, 0.1), UP, UP]), Verdict::Holds);
    // Differences shown to be within the margin refute superiority.
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
         2 of 4 comparisons are counter-examples, the worst at Δ/σ_ξ = 1"
    );
}
