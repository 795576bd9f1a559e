//! Records at rest, counted.

use super::*;
use crate::detect::sequential::{Change, Chart, Score, Side};
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};

fn config(keys: &str, noise: &str) -> String {
    format!(
        "question = \"?\"\nseed = 3\ntrials = 40\n[run_length]\nper_hour = 180\nrate = 5\nblocks = 2000\n\
         {keys}\nnoise = [{noise}]\n"
    )
}

const NORMAL: &str = "{ label = \"normal\", law = \"normal\" }";

/// 40 records of 2000 blocks with some 20 false alarms each: the law's rate within 5.2 deviations of 800 alarms; colour of
/// 0.7 many times as many. Only what is promised is tested.
#[test]
fn rates_are_those_of_the_law() {
    let ties = "{ label = \"Cauchy, in steps\", law = \"cauchy\", quantum = 2.0 }";
    let colour = "{ label = \"AR 0.7\", law = \"normal\", colour = 0.7, promised = false }";
    let study = read::<Of<RunLengths>>(&config("", &[NORMAL, ties, colour].join(", ")));
    let all = rows(&study, 40);
    let of = |label: &str, outcome: &str| {
        let here = |row: &&Row| row.label == label && row.outcome == outcome;
        all.iter().find(here).unwrap()
    };
    for label in ["normal", "Cauchy, in steps"] {
        let row = of(label, "over_law");
        println!(
            "{label}: {} alarms, {:.3} of the law",
            row.count, row.estimate
        );
        assert!((row.estimate - 1.0).abs() < 5.2 / 28.0, "{row:?}");
        assert!(of(label, "over_promised").estimate < 1.05 * row.estimate);
    }
    assert!(of("AR 0.7", "over_law").estimate > 4.0);
    let tested = crate::study::Study::false_alarms(&study, &all);
    let names: Vec<&str> = tested.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["normal", "Cauchy, in steps"]);
    assert_eq!((tested[0].nominal, tested[0].tally.trials), (0.01, 80_000));
}

/// Two blocks a trial alarm as often as two of many: 10 000 trials with some 200 alarms, within 5.2 deviations. Without a
/// warm-up there would be none, as S cannot climb so fast.
#[test]
fn short_records_are_no_rarer() {
    let text = config("", NORMAL).replace("blocks = 2000", "blocks = 2");
    let text = text.replace("trials = 40", "trials = 10000");
    let rows = rows(&read::<Of<RunLengths>>(&text), 10_000);
    let row = rows.iter().find(|row| row.outcome == "over_law").unwrap();
    println!("{} alarms, {:.3} of the law", row.count, row.estimate);
    assert!((row.estimate - 1.0).abs() < 5.2 / 14.0);
}

#[test]
fn refusals() {
    let refused = |keys: &str, noise: &str| {
        let text = config(keys, noise);
        match keys.split_once("per_hour") {
            Some(_) => refusal::<RunLengths>(&text.replacen("per_hour = 180\n", "", 1)),
            None => refusal::<RunLengths>(&text),
        }
    };
    assert_eq!(refused("", NORMAL), None);
    for (keys, noise, expected) in [
        (
            "k = 0.81",
            NORMAL,
            "run_length.k: must be a multiple of 0.025, got 0.81",
        ),
        (
            "sides = []",
            NORMAL,
            "run_length.sides: must name each side once",
        ),
        (
            "reference = 8",
            NORMAL,
            "blocks, got 180 (lengthen the reference",
        ),
        (
            "reference = 1000000",
            NORMAL,
            "run_length.reference: must lie in [1, 10000] blocks, got 1000000",
        ),
        (
            "per_hour = 18000",
            NORMAL,
            "run_length.per_hour: must be less than 18000, the blocks in an hour, got 18000",
        ),
        ("per_hour = 1e300", NORMAL, "got 1e300"),
        ("", "", "run_length.noise: must name a noise, got none"),
        (
            "",
            &format!("{NORMAL}, {NORMAL}"),
            "run_length.noise[1].label: must differ",
        ),
        (
            "",
            "{ label = \"a\", law = \"normal\", colour = 0.3 }",
            "run_length.noise[0].colour: must be 0 where a rate is promised, got 0.3 (set promised = false",
        ),
        (
            "",
            "{ label = \"a\", law = \"normal\", quantum = 1e-320 }",
            "run_length.noise[0].quantum: must be 0 or at least 1e-9, got 1e-320",
        ),
        (
            "",
            "{ label = \"!\", law = \"normal\" }",
            "must have a letter or a digit, got !",
        ),
    ] {
        let error = refused(keys, noise).unwrap();
        assert!(error.contains(expected), "{error}");
    }
}

/// With a long reference the simulated delay is the exact one; a short one is seen later, and of a small shift not always.
#[test]
fn delays_of_a_finite_reference() {
    let chart = |n| Chart::new(Score::Normal, &[Side::Up, Side::Down], 0.8, n).unwrap();
    for (reference, shift) in [(2000, 1.5), (60, 1.5), (60, 0.75)] {
        let delay = delays(&chart(reference), 200, &[Change::shift(shift)], 2000)[0];
        println!("{reference}: {delay:?}");
        let half = delay.interval.1 - delay.mean;
        match (reference, shift) {
            // Ranks among 2000 are off by 2 %; 5.2 standard errors are 2.7 halves of an interval.
            (2000, _) => {
                assert!((delay.mean / delay.long - 1.0).abs() < 0.02 + 2.7 * half / delay.long);
                assert_eq!(delay.seen.hits, 2000);
            }
            (_, 1.5) => assert!(delay.mean > 1.2 * delay.long && delay.seen.rate() > 0.8),
            _ => assert!(delay.seen.rate() < 0.5),
        }
    }
}

/// A long reference takes no longer than a short one: fewer trials are made where each takes long.
#[test]
fn work_is_bounded() {
    let trials = |reference: usize, shift: f64| {
        let chart = Chart::new(Score::Normal, &[Side::Up], 3.0, reference).unwrap();
        let delay = delays(&chart, 200, &[Change::shift(shift)], 1000)[0];
        println!("N = {reference}, shift {shift}: {:?}", delay.seen);
        delay.seen.trials
    };
    assert_eq!(trials(60, 0.75), 1000, "which is never seen");
    assert!(trials(3000, 0.75) < 300);
    assert_eq!(trials(3000, 6.0), 1000, "which would be seen at once");
    assert_eq!(trials(100_000, 6.0), 100);
}

/// A shift is seen as often whatever sides look for it: of its own sign, and no less with vibration looked for too.
#[test]
fn every_side_sees_its_shift() {
    let seen = |sides: &[Side]| {
        let chart = Chart::new(Score::Normal, sides, 0.8, 60).unwrap();
        let delay = delays(&chart, 200, &[Change::shift(1.5)], 2000)[0];
        println!("{sides:?}: {delay:?}");
        delay.seen.rate()
    };
    let up = seen(&[Side::Up]);
    // Two rates of 2000 trials differ by less than 5.2 times sqrt(2 · 0.25 / 2000).
    assert!((seen(&[Side::Down]) - up).abs() < 5.2 * 0.016 && up > 0.8);
    for sides in [[Side::Down, Side::Scale], [Side::Up, Side::Scale]] {
        assert!(seen(&sides) > up - 5.2 * 0.016);
    }
}
