//! The trip filter of [^1]: a Kalman filter on x = [d, s, b, s⁻], the distance since the last stop, the speed, the bias of
//! the accelerometer with gravity's rest, and the speed before.
//!
//! - d ← d + T s + T²/2 (u − b), s ← s + T (u − b), b ← b, s⁻ ← s
//! - noise: S_a/T on u, S_b T on b
//! - uniform motion: 0 = s − s⁻ + v, var v = R_u
//! - zero velocity: 0 = s + v, var v = R_0
//!
//! u is the mean acceleration over the T seconds around a sample. Every step's noise is its own: a u shared by two
//! steps, as in the trapezoidal rule, would colour it, and the uniform motions would believe it twice.

use super::noise::Noise;
use crate::kalman::{Estimate, Innovation};

/// The places of the state.
const DISTANCE: usize = 0;
const SPEED: usize = 1;
const BIAS: usize = 2;

/// H of the two measurements.
const UNIFORM: [f64; 4] = [0.0, 1.0, 0.0, -1.0];
const STANDING: [f64; 4] = [0.0, 1.0, 0.0, 0.0];

/// A value and its variance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uncertain {
    /// The value.
    pub mean: f64,
    /// Its variance.
    pub variance: f64,
}

impl Uncertain {
    /// Zero with this deviation.
    pub(super) fn error(deviation: f64) -> Self {
        Self {
            mean: 0.0,
            variance: deviation * deviation,
        }
    }

    /// The sum of two that know nothing of each other.
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            mean: self.mean + other.mean,
            variance: self.variance + other.variance,
        }
    }
}

/// What a step may learn beside the acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Update {
    /// Nothing.
    None,
    /// The speed is what it was before.
    Uniform,
    /// The cage stands.
    Standing,
}

/// The filter of a trip.
#[derive(Clone, Debug)]
pub struct TripFilter {
    noise: Noise,
    /// S_a now, in that of the noise.
    shaken: f64,
    estimate: Estimate<[f64; 4], [f64; 16]>,
}

impl TripFilter {
    /// A cage that stands, with a sensor whose bias is about so much, m/s².
    pub fn new(noise: Noise, bias: Uncertain) -> Self {
        let mut covariance = [0.0; 16];
        covariance[5 * BIAS] = bias.variance;
        Self {
            noise,
            shaken: 1.0,
            estimate: Estimate {
                mean: [0.0, 0.0, bias.mean, 0.0],
                covariance,
            },
        }
    }

    /// From here on S_a is so many times that of the noise.
    pub fn shake(&mut self, times: f64) {
        self.shaken = times;
    }

    /// Moves on by `seconds` of this mean acceleration, m/s².
    #[inline]
    pub fn predict(&mut self, acceleration: f64, seconds: f64) {
        let t = seconds;
        let half = t * t / 2.0;
        #[rustfmt::skip]
        let transition = [
            1.0, t,   -half, 0.0,
            0.0, 1.0, -t,    0.0,
            0.0, 0.0, 1.0,   0.0,
            0.0, 1.0, 0.0,   0.0,
        ];
        let input = [half * acceleration, t * acceleration, 0.0, 0.0];
        let variances = self.noise.of_step(t);
        let variance = self.shaken * variances.acceleration;
        let mut noise = [0.0; 16];
        noise[0] = half * half * variance;
        (noise[1], noise[4]) = (half * t * variance, half * t * variance);
        noise[5] = t * t * variance;
        noise[10] = variances.bias;
        self.estimate.predict(&transition, &input, &noise);
    }

    /// Learns what is known of the `seconds` of the last prediction.
    #[inline]
    pub fn update(&mut self, update: Update, seconds: f64) {
        let variances = self.noise.of_step(seconds);
        match update {
            Update::None => {}
            Update::Uniform => {
                let variance = self.shaken * variances.uniform;
                self.estimate.update(&UNIFORM, 0.0, variance);
            }
            Update::Standing => {
                self.estimate.update(&STANDING, 0.0, variances.standing);
            }
        }
    }

    /// How well the speed agrees with a standing cage, ξ_d; its error may have this further variance, (m/s)².
    pub fn standing(&self, seconds: f64, further: f64) -> Innovation {
        let variance = self.noise.of_step(seconds).standing + further;
        self.estimate.innovation(&STANDING, 0.0, variance)
    }

    /// From the last stop, m, up positive.
    pub fn distance(&self) -> Uncertain {
        self.element(DISTANCE)
    }

    /// m/s, up positive.
    pub fn speed(&self) -> Uncertain {
        self.element(SPEED)
    }

    /// m/s².
    pub fn bias(&self) -> Uncertain {
        self.element(BIAS)
    }

    fn element(&self, place: usize) -> Uncertain {
        Uncertain {
            mean: self.estimate.mean[place],
            variance: self.estimate.covariance[5 * place],
        }
    }

    /// Measures the distance from here on.
    pub fn restart(&mut self) {
        self.estimate.mean[DISTANCE] = 0.0;
        for place in 0..4 {
            self.estimate.covariance[4 * DISTANCE + place] = 0.0;
            self.estimate.covariance[4 * place + DISTANCE] = 0.0;
        }
    }
}
