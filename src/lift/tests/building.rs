//! Buildings: what their lift does, and the truth beside it.

use super::drive;
use crate::lift::{
    Accelerometer, Building, Course, Ending, FaultKind, Journeys, Pickup, Ride, Stop, write_truth,
};
use crate::stats::chi_squared;
use proptest::prelude::*;
use serde_json::{Value, json};

/// A building, and the keys that it changes.
pub(super) fn building(keys: Value) -> Building {
    serde_json::from_value(keys).unwrap()
}

fn ride(keys: Value) -> (Ride, Vec<Stop>) {
    building(keys).ride(drive(1.6, 1.0, 1.5), 400.0, 7).unwrap()
}

/// Nothing shakes the sensor and its noise is 1e-10 m/s².
pub(super) fn quiet(keys: Value) -> Accelerometer {
    let Value::Object(mut all) = json!({
        "density": 1e-6, "step": 0.0, "range": 1e3, "offset": [0.0, 0.0, 0.0]
    }) else {
        unreachable!()
    };
    let Value::Object(keys) = keys else {
        unreachable!()
    };
    all.extend(keys);
    serde_json::from_value(Value::Object(all)).unwrap()
}

/// The double sum of the samples: their sum is the speed at their edges, exactly, and that of the speeds the way, by the
/// trapezoidal rule, whose error is Jh³/12 or less where the jerk changes, 2e-9 m, ten times or less a trip.
#[test]
fn trips_lead_from_floor_to_floor() {
    let floors = [0.0, 4.2, 7.4, 10.6, 13.8, 17.0];
    let (ride, stops) = ride(json!({
        "journeys": [0, 5, 4, 0, 2], "braking": 0.7, "footfalls": 0.0, "doors": 0.0
    }));
    let record = ride.simulate(&Pickup::white(1e-12), 1, 0).record;
    let (rate, mut speed, mut height) = (ride.rate(), 0.0, floors[0]);
    let mut journeys = ride.journeys().into_iter().zip(&stops);
    let mut next = journeys.next();
    for (i, a) in record.iter().enumerate() {
        height += (speed + (speed + a / rate)) / 2.0 / rate;
        speed += a / rate;
        if let Some((_, stop)) = next.filter(|it| i as f64 / rate > it.0.stop + 1.0) {
            let error = height - floors[stop.to];
            println!("floor {}: {error:e} m", stop.to);
            assert!(error.abs() < 1e-6);
            assert!((stop.height - floors[stop.to]).abs() < 1e-10);
            next = journeys.next();
        }
    }
    assert_eq!(next, None);
    assert!(ride.journeys().iter().all(|it| it.levelling.is_some()));
}

/// The greatest of |speed|, |acceleration| and |jerk| along a trip.
fn extremes(course: &Course) -> [f64; 3] {
    let steps = 4000;
    let step = course.duration() / f64::from(steps);
    let mut most = [0.0f64; 3];
    for i in 0..steps {
        let time = f64::from(i) * step;
        let a = course.acceleration_at(time);
        let jerk = (course.acceleration_at(time + step) - a) / step;
        for (most, now) in most.iter_mut().zip([course.speed_at(time), a, jerk]) {
            *most = most.max(now.abs());
        }
    }
    most
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Whatever the building and its lift, the car stops at its floors and keeps its limits: to a rounding of 1e-14 over a
    /// step of 1e-4 s or longer.
    #[test]
    fn limits_are_kept(
        spacings in prop::collection::vec(0.05f64..8.0, 1..12),
        [speed, acceleration, jerk] in [0.1f64..6.0, 0.1..2.0, 0.2..4.0],
        [braking, creep, seconds] in [0.1f64..2.0, 0.0..0.5, 0.0..5.0],
        seed in any::<u64>(),
    ) {
        let mut floors = vec![-3.0];
        floors.extend(spacings.iter().scan(-3.0, |height, spacing| {
            *height += spacing;
            Some(*height)
        }));
        let of = building(json!({
            "floors": floors, "journeys": { "random": 12 }, "braking": braking,
            "levelling": { "speed": creep, "seconds": seconds },
        }));
        let (ride, stops) = of.ride(drive(speed, acceleration, jerk), 50.0, seed).unwrap();
        prop_assert_eq!(stops.len(), 12);
        for stop in &stops {
            prop_assert!(stop.from != stop.to);
            prop_assert!((stop.height - floors[stop.to]).abs() < 1e-9);
        }
        let limits = [speed, acceleration.max(braking), jerk];
        for (_, course) in ride.started() {
            for (most, limit) in extremes(course).iter().zip(limits) {
                prop_assert!(*most <= limit * (1.0 + 1e-9), "{} {}", most, limit);
            }
        }
    }
}

/// Each fault by hand. The fourth journey ends two metres above floor 1, and the fifth begins there.
#[test]
fn faults_are_in_the_truth() {
    let faults = json!([
        { "journey": 1, "kind": { "mis_levelling": -0.03 } },
        { "journey": 2, "kind": { "overrun": 0.4 } },
        { "journey": 3, "kind": { "pit": 0.5 } },
        { "journey": 4, "kind": { "between_floors": 0.25 } },
        { "journey": 6, "kind": { "emergency_stop": 2.5 } },
    ]);
    let (ride, stops) = ride(json!({
        "floors": [0.0, 4.0, 12.0, 30.0], "journeys": [0, 1, 3, 0, 1, 2, 0, 3], "faults": faults
    }));
    let heights: Vec<f64> = stops.iter().map(|stop| stop.height).collect();
    for (height, expected) in heights.iter().zip([3.97, 30.4, -0.5, 6.0, 12.0]) {
        assert!((height - expected).abs() < 1e-9, "{height} {expected}");
    }
    assert!((5.0..7.0).contains(&heights[5]), "half way, {}", heights[5]);
    assert!((heights[6] - 30.0).abs() < 1e-9);
    assert_eq!(ride.trips()[5].ending, Ending::Emergency(2.5));
    let mut truth = Vec::new();
    write_truth(&mut truth, &ride, &stops).unwrap();
    let truth = String::from_utf8(truth).unwrap();
    let mut lines = truth.lines();
    let header =
        "start,stop,direction,distance,speed,ended,uniform,braking,levelling,from,to,height,fault";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let said: Vec<[&str; 3]> = rows.iter().map(|row| [row[9], row[10], row[12]]).collect();
    let expected = [
        ["0", "1", "mis_levelling"],
        ["1", "3", "overrun"],
        ["3", "0", "pit"],
        ["0", "1", "between_floors"],
        ["1", "2", ""],
        ["2", "0", "emergency_stop"],
        ["0", "3", ""],
    ];
    assert_eq!(said, expected);
    assert_eq!((rows[3][3], rows[4][3]), ("6.500000", "6.000000"));
    assert_eq!(
        (rows[4][5], rows[5][5], rows[5][8]),
        ("commanded", "emergency", "")
    );
}

/// Floors left and sought are each as frequent as they should be: from a floor to every other with equal probability,
/// Pearson's χ² over the twelve pairs of four floors, but for 1e-6 at either end.
#[test]
fn random_journeys_are_uniform() {
    let of = Building {
        journeys: Journeys::Random { random: 3000 },
        ..building(json!({ "floors": [0.0, 1.0, 2.0, 3.0], "dwell": [0.0, 0.0] }))
    };
    let (_, stops) = of.ride(drive(1.0, 1.0, 1.0), 1.0, 3).unwrap();
    let mut square = 0.0;
    for from in 0..4 {
        let left = stops.iter().filter(|stop| stop.from == from);
        let expected = left.clone().count() as f64 / 3.0;
        for to in (0..4).filter(|to| *to != from) {
            let observed = left.clone().filter(|stop| stop.to == to).count() as f64;
            square += (observed - expected).powi(2) / expected;
        }
    }
    let p = chi_squared::upper_tail(square, 8);
    println!("n = 3000, χ²(8) = {square:.2}, p = {p:.3}");
    assert!((1e-6..1.0 - 1e-6).contains(&p));
}

#[test]
fn refusals() {
    for (keys, message) in [
        (
            json!({ "floors": [0.0] }),
            "building.floors: must be two or more, got 1 (a lift needs somewhere to go)",
        ),
        (
            json!({ "floors": [0.0, 3.0, 3.0] }),
            "building.floors[2]: must lie above the floor before it, 3, got 3 (give heights in m from the lowest floor up)",
        ),
        (
            json!({ "journeys": [0, 6] }),
            "building.journeys[1]: must be a floor, 0 to 5, got 6 (count floors from 0, the lowest)",
        ),
        (
            json!({ "journeys": [0, 1, 1] }),
            "building.journeys[2]: must differ from the floor before it, got 1 (leave it out)",
        ),
        (
            json!({ "journeys": [2] }),
            "building.journeys: must lie in [1, 100000] journeys, got 0",
        ),
        (
            json!({ "journeys": { "random": 0 } }),
            "building.journeys.random: must lie in [1, 100000] journeys, got 0",
        ),
        (
            json!({ "dwell": [5.0, 4.0] }),
            "building.dwell[1]: must be at least the shortest, 5, got 4 (exchange them)",
        ),
        (
            json!({ "faults": [{ "journey": 11, "kind": { "pit": 1.0 } }] }),
            "building.faults[0].journey: must be a journey, 1 to 10, got 11 (the first journey is 1)",
        ),
        (
            json!({ "faults": [{ "journey": 2, "kind": { "pit": 1.0 } }, { "journey": 2, "kind": { "pit": 2.0 } }] }),
            "building.faults[1].journey: must have one fault only, got 2 (leave one)",
        ),
    ] {
        let refused = building(keys).ride(drive(1.0, 1.0, 1.0), 100.0, 1);
        assert_eq!(refused.unwrap_err().to_string(), message);
    }
    let refused = |limits, rate| {
        building(json!({}))
            .ride(limits, rate, 1)
            .unwrap_err()
            .to_string()
    };
    let message = "speed: must be positive and finite, got 0";
    assert_eq!(refused(drive(0.0, 1.0, 1.0), 100.0), message);
    let message = "jerk: must be positive and finite, got NaN";
    assert_eq!(refused(drive(1.0, 1.0, f64::NAN), 100.0), message);
    assert!(refused(drive(1.0, 1.0, 1.0), 0.0).contains("rate must lie in"));
    // 1e-9 m/s from floor to floor takes a century.
    assert!(refused(drive(1e-9, 1.0, 1.0), 100.0).contains("samples"));
    let fault = json!({ "faults": [{ "journey": 1, "kind": { "mis_levelling": 0.0 } }] });
    assert_eq!(building(fault).faults[0].kind, FaultKind::MisLevelling(0.0));
}
