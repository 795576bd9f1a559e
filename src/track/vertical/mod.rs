//! Speed, acceleration and jerk of the cage by the filter of [^1], eqs (11) to (17), and its rules for when it stands.
//!
//! The state is x = [v, a, j]. Its jerk is constant but for white noise of its rate, of density q:
//!
//! - F = [1, T, T²/2; 0, 1, T; 0, 0, 1]
//! - Q = q [T⁵/20, T⁴/8, T³/6; T⁴/8, T³/3, T²/2; T³/6, T²/2, T]
//! - z = a + noise, H = [0, 1, 0]
//!
//! The cage neither speeds up nor brakes while all of the last n readings are below a threshold: then a and j are set to 0.
//! It stands if |v| is below a threshold too: then v is set to 0, and what the sensor reads is learnt anew, from windows of
//! two seconds each half second.
//!
//! # Where [^1] is read one way among several
//! - Its H = (0, 0, 1, 0)ᵀ has four entries for a state of three; what is measured is the acceleration.
//! - Q, n and both thresholds are not given. The numbers of [`Rules`] are a choice.
//! - A speed that ends above its threshold is uniform motion for ever. [`Rules::mended`] ends one that is slow for long.
//!
//! # What it is worth
//! Zeroing cuts the foot off every ramp, with a threshold h about h²/(2j) of the speed; and noise beyond h is motion. `configs/spacing.toml` measures it beside [`Track`](super::Track), which is better.
//!
//! [^1]: The monitor with accelerometer and barometer, in Chinese (楊昱等, 太原理工大學學報).

mod moves;
#[cfg(test)]
mod tests;

pub use moves::{ByRules, Move, Moves};

use super::steps::HOLE;
use crate::kalman::Estimate;
use crate::recording::Sample;
use serde::Serialize;
use std::collections::VecDeque;

/// The places of the state.
const SPEED: usize = 0;
const ACCELERATION: usize = 1;
const JERK: usize = 2;

/// H.
const MEASURED: [f64; 3] = [0.0, 1.0, 0.0];

/// What is known of the state of a cage that stands: its acceleration and jerk are of this order, m/s² and m/s³.
const UNKNOWN: [f64; 3] = [0.0, 1.0, 1.0];

/// It is learnt first from so many seconds.
const LEARNT: f64 = 2.0;

/// The windows in which the level of rest is learnt, and how often, s.
const WINDOW: f64 = 2.0;
const EVERY: f64 = 0.5;

/// The numbers of the filter and its rules.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// q, m²/s⁷.
    pub jerk_rate: f64,
    /// The variance of a reading, m²/s⁴.
    pub noise: f64,
    /// All readings of so many seconds are below the threshold.
    pub window: f64,
    /// Of a reading, m/s².
    pub threshold: f64,
    /// Of the speed, m/s.
    pub standing: f64,
    /// Uniform motion below `slow` of the highest speed ends after so many seconds.
    pub patience: f64,
    /// A share.
    pub slow: f64,
}

impl Rules {
    /// As printed, for readings of this deviation, m/s², with this threshold for them, m/s².
    pub fn printed(deviation: f64, threshold: f64) -> Self {
        Self {
            jerk_rate: 10.0,
            noise: deviation * deviation,
            window: 0.25,
            threshold,
            standing: 0.2,
            patience: f64::INFINITY,
            slow: 0.2,
        }
    }

    /// The same, but no cage is slow for ever.
    pub fn mended(self) -> Self {
        Self {
            patience: 2.0,
            ..self
        }
    }
}

/// What a cage does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// It stands.
    Rest,
    /// It speeds up.
    Acceleration,
    /// It moves uniformly.
    Inertial,
    /// It slows down.
    Braking,
}

/// The cage at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertical {
    /// s.
    pub time: f64,
    /// m/s, up positive.
    pub speed: f64,
    /// m/s².
    pub acceleration: f64,
    /// m/s³.
    pub jerk: f64,
    /// What it does.
    pub motion: Motion,
}

/// The filter, of a cage that stands at first.
#[derive(Clone, Debug)]
pub struct VerticalFilter {
    rules: Rules,
    estimate: Estimate<[f64; 3], [f64; 9]>,
    rest: Level,
    last: Option<f64>,
    /// Since when all readings are below the threshold, s.
    quiet: f64,
    /// Since when it moves uniformly, s.
    uniform: Option<f64>,
    /// Of the trip, m/s.
    highest: f64,
}

impl VerticalFilter {
    /// Follows a cage whose sensor reads this level at rest, m/s².
    pub fn new(rules: Rules, level: f64) -> Self {
        Self {
            rules,
            estimate: Estimate {
                mean: [0.0; 3],
                covariance: diagonal(UNKNOWN),
            },
            rest: Level::new(level),
            last: None,
            quiet: f64::NEG_INFINITY,
            uniform: None,
            highest: 0.0,
        }
    }

    /// The same, whose level is what the first seconds of a record read.
    pub fn learnt(rules: Rules, samples: &[Sample]) -> Self {
        let until = samples.first().map_or(0.0, |first| first.time) + LEARNT;
        let first = &samples[..samples.partition_point(|it| it.time < until)];
        let sum: f64 = first.iter().map(|it| it.acceleration).sum();
        Self::new(rules, sum / first.len() as f64)
    }

    /// Takes a sample.
    pub fn step(&mut self, sample: Sample) -> Vertical {
        let Sample { time, acceleration } = sample;
        let read = acceleration - self.rest.level;
        match self.last.replace(time).map(|last| time - last) {
            Some(seconds) if seconds <= HOLE => self.predict(seconds),
            // Of what it did in a hole nothing is known.
            _ => self.stand(),
        }
        self.estimate.update(&MEASURED, read, self.rules.noise);
        if read.abs() >= self.rules.threshold {
            self.quiet = time;
        }
        let motion = self.motion(time);
        match motion {
            Motion::Rest => self.rest.learn(sample),
            _ => self.rest.forget(),
        }
        let [speed, acceleration, jerk] = self.estimate.mean;
        Vertical {
            time,
            speed,
            acceleration,
            jerk,
            motion,
        }
    }

    fn predict(&mut self, t: f64) {
        #[rustfmt::skip]
        let transition = [
            1.0, t,   t * t / 2.0,
            0.0, 1.0, t,
            0.0, 0.0, 1.0,
        ];
        let q = self.rules.jerk_rate;
        let [one, two, three] = [q * t, q * t * t / 2.0, q * t * t * t / 3.0];
        let (half, four, five) = (three / 2.0, q * t.powi(4) / 8.0, q * t.powi(5) / 20.0);
        #[rustfmt::skip]
        let noise = [
            five, four,  half,
            four, three, two,
            half, two,   one,
        ];
        self.estimate.predict(&transition, &[0.0; 3], &noise);
    }

    /// Applies the rules.
    fn motion(&mut self, time: f64) -> Motion {
        if time - self.quiet < self.rules.window {
            self.uniform = None;
            self.highest = self.highest.max(self.estimate.mean[SPEED].abs());
            let power = self.estimate.mean[SPEED] * self.estimate.mean[ACCELERATION];
            return if power > 0.0 {
                Motion::Acceleration
            } else {
                Motion::Braking
            };
        }
        self.estimate.mean[ACCELERATION] = 0.0;
        self.estimate.mean[JERK] = 0.0;
        let speed = self.estimate.mean[SPEED].abs();
        let since = *self.uniform.get_or_insert(time);
        let is_slow = speed < self.rules.slow * self.highest;
        if speed < self.rules.standing || is_slow && time - since > self.rules.patience {
            self.stand();
            return Motion::Rest;
        }
        Motion::Inertial
    }

    fn stand(&mut self) {
        self.estimate.mean[SPEED] = 0.0;
        for place in 0..3 {
            self.estimate.covariance[3 * SPEED + place] = 0.0;
            self.estimate.covariance[3 * place + SPEED] = 0.0;
        }
        self.highest = 0.0;
    }
}

fn diagonal(of: [f64; 3]) -> [f64; 9] {
    let mut matrix = [0.0; 9];
    (0..3).for_each(|place| matrix[4 * place] = of[place]);
    matrix
}

/// What the sensor reads at rest.
#[derive(Clone, Debug)]
struct Level {
    /// m/s².
    level: f64,
    window: VecDeque<Sample>,
    /// Of the window, m/s².
    sum: f64,
    learnt: f64,
}

impl Level {
    fn new(level: f64) -> Self {
        Self {
            level,
            window: VecDeque::new(),
            sum: 0.0,
            learnt: f64::NEG_INFINITY,
        }
    }

    fn learn(&mut self, sample: Sample) {
        self.window.push_back(sample);
        self.sum += sample.acceleration;
        let first = self.window[0];
        if sample.time - first.time < WINDOW {
            return;
        }
        if sample.time - self.learnt >= EVERY {
            self.level = self.sum / self.window.len() as f64;
            self.learnt = sample.time;
        }
        self.window.pop_front();
        self.sum -= first.acceleration;
    }

    fn forget(&mut self) {
        if !self.window.is_empty() {
            *self = Self::new(self.level);
        }
    }
}
