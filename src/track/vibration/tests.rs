//! Energies computed by hand, the law of the order statistic, and files.

use super::*;
use crate::detection::{End, Trip};
use crate::monitor::Direction;
use crate::recording::Sample;
use crate::rng::{self, Stream};
use serde_json::{Value, json};

const RATE: f64 = 100.0;

fn record(of: impl Fn(usize) -> f64) -> Vec<Sample> {
    let samples = (0..400).map(|place| Sample {
        time: place as f64 / RATE,
        acceleration: of(place),
    });
    samples.collect()
}

/// ±0.2 about a level is 0.04, a level is nothing, and a slope of 1 m/s³ over 0.5 s has 50 readings 0.01 apart: (50² − 1)/12 · 1e-4.
#[test]
fn energies_by_hand() {
    let swing = record(|place| 3.0 + if place % 2 == 0 { 0.2 } else { -0.2 });
    let slope = record(|place| place as f64 / RATE);
    let across = [swing.clone(), slope];
    let found = windows(&across, RATE, &(1.0..3.2));
    assert_eq!(found.len(), 4);
    let expected = 0.04 + (50.0 * 50.0 - 1.0) / 12.0 * 1e-4;
    for (place, window) in found.iter().enumerate() {
        assert!((window.energy - expected).abs() < 1e-12, "{window:?}");
        assert_eq!(window.from, 1.0 + 0.5 * place as f64);
        assert!((window.from..window.to).contains(&window.peak));
    }
    // A hole of a quarter of a second takes the window with it, a repeated value says nothing.
    let mut holed = across.clone();
    holed[1].retain(|it| !(1.6..1.85).contains(&it.time));
    assert_eq!(windows(&holed, RATE, &(1.0..3.2)).len(), 3);
    let level = record(|_| 1.0);
    assert!(windows(&[level.clone(), level.clone()], RATE, &(1.0..3.2)).is_empty());
    assert!(windows(&across, RATE, &(3.2..1.0)).is_empty());
    // It is shaken most where it is knocked.
    let mut knocked = level;
    knocked[237].acceleration = 2.0;
    let found = windows(&[swing, knocked], RATE, &(1.0..3.2));
    assert_eq!(found[2].peak, 2.37);
}

#[test]
fn the_ends_of_trips_are_left_out() {
    let trip = Trip {
        ride: 1,
        direction: Direction::Up,
        start: Some(5.0),
        inertial: Some(7.0),
        braking: Some(12.0),
        levelling: None,
        landing: Some(12.0),
        stop: Some(15.0),
        speed: 1.0,
        ended: End::Stop,
        or_start: None,
        or_stop: None,
        start_decision: None,
        stop_decision: None,
        start_at: None,
        stop_at: None,
    };
    assert_eq!(part(&trip), Some(5.5..14.5));
    let levelling = Some(13.0);
    assert_eq!(part(&Trip { levelling, ..trip }), Some(5.5..13.0));
    assert_eq!(part(&Trip { stop: None, ..trip }), None);
}

/// Trips of sums 6 and 5 and of 3 windows and 1: the mean is 11/4, both are off by 9/4, and √(2 · 2 · (9/4)²)/4 is 9/8.
#[test]
fn a_mean_and_its_error_by_hand() {
    let mut baseline = Baseline::new(RATE);
    assert_eq!((baseline.mean(), baseline.standard_error()), (None, None));
    assert_eq!(baseline.learn(vec![1.0, 2.0, 3.0]), Learning::Learnt);
    assert_eq!(baseline.standard_error(), None);
    assert_eq!(baseline.learn(vec![5.0]), Learning::Learnt);
    assert_eq!(baseline.learn(vec![1.0, 2.0, 3.0]), Learning::Known);
    assert_eq!(baseline.learn(Vec::new()), Learning::Nothing);
    assert_eq!(
        (baseline.mean(), baseline.standard_error()),
        (Some(2.75), Some(1.125))
    );
}

fn random(trips: usize, windows: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut draws = Stream::new(seed, "vibration test", "").at(0);
    let trips = (0..trips).map(|_| {
        let energy = (-(rng::unit(&mut draws)).ln_1p()).exp();
        let trip = (0..windows).map(|_| energy * (0.5 + rng::unit(&mut draws)));
        trip.collect()
    });
    trips.collect()
}

/// Trips of 40 windows: 999 of them are in 25. Where trips are so unlike that a tenth of the mean is uncertain after ten,
/// 35 have to be learnt.
#[test]
fn it_settles() {
    let mut baseline = Baseline::new(RATE);
    for (place, trip) in random(25, 40, 1).into_iter().enumerate() {
        assert!(!baseline.has_settled());
        baseline.learn(trip);
        assert_eq!(baseline.expected_trips(), Some(25), "{place}");
    }
    assert!(baseline.has_settled());
    let trips = (0..10).map(|place| vec![1.0 + 0.3 * f64::from(place % 2 * 2 - 1) * 0.93; 200]);
    let mut unlike = Baseline::new(RATE);
    trips.zip(0..).for_each(|(mut trip, place)| {
        trip[0] += 1e-9 * f64::from(place);
        unlike.learn(trip);
    });
    let error = unlike.standard_error().unwrap() / unlike.mean().unwrap();
    assert!((error - 0.0930).abs() < 1e-3, "{error}");
    assert!(!unlike.has_settled());
    assert_eq!(unlike.expected_trips(), Some(35));
}

/// (20)–(22) as they stand, from all energies anew.
#[test]
fn the_printed_rule_is_as_printed() {
    let energies: Vec<f64> = random(1, 120, 2).concat();
    let mean = |n: usize| energies[..n].iter().sum::<f64>() / n as f64;
    let error = |j: usize| (mean(j) - mean(j - 1)).abs() / mean(j - 1) * 100.0;
    let mut rule = PrintedStop::default();
    for (place, energy) in energies.iter().enumerate() {
        let n = place + 1;
        let expected = (n >= 22).then(|| ((error(n) - error(n - 20)) / 20.0).atan().to_degrees());
        let found = rule.step(*energy);
        let both = found.zip(expected);
        assert_eq!(found.is_some(), expected.is_some(), "{n}");
        assert!(
            both.is_none_or(|(k, it)| (k - it).abs() < 1e-9),
            "{n} {both:?}"
        );
    }
    // Of nothing there is no error, and of what never changes it is zero.
    let mut nothing = PrintedStop::default();
    assert!((0..100).all(|_| nothing.step(0.0).is_none()));
    let mut constant = PrintedStop::default();
    let first = (0..100).find_map(|_| constant.step(1.0));
    assert!(first.is_some_and(PrintedStop::is_level));
}

/// Whichever of n + 1 ranks the next energy has, and each is equally likely: it is above the line for k of them.
#[test]
fn the_order_statistic_is_exact() {
    for (windows, rate, above) in [(9, 0.1, 1), (19, 0.1, 2), (99, 0.01, 1), (150, 0.02, 3)] {
        let ranks = 0..=windows;
        let is_above = |next: &usize| {
            let others = (0..=windows).filter(|it| it != next).map(|it| it as f64);
            *next as f64 > Guard::OrderStatistic.line(others.collect(), rate).unwrap()
        };
        assert_eq!(ranks.filter(is_above).count(), above, "{windows} {rate}");
        assert_eq!(Guard::of(windows, rate), Guard::OrderStatistic);
    }
    assert_eq!(Guard::OrderStatistic.line(vec![1.0; 98], 0.01), None);
    assert_eq!(Guard::of(98, 0.01), Guard::LogNormal);
}

/// 40 000 times 199 windows of a law with a heavy tail and another: P = 4/200. The number above is off by more than 5 deviations
/// once in 1.7 million.
#[test]
fn the_order_statistic_keeps_its_rate() {
    let (trials, rate) = (40_000u64, 0.02);
    let mut draws = Stream::new(5, "vibration test", "order").at(0);
    let above = (0..trials).filter(|_| {
        let mut energies: Vec<f64> = (0..200).map(|_| 1.0 / rng::unit(&mut draws)).collect();
        let next = energies.pop().unwrap();
        next > Guard::OrderStatistic.line(energies, rate).unwrap()
    });
    let (above, expected) = (above.count() as f64, rate * trials as f64);
    let deviations = (above - expected) / (expected * (1.0 - rate)).sqrt();
    assert!(
        deviations.abs() < 5.0,
        "n = {trials}, {above} above, {deviations} deviations"
    );
}

/// The largest energy is in one of the trips: left out, that one alarms, however unlike trips are.
#[test]
fn one_trip_in_all_alarms() {
    for trips in [12, 30] {
        let energies = random(trips, 1500 / trips, 3);
        let windows = energies.iter().map(Vec::len).sum::<usize>();
        let line =
            GuardLine::new(Guard::OrderStatistic, &energies, 1.0 / (windows + 1) as f64).unwrap();
        assert_eq!(line.per_trip, 1.0 / trips as f64);
        assert!(line.per_window >= 1.0 / windows as f64);
        assert_eq!(
            line.energy,
            energies.concat().into_iter().fold(0.0, f64::max)
        );
    }
}

/// Of logarithms 0 and 2 the mean is 1 and the deviation √2; z of 0.001 is 3.0902.
#[test]
fn other_lines_by_hand() {
    let energies = vec![1.0, (2.0f64).exp()];
    let line = Guard::LogNormal.line(energies, 1e-3).unwrap();
    assert!((line.ln() - (1.0 + 2f64.sqrt() * 3.090_232)).abs() < 1e-5);
    let line = Guard::Printed.line(vec![1.0, 2.0, 3.0], 1e-3);
    assert_eq!(line, Some(5.0));
    assert_eq!(Guard::Printed.line(vec![1.0], 1e-3), None);
    assert!(GuardLine::new(Guard::LogNormal, &[vec![1.0, 2.0]], 1e-3).is_none());
}

fn known() -> Baseline {
    let mut baseline = Baseline::new(99.4);
    random(3, 4, 4).into_iter().for_each(|trip| {
        baseline.learn(trip);
    });
    baseline
}

#[test]
fn what_is_saved_is_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lift.json");
    let baseline = known();
    baseline.save(&path).unwrap();
    baseline.save(&path).unwrap();
    assert_eq!(Baseline::load(&path).unwrap(), baseline);
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    let missing = Baseline::load(&folder.path().join("none"))
        .unwrap_err()
        .to_string();
    assert!(
        missing.contains("none: cannot be read") && missing.contains("--baseline"),
        "{missing}"
    );
}

fn refusal(text: &[u8]) -> String {
    let refused = Baseline::from_json("it", text).err();
    refused.map_or_else(String::new, |error| error.to_string())
}

type Change = fn(&mut Value);

#[test]
fn what_is_no_baseline_is_refused() {
    let text = known().to_json();
    assert_eq!(refusal(text.as_bytes()), "");
    for foreign in [&b""[..], b"time,x\n0,1\n", b"[]", &[0xff; 50]] {
        let refusal = refusal(foreign);
        assert!(
            refusal.starts_with("it: no baseline of vibration, which"),
            "{refusal}"
        );
    }
    let changes: [(&str, Change); 7] = [
        ("no baseline of vibration", |file| {
            file["format"] = json!("liftsim floor map")
        }),
        ("version 2, and this program reads up to 1", |file| {
            file["version"] = json!(2)
        }),
        ("damaged: unknown field", |file| file["new"] = json!(1)),
        ("damaged: missing field", |file| {
            file.as_object_mut().unwrap().remove("rate");
        }),
        ("damaged: rate: must be positive", |file| {
            file["rate"] = json!(0.0)
        }),
        ("damaged: trips[1]: must hold energies", |file| {
            file["trips"][1][2] = json!(-1e-3)
        }),
        ("damaged: trips[0]: must have a window", |file| {
            file["trips"][0] = json!([])
        }),
    ];
    for (expected, change) in changes {
        let mut file: Value = serde_json::from_str(&text).unwrap();
        change(&mut file);
        let refusal = refusal(file.to_string().as_bytes());
        assert!(
            refusal.starts_with(&format!("it: {expected}")),
            "{expected}: {refusal}"
        );
        assert!(refusal.ends_with(')'), "{refusal}");
    }
}

/// Cut off anywhere, or with any byte another, a file is refused or is a baseline that can be used.
#[test]
fn files_damaged_at_every_byte() {
    let text = known().to_json().into_bytes();
    for length in 0..text.len() - 1 {
        let cut = refusal(&text[..length]);
        // The last byte is the end of the line.
        assert!(!cut.is_empty(), "{length}");
    }
    for at in 0..text.len() {
        for byte in [0, b' ', b'"', b'-', b'.', b'9', b'e', b',', b']', 0xff] {
            let mut changed = text.clone();
            changed[at] = byte;
            if let Ok(mut baseline) = Baseline::from_json("it", &changed) {
                baseline.learn(vec![1.0, 2.0]);
                assert!(baseline.mean().is_some_and(f64::is_finite));
                assert!(baseline.expected_trips() > Some(0) && !baseline.has_settled());
                let line = baseline.guard(0.01).unwrap();
                assert!(line.energy > 0.0, "{line:?}");
            }
        }
    }
}
