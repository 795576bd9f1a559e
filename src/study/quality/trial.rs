//! One ride, judged from its record by every sensor.

use super::table::Point;
use crate::counts::{Shape, Sums};
use crate::lift::{Journey, Ride as Trips};
use crate::recording::Sample;
use crate::rng::{self, Generator, Stream};
use crate::signal::white_noise;
use crate::study::trips::Numbers;
use crate::track::Phases;
use crate::track::quality::{Measure, Quality, Ride};
use libm::{fabs, round, sin, sqrt};
use std::f64::consts::TAU;

/// For each figure, whether it is called noise; and the sums and the sums of squares of its truth, its error and the square
/// of that.
pub(super) const PAIRS: usize = 3;

pub(super) fn shape() -> Shape {
    let figures = Measure::ALL.len();
    Shape {
        most: vec![Some(1); figures],
        lengths: 2 * PAIRS * figures,
        ..Shape::default()
    }
}

/// The length of a ride, m, and its rests, s.
const DISTANCE: f64 = 20.0;
const RESTS: [f64; 2] = [3.0, 3.0];

/// The rate at which the truth is read, Hz.
const RATE: f64 = 800.0;

/// What shakes a car: so many swings in each direction, each at any frequency within these, Hz.
const SWINGS: usize = 12;
const FREQUENCIES: (f64, f64) = (1.0, 30.0);

/// What is left out of rests and of uniform motion, s, as a detection leaves it out.
const FOOT: f64 = 0.15;
const MARGIN: f64 = 0.3;

/// A swing of the car.
#[derive(Clone, Copy)]
struct Swing {
    frequency: f64,
    phase: f64,
}

impl Swing {
    fn new(draws: &mut Generator) -> Self {
        let (from, to) = FREQUENCIES;
        Self {
            frequency: from + (to - from) * rng::unit(draws),
            phase: TAU * rng::unit(draws),
        }
    }

    /// Its mean over a period of the sampling, where its deviation is 1.
    fn at(&self, time: f64, rate: f64) -> f64 {
        let half = TAU / 2.0 * self.frequency / rate;
        sqrt(2.0) * sin(half) / half * sin(TAU * self.frequency * time + self.phase)
    }
}

/// The sums of these points, which are shaken alike.
pub(super) fn run(points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
    let mut draws = Stream::new(seed, "quality", "").at(trial);
    let swings = [(); 3].map(|()| [(); SWINGS].map(|()| Swing::new(&mut draws)));
    let mut truths: Vec<(Numbers, Quality)> = Vec::new();
    let each = points.iter().map(|point| {
        let numbers = point.condition.numbers();
        let shaken = |numbers| Record::new(numbers, point.vibration, &swings);
        let known = truths.iter().find(|(of, _)| of.is_driven_like(&numbers));
        let truth = known.map(|(_, truth)| *truth).unwrap_or_else(|| {
            let truth = shaken(Numbers {
                rate: RATE,
                ..numbers
            })
            .judged();
            truths.push((numbers, truth));
            truth
        });
        let mut noise = Stream::new(seed, "quality", "sensor").at(trial);
        sums(&truth, &shaken(numbers).sensed(&mut noise).judged())
    });
    each.collect()
}

fn sums(truth: &Quality, found: &Quality) -> Sums {
    let mut sums = shape().empty().sums;
    for (place, measure) in Measure::ALL.into_iter().enumerate() {
        let pair = truth.figure(measure).zip(found.figure(measure));
        let (truth, found) = pair.expect("a ride of that length has every figure");
        let error = found.value - truth.value;
        let square = error * error;
        sums.counts[place] = u64::from(found.is_noise());
        for (at, value) in [truth.value, error, square].into_iter().enumerate() {
            sums.note(PAIRS * place + at, value);
        }
    }
    sums
}

/// What is read of a ride along the vertical and in two directions across it.
struct Record {
    numbers: Numbers,
    journey: Journey,
    directions: [Vec<Sample>; 3],
}

impl Record {
    fn new(numbers: Numbers, vibration: f64, swings: &[[Swing; SWINGS]; 3]) -> Self {
        let ride: Trips = numbers.ride(DISTANCE, RESTS);
        let motion = ride.acceleration();
        let rate = numbers.rate;
        let directions = [0, 1, 2].map(|direction| {
            let mut speed = 0.0;
            let samples = motion.iter().enumerate().map(|(place, acceleration)| {
                speed += acceleration / rate;
                let time = place as f64 / rate;
                let shake: f64 = swings[direction].iter().map(|it| it.at(time, rate)).sum();
                let strength = vibration / sqrt(SWINGS as f64) * fabs(speed) / numbers.drive.speed;
                let along = if direction == 0 { *acceleration } else { 0.0 };
                Sample {
                    time,
                    acceleration: along + strength * shake,
                }
            });
            samples.collect()
        });
        Self {
            numbers,
            journey: ride.journeys()[0],
            directions,
        }
    }

    /// As the sensor reads it.
    fn sensed(mut self, draws: &mut Generator) -> Self {
        let (sigma, step) = (self.numbers.sigma(), self.numbers.step);
        for samples in &mut self.directions {
            let offset = rng::unit(draws) - 0.5;
            let noise = white_noise(samples.len(), draws);
            for (sample, noise) in samples.iter_mut().zip(noise) {
                let read = sample.acceleration + offset + sigma * noise;
                sample.acceleration = step * round(read / step);
            }
        }
        self
    }

    fn judged(&self) -> Quality {
        let Journey {
            start,
            uniform,
            braking,
            stop,
            ..
        } = self.journey;
        let ride = Ride {
            phases: Phases {
                before: start - FOOT - 2.0..start - FOOT,
                uniform: [uniform + MARGIN..braking - MARGIN, stop..stop],
                after: stop + FOOT..stop + FOOT + 1.0,
            },
            sign: 1.0,
        };
        let [vertical, across @ ..] = &self.directions;
        let judged = Quality::of(vertical, across, self.numbers.rate, &ride);
        judged.expect("a simulated record has no hole")
    }
}
