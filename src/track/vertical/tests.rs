//! The published filter on trips that are known, and its law.

use super::*;
use crate::lift::{Drive, Ending, Ride, Trip};

const RATE: f64 = 200.0;

const DRIVE: Drive = Drive {
    speed: 1.6,
    acceleration: 1.1,
    jerk: 2.0,
};

/// A trip from 5 s on, without noise.
fn record(distance: f64) -> (Vec<Sample>, [f64; 4]) {
    let trip = Trip {
        distance,
        drive: DRIVE,
        ending: Ending::Commanded,
    };
    let ride = Ride::new(RATE, vec![5.0, 5.0], vec![trip]).unwrap();
    let at = |(place, acceleration): (usize, f64)| Sample {
        time: place as f64 / RATE,
        acceleration: 9.81 + acceleration,
    };
    let journey = ride.journeys()[0];
    let phases = [
        journey.start,
        journey.uniform,
        journey.braking,
        journey.stop,
    ];
    let samples = ride.acceleration().into_iter().enumerate().map(at);
    (samples.collect(), phases)
}

/// Q is what white noise of the jerk's rate does in T seconds: its integral, by a thousand steps.
#[test]
fn noise_of_a_step_is_that_of_many() {
    let t = 0.3;
    let rules = Rules::printed(0.04, 0.1);
    let covariance = |steps: usize| {
        let mut filter = VerticalFilter::new(rules, 0.0);
        filter.estimate.covariance = [0.0; 9];
        (0..steps).for_each(|_| filter.predict(t / steps as f64));
        filter.estimate.covariance
    };
    let q = rules.jerk_rate;
    for (one, many) in covariance(1).into_iter().zip(covariance(1000)) {
        assert!((one - many).abs() < 1e-12 * q, "{one} {many}");
    }
    let jerk = covariance(1)[8];
    assert!((jerk - q * t).abs() < 1e-12 * q);
}

/// Without noise every phase is told, as late as the window is long.
#[test]
fn a_trip_without_noise() {
    for distance in [12.0, -12.0] {
        let (samples, phases) = record(distance);
        let moves = Moves::of(&samples, Rules::printed(0.01, 0.02));
        let [trip] = &moves.trips[..] else {
            panic!("{:?}", moves.trips);
        };
        assert!((trip.distance - distance).abs() < 0.03, "{trip:?}");
        let order = [Motion::Acceleration, Motion::Inertial, Motion::Braking];
        let told: Vec<Motion> = trip.parts.iter().map(|part| part.0).collect();
        assert_eq!(told, order);
        let times = trip.parts.iter().map(|part| part.1).chain([trip.stop]);
        for (told, truth) in times.zip(phases) {
            assert!((told - truth).abs() < 0.35, "{told} {truth}");
        }
    }
}

/// What the sensor reads at rest is learnt anew: a level that drifts between trips does no harm.
#[test]
fn the_level_is_learnt_at_every_rest() {
    let (once, _) = record(9.0);
    let seconds = once.last().unwrap().time + 1.0 / RATE;
    let trips = (0..5).flat_map(|trip| {
        let by = f64::from(trip);
        once.iter().map(move |it| Sample {
            time: it.time + by * seconds,
            acceleration: it.acceleration + 0.015 * by,
        })
    });
    let samples: Vec<Sample> = trips.collect();
    let moves = Moves::of(&samples, Rules::printed(0.01, 0.05));
    assert_eq!(moves.trips.len(), 5);
    for trip in moves.trips {
        assert!((trip.distance - 9.0).abs() < 0.05, "{trip:?}");
    }
}

/// A speed that ends above its threshold is uniform motion for ever, unless that is mended.
#[test]
fn a_slow_end() {
    let (mut samples, phases) = record(12.0);
    // The braking falls short by 0.24 m/s.
    for sample in &mut samples {
        if sample.time > phases[2] {
            sample.acceleration = 9.81 + 0.85 * (sample.acceleration - 9.81);
        }
    }
    let rules = Rules::printed(0.01, 0.05);
    assert_eq!(Moves::of(&samples, rules).trips.len(), 0);
    assert_eq!(Moves::of(&samples, rules.mended()).trips.len(), 1);
}

#[test]
fn nothing_and_a_hole() {
    let rules = Rules::printed(0.01, 0.05);
    assert!(Moves::of(&[], rules).motions.is_empty());
    let (mut samples, phases) = record(12.0);
    samples.retain(|it| !(phases[1]..phases[2]).contains(&it.time));
    let moves = Moves::of(&samples, rules);
    assert_eq!(moves.motions.len(), samples.len());
}
