//! Helpers shared by the tests of this module.

use crate::lift::{Pickup, Ride};
use crate::signal::Sensor;

/// White noise of unit variance, coloured by a sensor with these coefficients.
pub(super) fn record(ar: &[f64], samples: usize, seed: u64, index: u64) -> Vec<f64> {
    let pickup = Pickup {
        sensor: Sensor::from_ar(ar.to_vec()).unwrap(),
        ..Pickup::white(1.0)
    };
    let ride = Ride::still(1.0, samples as f64).unwrap();
    ride.simulate(&pickup, seed, index).record
}
