//! A car in a building, and its trips as the trip filter would give them: true distance plus an error of the
//! bound's variance, (2/3) S_a [(T_c/2 + T_a)³ − (T_c/2)³] for a trip that starts for T_a, cruises for T_c and
//! brakes as it started. No record is simulated.

use crate::rng::{Generator, Stream};
use crate::track::floors::{Floors, Settings, Stop};
use rand::Rng;

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

/// The variance of the distance of a trip at 1.6 m/s, 1.1 m/s², 2 m/s³ with an MPU-6050, m².
pub fn variance(distance: f64) -> f64 {
    let (speed, acceleration, jerk, density) = (1.6_f64, 1.1, 2.0, 7.69e-6);
    // v (v/A + A/J) = D where the trip is too short for the speed; below a distance of 2 A³/J² the start has no
    // plateau, and this is a little too small.
    let knee = acceleration * acceleration / jerk;
    let short = 2.0 * acceleration * distance.abs()
        / (knee + (knee * knee + 4.0 * acceleration * distance.abs()).sqrt());
    let speed = speed.min(short);
    let start = speed / acceleration + acceleration / jerk;
    let cruise = (distance.abs() / speed.max(1e-9) - start).max(0.0);
    2.0 / 3.0 * density * ((cruise / 2.0 + start).powi(3) - (cruise / 2.0).powi(3))
}

/// Where the next trip goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Traffic {
    /// To any other floor.
    Uniform,
    /// From the lowest floor to any other, from elsewhere to the lowest three times out of four.
    Lobby,
}

#[derive(Clone, Debug)]
pub struct World {
    draws: Generator,
    pub heights: Vec<f64>,
    pub at: usize,
    car: f64,
    /// The true deviation of trips over the claimed one.
    pub noise: f64,
}

impl World {
    pub fn new(seed: u64, heights: &[f64]) -> Self {
        let mut world = Self {
            draws: Stream::new(2014, "floors", "test").at(seed),
            heights: heights.to_vec(),
            at: 0,
            car: 0.0,
            noise: 1.0,
        };
        world.car = heights[0] + LEVEL * world.normal();
        world
    }

    /// Ten floors, 3 m apart.
    pub fn even(seed: u64) -> Self {
        let heights: Vec<f64> = (0..10).map(|floor| 3.0 * f64::from(floor)).collect();
        Self::new(seed, &heights)
    }

    pub fn unit(&mut self) -> f64 {
        (self.draws.next_u64() >> 11) as f64 * 0.5_f64.powi(53)
    }

    pub fn below(&mut self, number: usize) -> usize {
        (self.unit() * number as f64) as usize
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.unit())
    }

    /// Goes to a floor, or `offset` beside it, and returns the measured trip.
    pub fn go(&mut self, to: usize, offset: f64) -> (f64, f64) {
        let car = self.heights[to] + offset + LEVEL * self.normal();
        let distance = car - self.car;
        let error = self.noise * variance(distance).sqrt() * self.normal();
        (self.car, self.at) = (car, to);
        (distance + error, variance(distance + error))
    }

    /// Puts the car back where it was then; its draws go on.
    pub fn return_to(&mut self, then: &Self) {
        (self.at, self.car) = (then.at, then.car);
    }

    pub fn next(&mut self, traffic: Traffic) -> usize {
        let floors = self.heights.len();
        if traffic == Traffic::Lobby && self.at > 0 && self.unit() < 0.75 {
            return 0;
        }
        let least = usize::from(traffic == Traffic::Lobby);
        loop {
            let to = least + self.below(floors - least);
            if to != self.at {
                return to;
            }
        }
    }

    /// The map after a sweep.
    pub fn swept(&mut self, settings: Settings) -> Floors {
        let mut floors = Floors::unknown(settings).unwrap();
        for floor in 1..self.heights.len() {
            let (distance, variance) = self.go(floor, 0.0);
            assert_eq!(floors.step(distance, variance).added, Some(floor));
        }
        floors
    }

    /// A trip to the next floor of the traffic.
    pub fn ride(&mut self, floors: &mut Floors, traffic: Traffic) -> Stop {
        let to = self.next(traffic);
        self.stop(floors, to, 0.0)
    }

    pub fn stop(&mut self, floors: &mut Floors, to: usize, offset: f64) -> Stop {
        let (distance, variance) = self.go(to, offset);
        floors.step(distance, variance)
    }

    /// The map after a sweep and so many trips.
    pub fn settled(&mut self, settings: Settings, traffic: Traffic, trips: usize) -> Floors {
        let mut floors = self.swept(settings);
        for _ in 0..trips {
            self.ride(&mut floors, traffic);
        }
        floors
    }
}

/// Squared errors of the heights above the lowest, and their normalised sum, each per floor.
pub fn map_error(floors: &Floors, world: &World) -> (f64, f64) {
    let known = floors.knowledge();
    let n = known.heights.len() - 1;
    let error: Vec<f64> = (1..=n)
        .map(|i| known.heights[i] - (world.heights[i] - world.heights[0]))
        .collect();
    let covariance = nalgebra::DMatrix::from_fn(n, n, |i, j| {
        known.covariance[(i + 1) * (n + 1) + j + 1]
    });
    let error = nalgebra::DVector::from_vec(error);
    let solved = covariance.cholesky().unwrap().solve(&error);
    let each = n as f64;
    (error.norm_squared() / each, error.dot(&solved) / each)
}
