//! The motion of a trip.

use super::{LIFT, drive, trip};
use crate::lift::{Braking, Course, Drive, Ending, Trip};
use crate::rng::Stream;
use crate::signal::Phase;
use rand::RngExt;

/// Trips of every shape: with and without full speed, full acceleration, uniform motion, jams; and drawn
/// at random over several decades.
fn courses() -> Vec<(Trip, Course)> {
    let limits = [
        drive(1.0, 0.6, 0.8),
        drive(4.0, 1.0, 2.0),
        drive(0.3, 1.0, 0.5),
        drive(2.0, 2.0, 2.0),
    ];
    let distances = [-0.01, 0.5, -2.0, 4.0, 12.3, -75.0];
    let mut trips = Vec::new();
    for limits in limits {
        for distance in distances {
            trips.push(trip(distance, limits, Ending::Commanded));
        }
        for within in [0.02, 0.1, 1.0] {
            let after = limits.start(400.0).duration + 3.0;
            trips.push(trip(400.0, limits, Ending::Jam { after, within }));
            trips.push(trip(-400.0, limits, Ending::Jam { after, within }));
        }
    }
    let mut generator = Stream::new(2014, "ride", "trips").at(0);
    let mut decades = || 10f64.powf(generator.random_range(-2.0..2.0));
    trips.extend((0..200).map(|_| {
        let limits = drive(decades(), decades(), decades());
        trip(decades(), limits, Ending::Commanded)
    }));
    trips.extend((0..200).map(|_| {
        let limits = drive(decades(), decades(), decades());
        let braking = Braking {
            acceleration: decades(),
            jerk: decades(),
            creep: 0.1 * decades(),
            seconds: decades(),
        };
        trip(-decades(), limits, Ending::Braked(braking))
    }));
    trips.extend((0..50).map(|_| {
        let limits = drive(decades(), decades(), decades());
        trip(decades(), limits, Ending::Emergency(decades()))
    }));
    let course = |trip: Trip| (trip, trip.course().unwrap());
    trips.into_iter().map(course).collect()
}

/// The limits of a trip and of its braking, the wider of each.
fn limits(trip: &Trip) -> Drive {
    let (acceleration, jerk) = match trip.ending {
        Ending::Braked(braking) => (braking.acceleration, braking.jerk),
        Ending::Emergency(deceleration) => (deceleration, 10.0 * deceleration),
        Ending::Commanded | Ending::Jam { .. } => (0.0, 0.0),
    };
    Drive {
        speed: trip.drive.speed,
        acceleration: trip.drive.acceleration.max(acceleration),
        jerk: trip.drive.jerk.max(jerk),
    }
}

/// The distance is the one asked for, and the limits are kept: 1e-12 of the size is a thousand roundings.
#[test]
fn commanded_trips_arrive_within_their_limits() {
    let (mut uniform, mut short) = (0, 0);
    for (trip, course) in courses() {
        if matches!(trip.ending, Ending::Jam { .. }) {
            continue;
        }
        let Drive {
            speed,
            acceleration,
            jerk,
        } = limits(&trip);
        let duration = course.duration();
        let error = course.distance() - trip.distance;
        if matches!(trip.ending, Ending::Emergency(_)) {
            assert!(course.distance() > 0.0, "{trip:?}");
        } else {
            assert!(
                error.abs() < 1e-12 * trip.distance.abs(),
                "{trip:?}: {error:e}"
            );
        }
        assert_eq!(course.speed_at(duration), 0.0);
        let (steps, slack) = (2000, 1.0 + 1e-12);
        let step = duration / f64::from(steps);
        for i in 0..steps {
            let time = f64::from(i) * step;
            let a = course.acceleration_at(time);
            let next = course.acceleration_at(time + step);
            assert!(course.speed_at(time).abs() <= speed * slack, "{trip:?}");
            assert!(a.abs() <= acceleration * slack, "{trip:?}");
            // The rounding error of a difference is that of the two accelerations.
            let rounding = 1e-14 * acceleration;
            assert!(
                (next - a).abs() <= jerk * step * slack + rounding,
                "{trip:?}"
            );
        }
        if course.phases().any(|(phase, _)| phase == Phase::Inertial) {
            uniform += 1
        } else {
            short += 1
        }
    }
    println!("{uniform} trips with uniform motion, {short} without");
    assert!(uniform > 50 && short > 50);
}

/// No drive within the same limits is faster: at every moment of the trip jerk, acceleration or speed is at
/// its limit.
#[test]
fn every_moment_is_at_a_limit() {
    for (trip, course) in courses() {
        if matches!(trip.ending, Ending::Braked(_) | Ending::Emergency(_)) {
            continue;
        }
        let (duration, drive) = (course.duration(), trip.drive);
        let step = 1e-6 * duration;
        for i in 0..100 {
            let time = duration * (f64::from(i) + 0.37) / 100.0;
            if course.is_jammed() && time + step > course.uniform_motion().1 {
                break;
            }
            let a = course.acceleration_at(time);
            let jerk = (course.acceleration_at(time + step) - a) / step;
            let is_at = |value: f64, limit: f64| (value.abs() / limit - 1.0).abs() < 1e-6;
            let is_limited = is_at(course.speed_at(time), drive.speed)
                || is_at(a, drive.acceleration)
                || is_at(jerk, drive.jerk);
            // A difference over 1e-6 s is wrong where the jerk changes.
            let turns = course
                .phases()
                .next()
                .is_some_and(|(_, t)| (time - t).abs() <= step);
            assert!(is_limited || turns, "{trip:?} at {time}: {a} {jerk}");
        }
    }
}

/// Simpson's rule, phase by phase: exact for parabolas, off by h⁴ of the jam's half-sine, and by no more
/// than Jh²/2 or Jh³/2 in a step in which the jerk J begins or ends, four of them a phase at most.
#[test]
fn speed_and_position_are_the_integrals_of_acceleration() {
    for (trip, course) in courses() {
        let (mut time, mut speed, mut position) = (0.0, 0.0, 0.0);
        let (mut speed_bound, mut position_bound) = (1e-11, 1e-11 * trip.distance.abs());
        speed_bound *= course.top_speed();
        for (_, duration) in course.phases() {
            let steps = 5000;
            let (from, h) = (time, duration / f64::from(steps));
            speed_bound += 2.0 * limits(&trip).jerk * h.powi(2);
            position_bound += 2.0 * limits(&trip).jerk * h.powi(3);
            for i in 0..steps {
                time = from + f64::from(i) * h;
                let simpson = |f: &dyn Fn(f64) -> f64| {
                    (f(time) + 4.0 * f(time + h / 2.0) + f(time + h)) * h / 6.0
                };
                speed += simpson(&|t| course.acceleration_at(t));
                position += simpson(&|t| course.speed_at(t));
                time += h;
                let error = (speed - course.speed_at(time)).abs();
                assert!(error < speed_bound, "{trip:?} at {time}: {error:e}");
                let error = (position - course.position_at(time)).abs();
                assert!(error < position_bound, "{trip:?} at {time}: {error:e}");
            }
        }
        assert!((time - course.duration()).abs() < 1e-11 * time);
    }
}

/// The jam: half the top speed at half its time, a distance of v w/2, and the peak given in the module docs.
#[test]
fn jams_stop_within_their_time() {
    let ending = |after| Ending::Jam { after, within: 0.1 };
    let course = trip(-12.0, LIFT, ending(6.0)).course().unwrap();
    assert!((course.duration() - 6.1).abs() < 1e-12);
    assert!(course.is_jammed());
    assert!((course.uniform_motion().1 - 6.0).abs() < 1e-12);
    assert!((course.speed_at(6.05) + 0.5).abs() < 1e-12);
    assert!((course.acceleration_at(6.05) - 5.0 * std::f64::consts::PI).abs() < 1e-9);
    let start = 1.0 / 0.6 + 0.6 / 0.8;
    let way = start / 2.0 + (6.0 - start) + 0.05;
    assert!((course.distance() + way).abs() < 1e-12);
    assert_eq!(course.phase_at(6.05), Phase::Braking);
    assert_eq!(course.phase_at(6.101), Phase::Rest);
}

/// Against a hand-made trip: 1 m/s, up at 1 m/s² and 1 m/s³ in 2 s and 1 m, down to 0.2 m/s at 0.5 m/s² and 1 m/s³ in
/// 0.8/0.5 + 0.5 = 2.1 s, a creep of 3 s, and a stop in 2√0.2 s.
#[test]
fn braking_of_its_own_and_levelling() {
    let braking = Braking {
        acceleration: 0.5,
        jerk: 1.0,
        creep: 0.2,
        seconds: 3.0,
    };
    let limits = drive(1.0, 1.0, 1.0);
    let course = trip(8.0, limits, Ending::Braked(braking)).course().unwrap();
    let last = 2.0 * 0.2f64.sqrt();
    let uniform = 8.0 - 1.0 - 2.1 * 0.6 - 0.6 - last * 0.1;
    let phases: Vec<_> = course.phases().collect();
    let expected = [
        (Phase::Accelerating, 2.0),
        (Phase::Inertial, uniform),
        (Phase::Braking, 2.1),
        (Phase::Levelling, 3.0 + last),
    ];
    for (phase, expected) in phases.iter().zip(expected) {
        assert_eq!(phase.0, expected.0);
        assert!((phase.1 - expected.1).abs() < 1e-12, "{phase:?}");
    }
    assert_eq!(course.levelling(), Some(2.0 + phases[1].1 + 2.1));
    let creeping = course.levelling().unwrap() + 1.0;
    assert!((course.speed_at(creeping) - 0.2).abs() < 1e-12);
    assert_eq!(course.phase_at(creeping), Phase::Levelling);
    // A trip of half a metre has no room for 0.6 m of creep.
    let short = trip(0.5, limits, Ending::Braked(braking)).course().unwrap();
    assert_eq!(short.levelling(), None);
    assert!((short.distance() - 0.5).abs() < 1e-12);
}

/// Half of the uniform motion, then v²/2a + v·0.05 as from the closed form of a start.
#[test]
fn an_emergency_brake_acts_at_once() {
    let limits = drive(2.0, 1.0, 1.0);
    let course = trip(20.0, limits, Ending::Emergency(4.0)).course().unwrap();
    let (start, uniform) = (3.0, 20.0 / 2.0 - 3.0);
    let (from, braking) = course.uniform_motion();
    assert_eq!((from, braking), (start, start + uniform / 2.0));
    assert!((course.duration() - braking - 0.6).abs() < 1e-12);
    let way = 3.0 + uniform + 2.0 * 0.6 / 2.0;
    assert!(
        (course.distance() - way).abs() < 1e-12,
        "{}",
        course.distance()
    );
    assert!((course.acceleration_at(braking + 0.3) + 4.0).abs() < 1e-12);
}
