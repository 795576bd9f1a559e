//! Rides whose figures can be computed by hand.

use super::*;
use libm::sin;
use std::f64::consts::TAU;

const RATE: f64 = 200.0;

/// A ride up from 5 to 17 s: ramps of 1 s to ±1 m/s², held for 1 s, and 6 s at 2 m/s.
const KNOTS: [(f64, f64); 10] = [
    (0.0, 0.0),
    (5.0, 0.0),
    (6.0, 1.0),
    (7.0, 1.0),
    (8.0, 0.0),
    (14.0, 0.0),
    (15.0, -1.0),
    (16.0, -1.0),
    (17.0, 0.0),
    (22.0, 0.0),
];

fn ride() -> Ride {
    Ride {
        phases: Phases {
            before: 2.85..4.85,
            uniform: [8.3..13.7, 17.0..17.0],
            after: 17.15..18.15,
        },
        sign: 1.0,
    }
}

fn samples(of: impl Fn(f64) -> f64) -> Vec<Sample> {
    let times = (0..(22.0 * RATE) as usize).map(|k| k as f64 / RATE);
    let sample = |time| Sample {
        time,
        acceleration: of(time),
    };
    times.map(sample).collect()
}

fn smooth(time: f64) -> f64 {
    let next = KNOTS
        .partition_point(|it| it.0 <= time)
        .min(KNOTS.len() - 1);
    let [(t0, a0), (t1, a1)] = [KNOTS[next - 1], KNOTS[next]];
    a0 + (a1 - a0) * (time - t0) / (t1 - t0)
}

fn figure(quality: &Quality, measure: Measure) -> f64 {
    quality.figure(measure).unwrap().value
}

#[test]
fn figures_of_a_smooth_ride() {
    let quality = Quality::of(&samples(|time| 9.8 + smooth(time)), &[], RATE, &ride()).unwrap();
    let expected = [
        (Measure::Acceleration, 1.0),
        (Measure::Acceleration95, 1.0),
        (Measure::Deceleration, 1.0),
        (Measure::Deceleration95, 1.0),
        (Measure::Speed, 2.0),
        (Measure::Speed95, 2.0),
        (Measure::Jerk, 1.0),
    ];
    for (measure, expected) in expected {
        let found = figure(&quality, measure);
        assert!((found - expected).abs() < 0.01, "{measure:?}: {found}");
    }
    // What the band limit still passes of the ramps.
    assert!(figure(&quality, Measure::Vertical) < 0.02, "{quality:?}");
    assert_eq!(quality.figure(Measure::Horizontal), None);
}

/// Swings of known frequency come out times their weight; where rest swings as much, that may be noise.
#[test]
fn figures_of_vibration() {
    let swing = |time: f64| {
        if (5.0..17.0).contains(&time) {
            0.1 * sin(TAU * 5.0 * time)
        } else {
            0.0
        }
    };
    let vertical = samples(|time| smooth(time) + swing(time));
    let across = [1.0, 0.2].map(|share| samples(|time| share * 0.05 * sin(TAU * time)));
    let quality = Quality::of(&vertical, &across, RATE, &ride()).unwrap();
    let expected = [
        (
            Measure::Vertical,
            0.2 * Weighting::Vertical.factor(5.0).norm(),
            false,
        ),
        (
            Measure::Horizontal,
            0.1 * Weighting::Horizontal.factor(1.0).norm(),
            true,
        ),
    ];
    for (measure, expected, is_noise) in expected {
        let found = quality.figure(measure).unwrap();
        assert!(
            (found.value / expected - 1.0).abs() < 0.03,
            "{measure:?}: {found:?} {expected}"
        );
        assert_eq!(found.is_noise(), is_noise, "{measure:?}");
    }
}

/// Where hardly any rest is recorded before a ride, nothing is said to be noise; and of none at all nothing is said.
#[test]
fn without_rest_nothing_is_compared() {
    let short = |before: f64, after: f64| {
        let mut ride = ride();
        ride.phases.before.start = ride.phases.before.end - before;
        ride.phases.after.end = ride.phases.after.start + after;
        Quality::of(&samples(smooth), &[], RATE, &ride)
    };
    let vertical = short(0.5, 1.0).unwrap().figure(Measure::Vertical);
    assert_eq!(vertical.unwrap().at_rest, None);
    assert_eq!(short(0.0, 0.05), None);
}

#[test]
fn a_hole_leaves_nothing() {
    let mut holed = samples(smooth);
    holed.retain(|it| !(9.0..9.5).contains(&it.time));
    assert_eq!(Quality::of(&holed, &[], RATE, &ride()), None);
}

/// Each limit is kept, broken, or broken by what may be noise.
#[test]
fn verdicts() {
    let limits = Limits::gb_t_10058(1.75);
    let judged = |measure, value, at_rest| {
        let mut quality = Quality::default();
        quality.set(measure, Some(Figure { value, at_rest }));
        limits.verdict(&quality, measure)
    };
    assert_eq!(
        judged(Measure::Acceleration, 1.4, None),
        Some(Verdict::Pass)
    );
    assert_eq!(
        judged(Measure::Acceleration, 1.6, None),
        Some(Verdict::Fail)
    );
    assert_eq!(
        judged(Measure::Deceleration95, 0.4, Some(0.1)),
        Some(Verdict::Fail)
    );
    assert_eq!(
        judged(Measure::Vertical, 0.4, Some(0.1)),
        Some(Verdict::Fail)
    );
    assert_eq!(
        judged(Measure::Vertical, 0.4, Some(0.3)),
        Some(Verdict::Noise)
    );
    assert_eq!(judged(Measure::Jerk, 9.0, None), None);
    let mut quality = Quality::default();
    let mut overall = |measure, value, at_rest| {
        quality.set(measure, Some(Figure { value, at_rest }));
        limits.overall(&quality)
    };
    assert_eq!(overall(Measure::Vertical, 0.1, None), None);
    for measure in Measure::ALL {
        overall(measure, 0.1, None);
    }
    for measure in [Measure::Acceleration95, Measure::Deceleration95] {
        overall(measure, 0.6, None);
    }
    assert_eq!(overall(Measure::Jerk, 9.0, None), Some(Verdict::Pass));
    assert_eq!(
        overall(Measure::Vertical, 0.4, Some(0.3)),
        Some(Verdict::Noise)
    );
    assert_eq!(overall(Measure::Horizontal, 0.4, None), Some(Verdict::Fail));
    let has = |speed, measure| {
        Limits::gb_t_10058(speed)
            .all()
            .iter()
            .any(|it| it.measure == measure)
    };
    assert!(!has(1.0, Measure::Acceleration95) && has(2.5, Measure::Acceleration95));
}
