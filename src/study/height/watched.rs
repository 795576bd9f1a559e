//! A simulated lift, as its sensors record it.

use crate::lift::{Ending, Ride, Trip};
use crate::recording::{Barometer, GRAVITY, Pressure, Sample};
use crate::rng::{self, Generator, Stream};
use crate::signal::white_noise;
use crate::study::trips::{Condition, Numbers};
use libm::{exp, round};

/// Floors, and how far apart they are, m.
const FLOORS: usize = 10;
const APART: f64 = 4.0;

/// The shortest and the longest rest, s.
const REST: [f64; 2] = [15.0, 45.0];

/// The barometer's rate, Hz, and the deviation of a reading, m.
pub const RATE: f64 = 39.2;
pub const NOISE: f64 = 0.25;

/// A lift and its record.
pub struct Watched {
    pub numbers: Numbers,
    pub samples: Vec<Sample>,
    /// Where the car is at each sample, m above its first floor.
    pub truth: Vec<f64>,
    /// Heights of the floors above the first one, m.
    pub floors: Vec<f64>,
    readings: Vec<Reading>,
    /// Whether the weather makes the height rise, 1 or −1.
    sign: f64,
}

/// A reading of the barometer.
struct Reading {
    /// s.
    time: f64,
    /// Where the car is, m.
    height: f64,
    /// In deviations.
    noise: f64,
}

impl Watched {
    pub fn new(trips: usize, seed: u64, trial: u64) -> Self {
        let mut draws = Stream::new(seed, "height", "").at(trial);
        let numbers = Condition::Typical.numbers();
        let visited = visited(trips, &mut draws);
        let ride = ride(&numbers, &visited, &mut draws);
        let truth = truth(&ride);
        let at = |floor: usize| APART * (floor as f64 - visited[0] as f64);
        Self {
            samples: samples(&ride, &numbers, &mut draws),
            floors: (0..FLOORS).map(at).collect(),
            readings: readings(&truth, numbers.rate, &mut draws),
            truth,
            sign: if trial.is_multiple_of(2) { 1.0 } else { -1.0 },
            numbers,
        }
    }

    /// What it reads in air of so many °C and, at the first floor, so many Pa, with this deviation of a reading, Pa, where the
    /// weather moves its height by so much, m/s.
    pub fn pressures(&self, celsius: f64, pascal: f64, noise: f64, rate: f64) -> Barometer {
        // The height in which the pressure of such air falls by a factor e.
        let scale = 287.05 * (celsius + 273.15) / GRAVITY;
        let readings = self.readings.iter().map(|it| {
            let height = it.height + self.sign * rate * it.time;
            Pressure {
                time: it.time,
                pascal: pascal * exp(-height / scale) + noise * it.noise,
            }
        });
        Barometer::of_readings(readings.collect())
    }

    /// The barometer's readings where the weather moves its height by so much, m/s.
    pub fn barometer(&self, rate: f64) -> Vec<(f64, f64)> {
        let read = self.readings.iter();
        read.map(|it| {
            (
                it.time,
                it.height + NOISE * it.noise + self.sign * rate * it.time,
            )
        })
        .collect()
    }
}

/// The floors at which the car stands in turn, each another than before.
fn visited(trips: usize, draws: &mut Generator) -> Vec<usize> {
    let mut floor = 0;
    let others = (0..trips).map(|_| {
        let step = 1 + (rng::unit(draws) * (FLOORS - 1) as f64) as usize;
        floor = (floor + step.min(FLOORS - 1)) % FLOORS;
        floor
    });
    [0].into_iter().chain(others).collect()
}

fn ride(numbers: &Numbers, visited: &[usize], draws: &mut Generator) -> Ride {
    let trip = |pair: &[usize]| Trip {
        distance: APART * (pair[1] as f64 - pair[0] as f64),
        drive: numbers.drive,
        ending: Ending::Braked(numbers.braking),
    };
    let [least, most] = REST;
    let rests = visited
        .iter()
        .map(|_| least + (most - least) * rng::unit(draws));
    let trips = visited.windows(2).map(trip).collect();
    Ride::new(numbers.rate, rests.collect(), trips).expect("every limit here is positive")
}

/// Where the car is at each sample.
fn truth(ride: &Ride) -> Vec<f64> {
    let mut truth = Vec::with_capacity(ride.samples());
    let mut stood = 0.0;
    let time = |sample: usize| sample as f64 / ride.rate();
    for (start, course) in ride.started() {
        let stop = start + course.duration();
        while time(truth.len()) < stop {
            let moved = (time(truth.len()) - start).max(0.0);
            truth.push(stood + course.position_at(moved));
        }
        stood += course.distance();
    }
    truth.resize(ride.samples(), stood);
    truth
}

fn samples(ride: &Ride, numbers: &Numbers, draws: &mut Generator) -> Vec<Sample> {
    let level = GRAVITY + rng::unit(draws) - 0.5;
    let noise = white_noise(ride.samples(), draws);
    let sigma = numbers.sigma();
    let samples = ride.acceleration().into_iter().zip(noise).enumerate();
    let samples = samples.map(|(place, (acceleration, noise))| {
        let read = acceleration + level + sigma * noise;
        Sample {
            time: place as f64 / numbers.rate,
            acceleration: numbers.step * round(read / numbers.step),
        }
    });
    samples.collect()
}

fn readings(truth: &[f64], rate: f64, draws: &mut Generator) -> Vec<Reading> {
    let count = (truth.len() as f64 / rate * RATE) as usize;
    let noise = white_noise(count, draws).into_iter().enumerate();
    let readings = noise.map(|(place, noise)| {
        let time = place as f64 / RATE;
        Reading {
            time,
            height: truth[(time * rate) as usize],
            noise,
        }
    });
    readings.collect()
}
