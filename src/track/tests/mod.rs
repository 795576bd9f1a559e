//! The filter against closed forms, brute force and simulated trips whose truth is known.

mod alignment;
mod bound;
mod carried;
mod detector;
mod height;
mod landing;
mod trips;
mod watch;

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

const RATE: f64 = 200.0;

/// An MPU-6050 at 200 Hz.
fn sensor() -> Pickup {
    Pickup::white((Densities::default().acceleration * RATE).sqrt())
}

/// A trip between rests of 5 s as it reads it, or without noise.
fn simulated(distance: f64, trial: u64, is_noisy: bool) -> (Vec<Sample>, Journey) {
    let quiet = Pickup::white(1e-12);
    read(distance, trial, if is_noisy { sensor() } else { quiet })
}

/// The same by any sensor with a bias of 0.3 m/s².
fn read(distance: f64, trial: u64, sensor: Pickup) -> (Vec<Sample>, Journey) {
    let trip = Trip {
        distance,
        drive: typical(),
        ending: Ending::Commanded,
    };
    let ride = Ride::new(RATE, vec![5.0, 5.0], vec![trip]).unwrap();
    let pickup = Pickup {
        bias: 0.3,
        ..sensor
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
