//! A building whose map is made from the trips of its car.

use crate::rng::Stream;
pub use crate::study::floors::building::{Building, Traffic, variance};
use crate::track::floors::{Floors, Settings, Stop};

/// σ_s, m.
pub const LEVEL: f64 = 0.002;

/// The settings of the tests.
pub const MENDED: Settings = Settings {
    level: LEVEL,
    ..Settings::MENDED
};
pub const PRINTED: Settings = Settings {
    level: LEVEL,
    ..Settings::PRINTED
};

/// Ten floors, 3 m apart.
pub fn even() -> Vec<f64> {
    (0..10).map(|floor| 3.0 * f64::from(floor)).collect()
}

pub fn building(seed: u64, heights: &[f64]) -> Building {
    let draws = Stream::new(2014, "floors", "test").at(seed);
    Building::new(draws, heights.to_vec(), LEVEL)
}

pub fn even_building(seed: u64) -> Building {
    building(seed, &even())
}

impl Building {
    /// The map after a sweep.
    pub fn swept(&mut self, settings: Settings) -> Floors {
        let mut floors = Floors::unknown(settings).unwrap();
        for floor in 1..self.heights.len() {
            assert_eq!(self.stop(&mut floors, floor, 0.0).added, Some(floor));
        }
        floors
    }

    /// Puts the car where it was then; its draws go on.
    pub fn return_to(&mut self, then: &Self) {
        (self.at, self.car) = (then.at, then.car);
    }

    pub fn stop(&mut self, floors: &mut Floors, to: usize, offset: f64) -> Stop {
        let trip = self.go(to, offset);
        floors.step(trip.distance, trip.variance)
    }

    /// A trip to the next floor of the traffic.
    pub fn ride(&mut self, floors: &mut Floors) -> Stop {
        let to = self.next();
        self.stop(floors, to, 0.0)
    }

    /// The map after a sweep and so many trips.
    pub fn settled(&mut self, settings: Settings, trips: usize) -> Floors {
        let mut floors = self.swept(settings);
        for _ in 0..trips {
            self.ride(&mut floors);
        }
        floors
    }
}

/// Squared errors of the heights above the lowest, and their normalised sum, each per floor.
pub fn map_error(floors: &Floors, building: &Building) -> (f64, f64) {
    let map = floors.map();
    let n = map.heights.len() - 1;
    let true_height = |floor: usize| building.heights[floor] - building.heights[0];
    let error: Vec<f64> = (1..=n).map(|i| map.heights[i] - true_height(i)).collect();
    let place = |i: usize, j: usize| (i + 1) * (n + 1) + j + 1;
    let covariance = nalgebra::DMatrix::from_fn(n, n, |i, j| map.covariance[place(i, j)]);
    let error = nalgebra::DVector::from_vec(error);
    let solved = covariance.cholesky().unwrap().solve(&error);
    let each = n as f64;
    (error.norm_squared() / each, error.dot(&solved) / each)
}
