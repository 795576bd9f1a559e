//! The filter against closed forms, brute force and simulated trips whose truth is known.

mod bound;
mod detector;
mod trips;

use crate::lift::{Drive, Ending, Journey, Pickup, Ride, Trip};
use crate::recording::Sample;
use crate::track::{Densities, Phases};

/// 1.6 m/s, 1.1 m/s², 2 m/s³.
fn typical() -> Drive {
    Drive {
        speed: 1.6,
        acceleration: 1.1,
        jerk: 2.0,
    }
}

/// A trip between rests of 5 s at 200 Hz, as an MPU-6050 with a bias of 0.3 m/s² reads it, or without noise.
fn simulated(distance: f64, trial: u64, is_noisy: bool) -> (Vec<Sample>, Journey) {
    const RATE: f64 = 200.0;
    let trip = Trip {
        distance,
        drive: typical(),
        ending: Ending::Commanded,
    };
    let ride = Ride::new(RATE, vec![5.0, 5.0], vec![trip]).unwrap();
    let deviation = (Densities::default().acceleration * RATE).sqrt();
    let pickup = Pickup {
        bias: 0.3,
        ..Pickup::white(if is_noisy { deviation } else { 1e-12 })
    };
    let record = ride.simulate(&pickup, 2014, trial).record;
    let samples = (0..).zip(record).map(|(place, acceleration)| Sample {
        time: f64::from(place) / RATE,
        acceleration,
    });
    (samples.collect(), ride.journeys()[0])
}

/// Its phases, each known to a sample.
fn phases(journey: &Journey) -> Phases {
    let nothing = journey.stop..journey.stop;
    Phases {
        before: journey.start - 2.0..journey.start,
        uniform: [journey.uniform..journey.braking, nothing],
        after: journey.stop..journey.stop + 1.0,
    }
}
