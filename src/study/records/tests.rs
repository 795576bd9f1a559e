//! What is said against the truth, by hand.

use super::detect::{Found, Outcome, Told};
use super::watched::{Danger, Heading};
use super::*;
use crate::lift::Journey;
use crate::monitor::Direction;
use crate::run::Trials;
use crate::study::kind::Study;
use crate::study::outcomes::Of;
use crate::study::parse;
use crate::study::tests::{UP, read, rows};

/// One trip up from 10 to 20 s, one down from 30 to 40 s, in a record from `from` to `to` s.
fn record(from: f64, to: f64) -> Record {
    let up = UP;
    let down = Journey {
        start: 30.0,
        stop: 40.0,
        direction: -1,
        ..up
    };
    let times = (0..600).map(|i| f64::from(i) / 10.0);
    let times: Vec<f64> = times.filter(|time| (from..=to).contains(time)).collect();
    let moves = |time: &f64| {
        let of = |trip: &Journey| trip.start < *time && *time < trip.stop;
        f64::from(u8::from(of(&up) || of(&down)))
    };
    Record {
        rate: 10.0,
        acceleration: vec![0.0; times.len()],
        speed: times.iter().map(moves).collect(),
        times,
        journeys: vec![up, down],
        drum: Vec::new(),
        slack: Vec::new(),
    }
}

fn told(record: &Record, trips: &[(f64, f64, Direction)], undecided: &[(f64, f64)]) -> [u64; 5] {
    let end = |time: f64| time.is_finite().then_some(time);
    let trips = trips.iter().map(|&(start, stop, direction)| Found {
        start: end(start),
        stop: end(stop),
        direction,
    });
    let outcome = Outcome {
        trips: trips.collect(),
        undecided: undecided.to_vec(),
    };
    let told = Told::new(record, &outcome, 0.2, 0.5);
    [
        told.found,
        told.undecided,
        told.misplaced,
        told.missed,
        told.false_trips,
    ]
}

#[test]
fn each_trip_is_told_in_one_way() {
    use Direction::{Down, Up};
    let all = record(0.0, 60.0);
    let (up, down) = ((10.2, 19.6, Up), (30.0, 40.0, Down));
    assert_eq!(told(&all, &[up, down], &[]), [2, 0, 0, 0, 0]);
    assert_eq!(told(&all, &[up], &[]), [1, 0, 0, 1, 0]);
    assert_eq!(told(&all, &[up], &[(39.0, 50.0)]), [1, 1, 0, 0, 0]);
    // Where it is found, what else is said of it is no harm.
    assert_eq!(told(&all, &[up, down], &[(0.0, 60.0)]), [2, 0, 0, 0, 0]);
    let late = (10.6, 20.0, Up);
    assert_eq!(told(&all, &[late, down], &[]), [1, 0, 1, 0, 0]);
    let wrong = (10.0, 20.0, Down);
    assert_eq!(told(&all, &[wrong, down], &[]), [1, 0, 0, 1, 1]);
    assert_eq!(
        told(&all, &[up, down, (45.0, 50.0, Up)], &[]),
        [2, 0, 0, 0, 1]
    );
    let open = (30.0, f64::INFINITY, Down);
    assert_eq!(told(&all, &[up, open], &[]), [1, 0, 1, 0, 0]);
}

#[test]
fn ends_outside_a_record_need_not_be_told() {
    use Direction::{Down, Up};
    let cut = record(15.0, 35.0);
    let (end, start) = ((f64::NEG_INFINITY, 20.1, Up), (29.9, f64::INFINITY, Down));
    assert_eq!(told(&cut, &[end, start], &[]), [2, 0, 0, 0, 0]);
    assert_eq!(
        told(&cut, &[(16.0, 20.0, Up), (30.0, 33.0, Down)], &[]),
        [2, 0, 0, 0, 0]
    );
    assert_eq!(told(&cut, &[], &[]), [0, 0, 0, 2, 0]);
    // Nor are they between rests that the record shows.
    let between = |record: &Record| Told::new(record, &Outcome::default(), 0.2, 0.5).between_rests;
    assert_eq!(between(&record(0.0, 60.0)), 2);
    assert_eq!(between(&record(8.0, 40.5)), 1);
    assert_eq!(between(&cut), 0);
    // What a record does not hold is not asked for.
    assert_eq!(told(&record(20.0, 29.0), &[], &[]), [0; 5]);
}

/// A second is free in each stretch; a hole ends one.
#[test]
fn rest_that_is_said_in_motion() {
    let milliseconds = |times: &[f64]| {
        let mut danger = Danger::default();
        for i in 0..1000 {
            let time = f64::from(i) / 100.0;
            let now = times
                .chunks(2)
                .any(|pair| pair[0] <= time && time < pair[1]);
            if !(7.0..8.0).contains(&time) {
                danger.step(time, now);
            }
        }
        danger.milliseconds()
    };
    assert_eq!(milliseconds(&[]), 0);
    assert_eq!(milliseconds(&[1.0, 1.9, 2.0, 2.9]), 0);
    assert!((1490..=1510).contains(&milliseconds(&[1.0, 3.5])));
    assert!((2480..=2520).contains(&milliseconds(&[1.0, 3.5, 4.0, 6.0])));
    // 1.5 s before the hole, and 0.5 s after it.
    assert!((490..=510).contains(&milliseconds(&[5.5, 8.5])));
}

/// Of a fast cage alone, whatever stands of a slow one.
#[test]
fn directions_that_stand() {
    let (up, down) = (Some(Direction::Up), Some(Direction::Down));
    let mut heading = Heading::default();
    for (seconds, speed, told) in [
        (1.0, 0.0, up),
        (2.0, -0.1, up),
        (4.0, 0.3, up),
        (8.0, 0.3, down),
        (16.0, -0.3, down),
        (32.0, -0.3, up),
        (64.0, 0.3, None),
    ] {
        heading.step(seconds, speed, told);
    }
    let (moved, right, wrong) = (124.0, 20.0, 40.0);
    assert_eq!(
        heading,
        Heading {
            moved,
            right,
            wrong
        }
    );
}

const HEAD: &str = "question = \"?\"\nseed = 5\ntrials = 3\n[records]\n";

#[test]
fn outcomes_of_each_class() {
    for (watch, outcomes) in [("detect", 7), ("monitor", 16)] {
        let class = "class = [\"ordinary\", \"drum\"]\n";
        let study: Of<Table> = read(&format!("{HEAD}watch = \"{watch}\"\n{class}"));
        let rows = rows(&study, 3);
        assert_eq!(rows.len(), 2 * outcomes);
        for row in &rows {
            assert!(
                row.low <= row.estimate && row.estimate <= row.high,
                "{row:?}"
            );
        }
        if watch == "monitor" {
            let of = |outcome: &str| rows.iter().find(|row| row.outcome == outcome).unwrap();
            assert!(of("directed").estimate > 0.8 && of("directed").exposure > 0.0);
            assert!(of("misdirected").estimate < 0.02);
        }
        let quantities = study.quantities(&rows).unwrap();
        assert_eq!(
            quantities[outcomes].name,
            format!("{}_drum", rows[0].outcome)
        );
        // Their counts pass the check of counts from a file.
        let counts = crate::run::whole(study.trials().unwrap(), 3, &()).unwrap();
        assert!((&study).check(&counts).is_ok());
    }
}

#[test]
fn refusals() {
    let refused = |table: &str| {
        let experiment = parse("test", &format!("{HEAD}{table}")).unwrap();
        let refused = <Table as Outcomes>::read(&experiment).err();
        refused.expect("it is refused").to_string()
    };
    let class = "watch = \"detect\"\nclass = ";
    assert!(refused(&format!("{class}[]\n")).contains("records.class: must name a class"));
    let twice = refused(&format!("{class}[\"slow\", \"slow\"]\n"));
    assert!(
        twice.contains("must name each class once, got slow twice"),
        "{twice}"
    );
    let unknown = refused(&format!("{class}[\"sloow\"]\n"));
    assert!(unknown.contains("slow"), "{unknown}");
    let far = refused(&format!("{class}[\"slow\"]\nsettings.detector.alpha = 2\n"));
    assert!(far.contains("records.settings.detector.alpha"), "{far}");
}
