//! A simulated lift and how its car shakes across the vertical.
//!
//! In either direction the car is a swing of 5 Hz, damped by 0.3, that white noise shakes, in proportion to the speed. The
//! energy differs along the shaft, exp(g) for a sum g of waves of 4 to 60 m, whose mean over the shaft is 1; and from trip
//! to trip. Where rails join, every 5 m, the car gets a knock that rings down within 0.15 s at 8 Hz, of its own size and
//! direction in each lift. A phone of 250 µg/√Hz reads it at 100 Hz.

use super::keys::Keys;
use crate::lift::{Drive, Ending, Trip};
use crate::recording::Sample;
use crate::rng::{self, Generator};
use crate::signal::white_noise;
use crate::track::Densities;
use crate::track::vibration::windows;
use libm::{cos, exp, fabs, floor, log, sin, sqrt};
use std::f64::consts::{PI, TAU};

/// Hz.
pub const RATE: f64 = 100.0;

/// One-sided, g/√Hz.
const DENSITY: f64 = 250e-6;

/// Of a passenger lift.
pub const DRIVE: Drive = Drive {
    speed: 1.6,
    acceleration: 1.1,
    jerk: 2.0,
};

/// Floors, and the height of each, m.
const FLOORS: usize = 12;
const STOREY: f64 = 3.0;

/// From one joint of the rails to the next, m.
pub const JOINT: f64 = 5.0;

/// The swing of the car, Hz, and its damping.
const SWING: (f64, f64) = (5.0, 0.3);

/// A knock rings down within this, s, at this, Hz, and is over after so long, s.
const RINGING: (f64, f64) = (0.15, 8.0);
const OVER: f64 = 1.0;

/// The waves of the shaft, and their lengths, m.
const WAVES: usize = 8;
const LENGTHS: (f64, f64) = (4.0, 60.0);

/// Places of the shaft for which its energy is known, a metre.
const PLACES: f64 = 10.0;

/// The deviation of the logarithm of a joint's knock.
const JOINTS: f64 = 0.5;

/// Left out at either end of a trip, s, as a trip that is found leaves it out.
const BOUNDARY: f64 = 0.5;

/// A lift.
pub struct Car {
    vibration: f64,
    unlike: f64,
    /// The strength of the shaking along the shaft.
    strengths: Vec<f64>,
    /// The knock of each joint, m/s², in both directions.
    knocks: Vec<[f64; 2]>,
}

/// From which height to which, m, and how much of the usual energy it has.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    pub from: f64,
    pub to: f64,
    pub energy: f64,
}

impl Car {
    pub fn new(keys: &Keys, draws: &mut Generator) -> Self {
        let height = STOREY * (FLOORS - 1) as f64;
        let waves = [(); WAVES].map(|()| {
            let (short, long) = LENGTHS;
            let length = short * exp(rng::unit(draws) * log(long / short));
            (TAU / length, TAU * rng::unit(draws))
        });
        let places = (0..=(height * PLACES) as usize).map(|place| place as f64 / PLACES);
        let energies = places.map(|at| {
            let sum: f64 = waves
                .iter()
                .map(|(wave, phase)| cos(wave * at + phase))
                .sum();
            exp(keys.uneven * sqrt(2.0 / WAVES as f64) * sum)
        });
        let energies: Vec<f64> = energies.collect();
        let mean = energies.iter().sum::<f64>() / energies.len() as f64;
        let joints = floor(height / JOINT) as usize + 1;
        let sizes = white_noise(joints, draws);
        let knocks = sizes.iter().map(|size| {
            let turn = TAU * rng::unit(draws);
            [cos(turn), sin(turn)].map(|along| along * keys.joints * exp(JOINTS * size))
        });
        Self {
            vibration: keys.vibration,
            unlike: keys.unlike,
            strengths: energies.iter().map(|it| sqrt(it / mean)).collect(),
            knocks: knocks.collect(),
        }
    }

    /// A trip from any floor to any other.
    pub fn way(&self, draws: &mut Generator) -> Way {
        let mut floor = |number: usize| (rng::unit(draws) * number as f64) as usize;
        let (from, other) = (floor(FLOORS), floor(FLOORS - 1));
        let to = other + usize::from(other >= from);
        let mut way = self.way_between(draws, [0.0; 2]);
        [way.from, way.to] = [from, to].map(|floor| STOREY * floor as f64);
        way
    }

    /// A trip from one height to another, m, as unlike others as any.
    pub fn way_between(&self, draws: &mut Generator, [from, to]: [f64; 2]) -> Way {
        let normal = white_noise(1, draws)[0];
        let energy = exp(self.unlike * (normal - self.unlike / 2.0));
        Way { from, to, energy }
    }

    /// The energies of the windows of a trip.
    pub fn energies(&self, way: &Way, draws: &mut Generator) -> Vec<f64> {
        let trip = Trip {
            distance: way.to - way.from,
            drive: DRIVE,
            ending: Ending::Commanded,
        };
        let course = trip.course().expect("floors are apart");
        let seconds = course.duration();
        let speeds =
            (0..(seconds * RATE) as usize).map(|place| course.speed_at(place as f64 / RATE));
        let across = self.across(way, &speeds.collect::<Vec<_>>(), draws);
        let found = windows(&across, RATE, &(BOUNDARY..seconds - BOUNDARY));
        found.iter().map(|it| it.energy).collect()
    }

    /// What is read across the vertical where the car goes its way with these speeds.
    pub fn across(&self, way: &Way, speeds: &[f64], draws: &mut Generator) -> [Vec<Sample>; 2] {
        let mut height = way.from;
        let mut moments = Vec::with_capacity(speeds.len());
        let mut passed = Vec::new();
        for (place, speed) in speeds.iter().enumerate() {
            let before = height;
            height += speed / RATE;
            let at = (height * PLACES + 0.5).clamp(0.0, (self.strengths.len() - 1) as f64);
            let fast = fabs(*speed) / DRIVE.speed * sqrt(way.energy);
            moments.push(self.strengths[at as usize] * fast);
            let [one, other] = [before, height].map(|it| floor(it / JOINT));
            if one != other {
                passed.push((place, one.max(other) as usize, fast));
            }
        }
        [0, 1].map(|direction| {
            let mut readings = self.shaking(draws, &moments);
            for (place, joint, fast) in &passed {
                let knock = self.knocks.get(*joint).map_or(0.0, |it| it[direction]);
                knock_at(&mut readings, *place, fast * knock);
            }
            let sigma = sqrt(Densities::of_sheet(DENSITY) * RATE);
            let noise = white_noise(readings.len(), draws);
            let samples = readings.iter().zip(noise).enumerate();
            let samples = samples.map(|(place, (shaken, noise))| Sample {
                time: place as f64 / RATE,
                acceleration: shaken + sigma * noise,
            });
            samples.collect()
        })
    }

    /// The swing of the car, of these strengths.
    fn shaking(&self, draws: &mut Generator, strengths: &[f64]) -> Vec<f64> {
        let noise = white_noise(strengths.len(), draws);
        let (frequency, damping) = SWING;
        let radius = exp(-damping * TAU * frequency / RATE);
        let turn = TAU * frequency * sqrt(1.0 - damping * damping) / RATE;
        let (one, two) = (2.0 * radius * cos(turn), -radius * radius);
        // The variance of such a process, of noise of variance 1.
        let variance = (1.0 - two) / ((1.0 + two) * ((1.0 - two) * (1.0 - two) - one * one));
        let scale = self.vibration / sqrt(variance);
        let (mut last, mut before) = (0.0, 0.0);
        let shaken = noise.iter().zip(strengths).map(|(noise, strength)| {
            let now = one * last + two * before + noise;
            (before, last) = (last, now);
            scale * strength * now
        });
        shaken.collect()
    }
}

/// Adds a knock of this size, m/s², at a place.
pub fn knock_at(readings: &mut [f64], place: usize, size: f64) {
    let (fall, frequency) = RINGING;
    let ringing = readings.iter_mut().skip(place).take((OVER * RATE) as usize);
    for (reading, at) in ringing.zip(0..) {
        let time = f64::from(at) / RATE;
        *reading += size * exp(-time / fall) * sin(2.0 * PI * frequency * time);
    }
}
