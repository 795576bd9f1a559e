//! What happens in a window at rest.

use crate::recording::GRAVITY;
use crate::rng::{self, Generator, Stream};
use crate::signal::white_noise;
use crate::track::Densities;
use crate::vector::{Vector, mix, unit};
use libm::{exp, round, sin, sqrt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;

/// What happens beside the noise of an MPU-6050 (400 µg/√Hz, 16 384 steps a g, 200 Hz).
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// Nothing.
    Noise,
    /// People walk about: four steps, each a floor that swings at 8 Hz with 0.05 to 0.5 m/s² and dies away in 0.15 s.
    People,
    /// Six knocks of the doors of 10 ms, each of 1 to 10 m/s² in any direction.
    Shocks,
    /// The lift starts up in the last 0.4 s, with 1.5 m/s³.
    Start,
    /// The steps of the sensor are 18 mg.
    CoarseSteps,
    /// They are, and the doors knock.
    CoarseShocks,
}

/// Samples of a window, at this rate, Hz.
const SAMPLES: usize = 400;
const RATE: f64 = 200.0;

/// A window of readings.
pub(super) struct Window {
    /// m/s².
    pub gravity: Vector,
    /// m/s².
    pub readings: Vec<Vector>,
    /// Of the sensor, m/s².
    pub step: f64,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Condition {
    /// The sensor's step, m/s².
    fn step(self) -> f64 {
        GRAVITY
            * match self {
                Self::CoarseSteps | Self::CoarseShocks => 0.018,
                _ => 1.0 / 16_384.0,
            }
    }

    /// What it adds to the readings of each sample; up is this.
    fn added(self, up: Vector, draws: &mut Generator) -> Vec<Vector> {
        let mut added = vec![[0.0; 3]; SAMPLES];
        let mut add = |from: f64, direction: Vector, strength: &dyn Fn(f64) -> f64| {
            for (sample, sum) in added.iter_mut().enumerate() {
                let time = sample as f64 / RATE - from;
                if time >= 0.0 {
                    *sum = mix([(1.0, *sum), (strength(time), direction)]);
                }
            }
        };
        match self {
            Self::Noise | Self::CoarseSteps => {}
            Self::People => {
                for _ in 0..4 {
                    let [from, peak] = [2.0, 0.45].map(|most| most * rng::unit(draws));
                    let swing =
                        |time: f64| (0.05 + peak) * exp(-time / 0.15) * sin(2.0 * PI * 8.0 * time);
                    add(from, up, &swing);
                }
            }
            Self::Shocks | Self::CoarseShocks => {
                for _ in 0..6 {
                    let [from, peak] = [2.0, 9.0].map(|most| most * rng::unit(draws));
                    let knock = |time: f64| if time < 0.01 { 1.0 + peak } else { 0.0 };
                    add(from, direction(draws), &knock);
                }
            }
            Self::Start => add(1.6, up, &|time| 1.5 * time),
        }
        added
    }
}

/// Any direction alike.
fn direction(draws: &mut Generator) -> Vector {
    loop {
        let cube = [(); 3].map(|()| 2.0 * rng::unit(draws) - 1.0);
        let square: f64 = cube.iter().map(|it| it * it).sum();
        if let Some(direction) = unit(cube).filter(|_| square <= 1.0) {
            return direction;
        }
    }
}

impl Window {
    pub fn new(condition: Condition, seed: u64, trial: u64) -> Self {
        let mut draws = Stream::new(seed, "gravity", "").at(trial);
        let up = direction(&mut draws);
        let sigma = sqrt(Densities::of_sheet(400e-6) * RATE);
        let noise = white_noise(3 * SAMPLES, &mut draws);
        let step = condition.step();
        let added = condition.added(up, &mut draws);
        let readings = added.iter().zip(noise.chunks(3)).map(|(added, noise)| {
            let at = mix([(GRAVITY, up), (1.0, *added)]);
            [0, 1, 2].map(|axis| step * round((at[axis] + sigma * noise[axis]) / step))
        });
        Self {
            gravity: up.map(|along| GRAVITY * along),
            readings: readings.collect(),
            step,
        }
    }
}
