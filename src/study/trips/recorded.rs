//! A simulated trip as an accelerometer records it.

use super::condition::Numbers;
use crate::lift::Journey;
use crate::monitor::{self, Design};
use crate::recording::Sample;
use crate::rng::{self, Generator};
use crate::signal::white_noise;
use crate::track::{Densities, Phases, Steps, Track, Uncertain, moments};
use libm::{fabs, round};
use std::sync::LazyLock;

/// At rest before the trip and after it, s.
const RESTS: [f64; 2] = [5.0, 5.0];

/// Before and after the trip the rest of those who are told when it begins, s.
const MARGIN: f64 = 0.3;

/// The trips of a record of so many samples a second, as `liftsim track` measures them.
pub fn tracked(samples: &[Sample], rate: f64) -> Track {
    static NOMINAL: LazyLock<Design> =
        LazyLock::new(|| monitor::Settings::default().nominal().expect("they fit"));
    let design = NOMINAL.at(rate).expect("every rate here fits the defaults");
    Track::found(&design, samples, None).1
}

/// A recorded trip.
pub struct Recorded {
    pub samples: Vec<Sample>,
    pub journey: Journey,
    pub numbers: Numbers,
}

impl Recorded {
    /// A trip of so many metres.
    pub fn new(numbers: Numbers, distance: f64, draws: &mut Generator) -> Self {
        let bias = rng::unit(draws) - 0.5;
        let start = RESTS[0] + rng::unit(draws);
        let ride = numbers.ride(distance, [start, RESTS[1]]);
        let truth = ride.acceleration();
        let sigma = numbers.sigma();
        let noise = white_noise(2 * truth.len(), draws);
        let mut speed = 0.0;
        let samples = truth.into_iter().zip(noise.chunks(2)).enumerate();
        let samples = samples.map(|(place, (acceleration, noise))| {
            speed += acceleration / numbers.rate;
            let shaken = numbers.shaken * fabs(speed) / numbers.drive.speed;
            let gain = if acceleration > 0.0 {
                numbers.gain
            } else {
                1.0
            };
            let read = gain * acceleration + bias + sigma * (noise[0] + shaken * noise[1]);
            Sample {
                time: place as f64 / numbers.rate,
                acceleration: numbers.step * round(read / numbers.step),
            }
        });
        Self {
            samples: samples.collect(),
            journey: ride.journeys()[0],
            numbers,
        }
    }

    /// The phases, each known to a sample.
    fn phases(&self, margin: f64) -> Phases {
        let Journey {
            start,
            uniform,
            braking,
            levelling,
            stop,
            ..
        } = self.journey;
        let creeps = self.numbers.braking.seconds;
        let creep = levelling.map_or(stop..stop, |from| from..from + creeps);
        let (before, after) = (start - margin, stop + margin);
        Phases {
            before: before - 2.0..before,
            uniform: [uniform..braking, creep],
            after: after..after + 1.0,
        }
    }

    /// The trip for those who know only when it begins and ends.
    pub fn told(&self) -> Phases {
        self.phases(MARGIN)
    }

    /// The distance by the moment formula on the known phases.
    pub fn bound(&self) -> Uncertain {
        let steps: Vec<_> = Steps::of(&self.samples).collect();
        let density = Densities::of_sheet(self.numbers.density);
        moments(&steps, &self.phases(0.0).changes(), density)
    }
}
