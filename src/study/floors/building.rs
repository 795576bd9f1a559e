//! A car among floors, and its trips as a trip filter would give them.
//!
//! No accelerometer record is simulated. A measured distance is the true one plus a normal error with the
//! variance of the best unbiased estimate from white noise of density S_a and a constant bias,
//! (2/3) S_a [(T_c/2 + T_a)³ − (T_c/2)³] for a trip that starts for T_a, cruises for T_c and brakes as it started.
//! The error may be larger than claimed. The car stops σ_s beside its floor.

use crate::lift::{Drive, Ending, Trip};
use crate::rng::{self, Generator};
use libm::{cos, log, sqrt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// S_a of an MPU-6050, m²/s³: half the square of its 400 µg/√Hz.
const DENSITY: f64 = 7.69e-6;
/// Of a passenger lift.
const DRIVE: Drive = Drive {
    speed: 1.6,
    acceleration: 1.1,
    jerk: 2.0,
};

/// Where the next trip goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Traffic {
    /// To any other floor with equal probability.
    #[default]
    Uniform,
    /// From the lowest floor to any other; from elsewhere to the lowest three times out of four.
    Lobby,
}

/// A trip as measured.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// m.
    pub distance: f64,
    /// As claimed, m².
    pub variance: f64,
}

/// A building and its car.
#[derive(Clone, Debug)]
pub struct Building {
    pub draws: Generator,
    /// m.
    pub heights: Vec<f64>,
    /// σ_s, m.
    pub level: f64,
    /// True deviation of a trip over the claimed one.
    pub noise: f64,
    pub traffic: Traffic,
    /// The floor of the latest stop.
    pub at: usize,
    /// Where the car is, m.
    pub car: f64,
}

impl Building {
    /// The car at the lowest floor.
    pub fn new(draws: Generator, heights: Vec<f64>, level: f64) -> Self {
        let mut building = Self {
            draws,
            level,
            noise: 1.0,
            traffic: Traffic::Uniform,
            at: 0,
            car: 0.0,
            heights,
        };
        building.car = building.heights[0] + level * building.normal();
        building
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        rng::unit(&mut self.draws)
    }

    /// A number below another, each with equal probability.
    pub fn below(&mut self, number: usize) -> usize {
        ((self.unit() * number as f64) as usize).min(number - 1)
    }

    /// 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { 1.0 } else { -1.0 }
    }

    /// A standard normal number, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        let radius = sqrt(-2.0 * log(1.0 - self.unit()));
        radius * cos(TAU * self.unit())
    }

    /// A normal number with this deviation, drawn again until it lies within `limit`.
    pub fn within(&mut self, deviation: f64, limit: f64) -> f64 {
        loop {
            let value = deviation * self.normal();
            if value.abs() < limit {
                return value;
            }
        }
    }

    /// A floor so many storeys away, or as many as there are.
    pub fn away(&mut self, storeys: usize) -> usize {
        let highest = self.heights.len() - 1;
        let (below, above) = (self.at, highest - self.at);
        let is_up = match (below >= storeys, above >= storeys) {
            (true, true) => self.unit() < 0.5,
            (fits_below, fits_above) => fits_above || (!fits_below && above > below),
        };
        if is_up {
            self.at + storeys.min(above)
        } else {
            self.at - storeys.min(below)
        }
    }

    /// Goes to a floor, or `offset` beside it.
    pub fn go(&mut self, to: usize, offset: f64) -> Measured {
        let car = self.heights[to] + offset + self.level * self.normal();
        let distance = car - self.car;
        let error = self.noise * sqrt(variance(distance)) * self.normal();
        (self.car, self.at) = (car, to);
        let distance = distance + error;
        Measured {
            distance,
            variance: variance(distance),
        }
    }

    /// The next floor of the traffic.
    pub fn next(&mut self) -> usize {
        let floors = self.heights.len();
        if self.traffic == Traffic::Lobby && self.at > 0 && self.unit() < 0.75 {
            return 0;
        }
        let lowest = usize::from(self.traffic == Traffic::Lobby && floors > 2);
        loop {
            let to = lowest + self.below(floors - lowest);
            if to != self.at {
                return to;
            }
        }
    }
}

/// The variance of a measured distance, m².
pub fn variance(distance: f64) -> f64 {
    let trip = Trip {
        distance,
        drive: DRIVE,
        ending: Ending::Commanded,
    };
    // A trip of no length takes no time.
    let Ok(course) = trip.course() else {
        return 0.0;
    };
    let (start, braking) = course.uniform_motion();
    let cruise = braking - start;
    let cube = |x: f64| x * x * x;
    2.0 / 3.0 * DENSITY * (cube(cruise / 2.0 + start) - cube(cruise / 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deviations that the issue gives, in cm.
    #[test]
    fn deviations_of_trips() {
        for (distance, expected) in [(3.0, 0.62), (9.0, 1.59), (15.0, 2.62), (27.0, 4.70)] {
            let deviation = 100.0 * sqrt(variance(distance));
            assert!(
                (deviation - expected).abs() < 0.005,
                "{distance}: {deviation}"
            );
            assert_eq!(variance(-distance), variance(distance));
        }
        assert_eq!(variance(0.0), 0.0);
    }

    /// Against the projection that it stands for: d = −∫ (t − t̄) u dt over the start and the braking, summed.
    #[test]
    fn the_variance_is_that_of_the_moment_formula() {
        for distance in [1.0_f64, 3.0, 9.0, 27.0] {
            let trip = Trip {
                distance,
                drive: DRIVE,
                ending: Ending::Commanded,
            };
            let course = trip.course().unwrap();
            let (from, to) = course.uniform_motion();
            let step = course.duration() / 200_000.0;
            let times = (0..200_000).map(|i| (f64::from(i) + 0.5) * step);
            let moving: Vec<f64> = times.filter(|t| *t < from || *t > to).collect();
            let mean = moving.iter().sum::<f64>() / moving.len() as f64;
            let square = |t: &f64| (t - mean) * (t - mean);
            let expected = DENSITY * moving.iter().map(square).sum::<f64>() * step;
            assert!(
                (variance(distance) / expected - 1.0).abs() < 1e-3,
                "{distance}"
            );
        }
    }
}
