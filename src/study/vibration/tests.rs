//! Lifts, counted.

use super::car::{Car, RATE, knock_at};
use super::keys::Keys;
use super::{Row, Table};
use crate::rng::Stream;
use crate::study::outcomes::Of;
use crate::study::parse;
use crate::study::tests::{read, rows};

fn config(table: &str) -> String {
    format!("question = \"?\"\nseed = 7\ntrials = 12\n[vibration]\n{table}")
}

fn value(rows: &[Row], outcome: &str, at: usize) -> f64 {
    let of = rows.iter().filter(|row| row.outcome == outcome);
    of.map(|row| row.estimate).nth(at).unwrap()
}

/// At full speed in an even shaft without joints an energy is the variance of two directions, but for what a window's own mean
/// takes; and the noise of the sensor is in both.
#[test]
fn energies_are_as_asked_for() {
    let keys = Keys {
        uneven: 0.0,
        joints: 0.0,
        ..Keys::default()
    };
    let mut draws = Stream::new(1, "test", "").at(0);
    let car = Car::new(&keys, &mut draws);
    let way = car.way_between(&mut draws, [0.0, 32.0]);
    let speeds = vec![1.6; 2000];
    let across = car.across(&way, &speeds, &mut draws);
    let square = |samples: &[crate::recording::Sample]| {
        let all = samples.iter().skip(200);
        all.clone()
            .map(|it| it.acceleration * it.acceleration)
            .sum::<f64>()
            / all.len() as f64
    };
    let found = square(&across[0]) + square(&across[1]);
    let sensor = crate::track::Densities::of_sheet(250e-6) * RATE;
    let expected = 2.0 * (0.05 * 0.05 + sensor);
    // 18 s of a swing that forgets itself within 0.1 s: a tenth of deviation.
    assert!((found / expected - 1.0).abs() < 0.4, "{found} {expected}");
}

#[test]
fn knocks_ring_down() {
    let mut readings = vec![0.0; 300];
    knock_at(&mut readings, 100, 2.0);
    let most = readings
        .iter()
        .fold(0.0, |most: f64, it| most.max(it.abs()));
    assert!((1.0..2.0).contains(&most) && readings[99] == 0.0 && readings[220].abs() < 1e-2);
}

/// A small study of each measure: what it must roughly say, and that points of one lift give what each gives by itself.
#[test]
fn each_measure() {
    let baseline = "measure = \"baseline\"\n[vibration.axis]\nunlike = [0.0, 0.6]\n\
        [[vibration.curve]]\nlabel = \"printed\"\nstop = \"printed\"\nguard = \"printed\"\n\
        [[vibration.curve]]\nlabel = \"order\"\n\
        [[vibration.curve]]\nlabel = \"few\"\ntrips = 20\n";
    let study = read::<Of<Table>>(&config(baseline));
    let all = rows(&study, 12);
    assert_eq!(all.len(), 6 * 9);
    assert_eq!(
        (value(&all, "stopped", 2), value(&all, "early", 2)),
        (1.0, 0.0)
    );
    assert!(value(&all, "early", 1) > 0.3, "{}", value(&all, "early", 1));
    assert!(value(&all, "windows", 2) >= 999.0 && value(&all, "windows", 3) > 999.0);
    assert!(value(&all, "false_windows", 0) > 3.0 * value(&all, "false_windows", 2));
    assert!(value(&all, "false_windows", 2) < 4e-3);
    assert_eq!(
        (value(&all, "trips", 4), value(&all, "guarded", 4)),
        (20.0, 0.0)
    );
    let alone = "measure = \"baseline\"\n[vibration.axis]\nunlike = [0.6]\n";
    let alone = rows(&read::<Of<Table>>(&config(alone)), 12);
    assert_eq!(
        value(&alone, "false_windows", 0),
        value(&all, "false_windows", 3)
    );

    let knock = "measure = \"knock\"\n[vibration.axis]\nsize = [0.0, 8.0]\n";
    let all = rows(&read::<Of<Table>>(&config(knock)), 12);
    assert_eq!(value(&all, "rides", 0), 1.0);
    assert!(value(&all, "found", 0) < 0.2 && value(&all, "found", 1) == 1.0);
    assert!(
        value(&all, "located", 1) < 0.3,
        "{}",
        value(&all, "located", 1)
    );
}

#[test]
fn what_is_refused() {
    let axis = "\n[vibration.axis]\nunlike = [0.1]\n";
    for (table, expected) in [
        (
            format!("measure = \"baseline\"\nsize = 1.0{axis}"),
            "vibration.size: means nothing to measure = \"baseline\"",
        ),
        (
            format!("measure = \"baseline\"\ntrips = 1{axis}"),
            "vibration.trips: must lie in [2, 500], got 1",
        ),
        (
            format!("measure = \"knock\"\nguards = \"printed\"{axis}"),
            "vibration: unknown key",
        ),
    ] {
        let experiment = parse("test", &config(&table)).unwrap();
        let refused = crate::study::Loaded::new(experiment).err();
        let refusal = refused.expect("it is refused").to_string();
        assert!(refusal.contains(expected), "{refusal}");
    }
}
