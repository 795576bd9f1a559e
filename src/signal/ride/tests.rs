//! Rides against closed forms, against integration by brute force, and their noise against theory.

use super::*;
use crate::binomial;
use crate::rng::Stream;
use crate::signal::{Digitiser, Disturbance, During, Impulses, Law, Noise, Sensor};
use rand::RngExt;

const LIFT: Drive = Drive {
    speed: 1.0,
    acceleration: 0.6,
    jerk: 0.8,
};

fn trip(distance: f64, drive: Drive, ending: Ending) -> Trip {
    Trip {
        distance,
        drive,
        ending,
    }
}

fn drive(speed: f64, acceleration: f64, jerk: f64) -> Drive {
    Drive {
        speed,
        acceleration,
        jerk,
    }
}

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
    let course = |trip: Trip| (trip, trip.course().unwrap());
    trips.into_iter().map(course).collect()
}

/// The way is what was asked for, and the limits are kept: 1e-12 of the size is a thousand roundings.
#[test]
fn commanded_trips_arrive_within_their_limits() {
    let (mut uniform, mut short) = (0, 0);
    for (trip, course) in courses() {
        if trip.ending != Ending::Commanded {
            continue;
        }
        let Drive {
            speed,
            acceleration,
            jerk,
        } = trip.drive;
        let duration = course.duration();
        let error = course.distance() - trip.distance;
        assert!(
            error.abs() < 1e-12 * trip.distance.abs(),
            "{trip:?}: {error:e}"
        );
        assert_eq!(course.speed_at(duration), 0.0);
        let (steps, slack) = (2000, 1.0 + 1e-12);
        let step = duration / f64::from(steps);
        for i in 0..steps {
            let time = f64::from(i) * step;
            let a = course.acceleration_at(time);
            let next = course.acceleration_at(time + step);
            assert!(course.speed_at(time).abs() <= speed * slack, "{trip:?}");
            assert!(a.abs() <= acceleration * slack, "{trip:?}");
            // The difference of two accelerations has their rounding, not its own.
            let rounding = 1e-14 * acceleration;
            assert!(
                (next - a).abs() <= jerk * step * slack + rounding,
                "{trip:?}"
            );
        }
        match course.phases().any(|(phase, _)| phase == Phase::Inertial) {
            true => uniform += 1,
            false => short += 1,
        }
    }
    println!("{uniform} trips with uniform motion, {short} without");
    assert!(uniform > 50 && short > 50);
}

/// A drive that is faster at no expense of its limits does not exist: the trip takes what one takes that
/// spends all its time at a limit of jerk, acceleration or speed.
#[test]
fn every_moment_is_at_a_limit() {
    for (trip, course) in courses() {
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
            // Between two jerks of opposite sign a step of 1e-6 sees neither.
            let turns = course
                .phases()
                .next()
                .is_some_and(|(_, t)| (time - t).abs() <= step);
            assert!(is_limited || turns, "{trip:?} at {time}: {a} {jerk}");
        }
    }
}

/// Simpson's rule, phase by phase: exact for parabolas, off by h⁴ of the jam's half-sine, and by no more
/// than Jh²/2 or Jh³/2 in a step in which the jerk J begins or ends, four of them a trip.
#[test]
fn speed_and_position_are_the_integrals_of_acceleration() {
    for (trip, course) in courses() {
        let (mut time, mut speed, mut position) = (0.0, 0.0, 0.0);
        let (mut speed_bound, mut position_bound) = (1e-11, 1e-11 * trip.distance.abs());
        speed_bound *= course.top_speed();
        for (_, duration) in course.phases() {
            let steps = 5000;
            let (from, h) = (time, duration / f64::from(steps));
            speed_bound += trip.drive.jerk * h.powi(2);
            position_bound += trip.drive.jerk * h.powi(3);
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

/// The jam: half the top speed at half its time, v w/2 of way, and the peak that the head of the file says.
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

fn two_trips() -> Ride {
    let up = trip(12.0, LIFT, Ending::Commanded);
    let jam = Ending::Jam {
        after: 7.3,
        within: 0.05,
    };
    let down = trip(-9.0, LIFT, jam);
    Ride::new(100.0, vec![5.003, 4.0, 3.0], vec![up, down]).unwrap()
}

#[test]
fn truth_tells_the_ride() {
    let ride = two_trips();
    let truth = ride.truth();
    let named: Vec<_> = truth
        .iter()
        .map(|s| (s.phase.name(), s.direction))
        .collect();
    let trip = |direction| {
        let phases = ["acceleration", "inertial", "braking"];
        phases.map(|phase| (phase, direction))
    };
    let expected = [
        &[("rest", 0)],
        &trip(1)[..],
        &[("rest", 0)],
        &trip(-1),
        &[("rest", 0)],
    ];
    assert_eq!(named, expected.concat());
    for pair in truth.windows(2) {
        assert_eq!(pair[0].to, pair[1].from);
    }
    let journeys = ride.journeys();
    assert_eq!(journeys[0].start, 5.003);
    assert!((journeys[0].distance - 12.0).abs() < 1e-12);
    assert_eq!((journeys[0].direction, journeys[0].jam()), (1, None));
    assert!((journeys[1].jam().unwrap() - journeys[1].start - 7.3).abs() < 1e-12);
    for (journey, trip) in journeys.iter().zip(truth.chunks(4)) {
        let ends = [journey.start, journey.uniform, journey.braking];
        let expected = [trip[0].to, trip[1].to, trip[2].to];
        for (end, expected) in ends.into_iter().zip(expected) {
            assert!((end - expected).abs() < 1e-12);
        }
    }
    assert!((journeys[1].stop - journeys[1].start - 7.35).abs() < 1e-12);
    assert!((ride.duration() - truth[truth.len() - 1].to).abs() < 1e-12);
}

/// Without noise to speak of, the samples add up to the speed at their edges at every moment, jams shorter
/// than a sample included, and twice to the way up to what rectangles miss.
#[test]
fn samples_add_up_to_the_motion() {
    let ride = two_trips();
    let simulated = ride.simulate(&Pickup::white(1e-12), 1, 0);
    let h = 1.0 / ride.rate();
    let (mut speed, mut way) = (0.0, 0.0);
    for (i, a) in simulated.record.iter().enumerate() {
        let edge = (i as f64 + 0.5) * h;
        let expected: f64 = ride
            .started()
            .map(|(start, course)| course.speed_at(edge - start))
            .sum();
        speed += a * h;
        assert!((speed - expected).abs() < 1e-9, "{i}: {speed} {expected}");
        way += speed * h;
    }
    let net: f64 = ride.journeys().iter().map(|journey| journey.distance).sum();
    println!("way {way}, of the journeys {net}");
    assert!((way - net).abs() < 0.01);
}

/// Σ x² of n independent normals lies within n ± 5.5 √(2n) but for 1e-7 (at n of 1e6 the law is normal
/// to that); white noise's correlations within 5.5/√n. Six checks: 6e-7.
#[test]
fn white_noise_has_its_deviation() {
    let n = 1_000_000;
    let pickup = Pickup {
        bias: 9.81,
        ..Pickup::white(0.012)
    };
    let record = Ride::still(100.0, 10_000.0)
        .unwrap()
        .simulate(&pickup, 2014, 0)
        .record;
    assert_eq!(record.len(), n);
    let x: Vec<f64> = record.iter().map(|r| (r - 9.81) / 0.012).collect();
    for lag in 0..5 {
        let sum: f64 = x[lag..].iter().zip(&x).map(|(a, b)| a * b).sum();
        let (expected, variance) = if lag == 0 {
            (n as f64, 2.0)
        } else {
            (0.0, 1.0)
        };
        let z = (sum - expected) / (variance * n as f64).sqrt();
        println!("n = {n}, lag {lag}: z = {z:.2}");
        assert!(z.abs() < 5.5);
    }
    let z = x.iter().sum::<f64>() / (n as f64).sqrt();
    assert!(z.abs() < 5.5, "mean: z = {z}");
}

/// The first sample of coloured records over many of them: deviation and the correlation with the second
/// as those of the ADXL105 in closed form, for a law with an exact start and for one with a burn-in. Laplace's
/// kurtosis of 6 lets the mean square deviate by √(5/n) at most; 6 deviations, four checks: 1e-8.
#[test]
fn records_start_stationary() {
    let (phi_1, phi_2) = (-1.5365f64, -0.75056f64);
    let variance = (1.0 - phi_2) / ((1.0 + phi_2) * ((1.0 - phi_2).powi(2) - phi_1 * phi_1));
    let covariance = variance * phi_1 / (1.0 - phi_2);
    let n = 20_000;
    let ride = Ride::still(100.0, 0.02).unwrap();
    for law in [Law::Normal, Law::Laplace] {
        let pickup = Pickup {
            sensor: Sensor::adxl105(),
            noise: Noise::new(law).unwrap(),
            ..Pickup::white(1.0)
        };
        let (mut square, mut product) = (0.0, 0.0);
        for index in 0..n {
            let record = ride.simulate(&pickup, 2014, index).record;
            square += record[0] * record[0];
            product += record[0] * record[1];
        }
        let bound = 6.0 * variance * (5.0 / n as f64).sqrt();
        let (square, product) = (square / n as f64, product / n as f64);
        println!("{law:?}: {square:.3} for {variance:.3}, {product:.3} for {covariance:.3}");
        assert!((square - variance).abs() < bound);
        assert!((product - covariance).abs() < bound);
    }
}

/// In uniform motion at full speed the mean square is 1 + v² in σ², in n samples to 5.5 √(2/n) of it; at
/// rest 1. False failures: 1e-7.
#[test]
fn vibration_acts_in_motion() {
    let trip = trip(2000.0, LIFT, Ending::Commanded);
    let ride = Ride::new(100.0, vec![1000.0, 1000.0], vec![trip]).unwrap();
    let pickup = Pickup {
        vibration: 2.0,
        ..Pickup::white(0.5)
    };
    let simulated = ride.simulate(&pickup, 2014, 0);
    for stretch in &simulated.truth {
        let expected = match stretch.phase {
            Phase::Rest => 1.0,
            Phase::Inertial => 5.0,
            _ => continue,
        };
        let range = (stretch.from * 100.0) as usize + 1..(stretch.to * 100.0) as usize;
        let n = range.len() as f64;
        let energy: f64 = simulated.record[range].iter().map(|r| r * r * 4.0).sum();
        let z = (energy / n / expected - 1.0) / (2.0 / n).sqrt();
        println!("{:?}: n = {n}, z = {z:.2}", stretch.phase);
        assert!(z.abs() < 5.5);
    }
}

/// Draws are shared by rides that differ in strength alone: impulses and their places are the difference.
#[test]
fn impulses_act_in_uniform_motion_alone() {
    let trip = trip(200.0, LIFT, Ending::Commanded);
    let ride = Ride::new(50.0, vec![3.0, 3.0], vec![trip]).unwrap();
    let quiet = Pickup::white(1.0);
    let knocked = Pickup {
        impulses: Impulses::new(0.3, 8.0, During::Inertial).unwrap(),
        ..quiet.clone()
    };
    let record = |pickup: &Pickup| ride.simulate(pickup, 2014, 0).record;
    let inertial = ride.truth()[2];
    let (mut hits, mut places, mut sum) = (0, 0, 0.0f64);
    for (i, (a, b)) in record(&knocked).iter().zip(record(&quiet)).enumerate() {
        let time = i as f64 / 50.0;
        let impulse = (a - b).round();
        sum += impulse;
        assert!(sum.abs() == 0.0 || sum.abs() == 8.0);
        match (inertial.from..inertial.to).contains(&time) {
            true => places += 1,
            false => assert_eq!(impulse, 0.0),
        }
        hits += u64::from(impulse != 0.0);
    }
    let tail = binomial::lower_tail(hits, places, 0.3).min(binomial::upper_tail(hits, places, 0.3));
    println!(
        "{hits} impulses in {places} samples at ν = 0.3, p = {:.3}",
        2.0 * tail
    );
    assert!(tail > 5e-7);
}

#[test]
fn digitised_records_are_whole_steps() {
    let quantum = 0.1;
    let pickup = Pickup {
        digitiser: Digitiser::new(Some(quantum / 0.02), Some(2.0 * 9.81 / 0.02)).unwrap(),
        bias: 9.81,
        ..Pickup::white(0.02)
    };
    let record = two_trips().simulate(&pickup, 2014, 0).record;
    let level = Pickup {
        cosine: 0.0,
        ..pickup.clone()
    };
    let level = two_trips().simulate(&level, 2014, 0).record;
    assert!(level.iter().all(|r| (r - 9.81).abs() < 0.3), "no motion");
    for r in &record {
        let steps = r / quantum;
        assert!((steps - steps.round()).abs() < 1e-9, "{r}");
        assert!(r.abs() <= 2.0 * 9.81);
    }
    let distinct: std::collections::BTreeSet<u64> = record.iter().map(|r| r.to_bits()).collect();
    assert!(distinct.len() < 100, "equal steps are equal numbers");
    // The jam's 31 m/s² meet the limit.
    assert!(record.iter().any(|r| (r - 196.0 * quantum).abs() < 1e-9));
}

#[test]
fn disturbances_begin_when_they_are_told() {
    let ride = Ride::still(100.0, 10.0).unwrap();
    let quiet = Pickup::white(0.5);
    let drifting = Pickup {
        disturbance: Disturbance::new(0.0, 3.0, 0.0, 0.0).unwrap(),
        disturbed_from: 4.0,
        ..quiet.clone()
    };
    let (quiet, drifting) = (ride.simulate(&quiet, 1, 0), ride.simulate(&drifting, 1, 0));
    let pairs = quiet.record.iter().zip(&drifting.record);
    for (i, (a, b)) in pairs.enumerate() {
        let swell = if i < 400 { 1.0 } else { 3.0 };
        assert!((a * swell - b).abs() < 1e-12, "{i}");
    }
}

/// A change of these values changes results: say so in the CHANGELOG.
#[test]
fn golden_draws() {
    let pickup = Pickup {
        vibration: 2.5,
        impulses: Impulses::new(0.1, 4.0, During::Motion).unwrap(),
        disturbance: Disturbance::new(0.0, 1.0, 0.01, 5.0).unwrap(),
        ..Pickup::white(0.012)
    };
    let record = two_trips().simulate(&pickup, 2014, 3).record;
    let sum: f64 = record.iter().sum();
    assert_eq!(
        (record.len(), record[0], record[700], sum),
        (
            3377,
            -0.00448632563074493,
            0.3327867897469897,
            1.3182104836011537
        )
    );
}

#[test]
fn refusals() {
    let of = |trip: Trip| trip.course().unwrap_err().to_string();
    let commanded = |distance, drive| of(trip(distance, drive, Ending::Commanded));
    assert!(commanded(0.0, LIFT).contains("got 0"));
    assert!(commanded(f64::NAN, LIFT).contains("NaN"));
    assert!(commanded(1.0, drive(1.0, -1.0, 1.0)).contains("acceleration must be positive"));
    assert!(commanded(1.0, drive(1.0, 1.0, f64::INFINITY)).contains("jerk"));
    let jam = |distance, after, within| of(trip(distance, LIFT, Ending::Jam { after, within }));
    assert!(jam(1.0, 1.0, 0.1).contains("never moves uniformly"));
    assert!(jam(12.0, 1.0, 0.1).contains("2.417 to 12.000 s"));
    assert!(jam(12.0, 5.0, 0.0).contains("jam.within"));
    let up = trip(12.0, LIFT, Ending::Commanded);
    let new = |rate, rests: &[f64], trips: &[Trip]| {
        Ride::new(rate, rests.to_vec(), trips.to_vec()).unwrap_err()
    };
    assert!(matches!(new(0.0, &[1.0], &[]), RideError::Rate(0.0)));
    assert!(
        new(1.0, &[1.0], &[up])
            .to_string()
            .contains("1 trips need 2, got 1")
    );
    let rest = new(1.0, &[1.0, -1.0], &[up]);
    assert!(matches!(rest, RideError::Rest { number: 2, .. }));
    assert!(matches!(new(1.0, &[0.1], &[]), RideError::Length { .. }));
    assert!(matches!(new(1e6, &[1e6], &[]), RideError::Length { .. }));
    let nowhere = trip(0.0, LIFT, Ending::Commanded);
    let refused = new(1.0, &[1.0, 1.0, 1.0], &[up, nowhere]);
    assert!(matches!(refused, RideError::Trip { number: 2, .. }));
    let pickup = |change: fn(&mut Pickup)| {
        let mut pickup = Pickup::white(1.0);
        change(&mut pickup);
        pickup.checked().unwrap_err()
    };
    assert_eq!(pickup(|p| p.sigma = 0.0), PickupError::Sigma(0.0));
    assert!(matches!(
        pickup(|p| p.bias = f64::NAN),
        PickupError::Bias(_)
    ));
    assert_eq!(pickup(|p| p.cosine = 1.1), PickupError::Cosine(1.1));
    assert_eq!(pickup(|p| p.vibration = -1.0), PickupError::Vibration(-1.0));
    assert_eq!(
        pickup(|p| p.disturbed_from = -1.0),
        PickupError::DisturbedFrom(-1.0)
    );
}
