//! Rates at rest against α.

use super::*;

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
    // Fifty percent too many in one curve: a counter-example, whatever the other shows.
    assert_eq!(verdict(n, [3000, 1990]), Verdict::DoesNotHold);
    let evidence = false_alarms(n, [3000, 1990], "\"alpha_held\"").evidence;
    assert!(
        evidence.starts_with("1 of 2 pass, 1 are above α beyond doubt;"),
        "{evidence}"
    );
    assert_eq!(verdict(n, [3000, 3000]), Verdict::DoesNotHold);
    // Few trials cannot exclude 1.2 α, so the claim is undecided.
    assert_eq!(verdict(2_000, [20, 20]), Verdict::Undecided);
    // Only the rows of the curves named count.
    let one = "{ alpha_held = { curves = [\"b\"] } }";
    assert_eq!(false_alarms(n, [3000, 1990], one).verdict, Verdict::Holds);
    // A smaller excess needs more trials.
    let strict = "{ alpha_held = { excess = 1.01 } }";
    assert_eq!(
        false_alarms(n, [2000, 2000], strict).verdict,
        Verdict::Undecided
    );
}

/// At the boundary of rejection: Holm's first step is half of level/2 for two rows. Half the full level would
/// reject more and break the family-wise level.
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

/// The verdict on a sweep of two curves along this axis with these false alarms.
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

/// A rate of 1.08 α passes in enough trials, so the words of the rule must not promise α.
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
