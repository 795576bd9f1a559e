//! What acts on a sensor along the vertical, each by the speed that its acceleration adds up to.
//!
//! A sample is the mean acceleration over its period, so it is the difference of two such speeds divided by the
//! period: samples add up exactly, however short the pulse.

use crate::lift::drive::Start;
use libm::{cos, exp, sin};
use std::f64::consts::PI;

/// A shape from a time on, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pulse {
    pub from: f64,
    pub shape: Shape,
}

/// Accelerations in m/s², up positive, times in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// The cage changes its speed, by −v where the sign is negative.
    SpeedChange {
        change: Start,
        sign: f64,
    },
    HalfSine {
        peak: f64,
        seconds: f64,
    },
    /// One period: its net speed is zero.
    Sine {
        peak: f64,
        seconds: f64,
    },
    /// For good where the time is infinite.
    Level {
        offset: f64,
        seconds: f64,
    },
    /// The cage sinks by `depth` metres under a load that is put on it, and swings about its new place:
    /// x = −depth (1 − e^(−γt) (cos ωt + γ/ω sin ωt)), with ω = 2πf and γ = damping ω. Its net speed is zero.
    Bounce {
        depth: f64,
        frequency: f64,
        damping: f64,
    },
}

/// A swing has ended when this is left of it.
const SWING_LEFT: f64 = 20.0;

impl Pulse {
    /// The speed that it has added by a time, m/s.
    pub fn speed_at(&self, time: f64) -> f64 {
        self.shape
            .speed_after((time - self.from).clamp(0.0, self.shape.seconds()))
    }

    /// Adds it to samples that begin at time 0.
    pub fn add_to(&self, acceleration: &mut [f64], rate: f64) {
        let edge = |i: usize| (i as f64 - 0.5) / rate;
        let first = (self.from * rate).round().max(0.0) as usize;
        let until = self.from + self.shape.seconds();
        let mut speed = self.speed_at(edge(first));
        for (i, a) in acceleration.iter_mut().enumerate().skip(first) {
            let next = self.speed_at(edge(i + 1));
            *a += (next - speed) * rate;
            speed = next;
            if edge(i + 1) >= until {
                break;
            }
        }
    }
}

impl Shape {
    fn seconds(&self) -> f64 {
        match *self {
            Self::SpeedChange { change, .. } => change.duration,
            Self::HalfSine { seconds, .. }
            | Self::Sine { seconds, .. }
            | Self::Level { seconds, .. } => seconds,
            Self::Bounce {
                frequency, damping, ..
            } => SWING_LEFT / (2.0 * PI * frequency * damping),
        }
    }

    fn speed_after(&self, time: f64) -> f64 {
        match *self {
            Self::SpeedChange { change, sign } => sign * change.speed_at(time),
            Self::HalfSine { peak, seconds } => {
                peak * seconds / PI * (1.0 - cos(PI * time / seconds))
            }
            Self::Sine { peak, seconds } => {
                let turn = 2.0 * PI / seconds;
                peak / turn * (1.0 - cos(turn * time))
            }
            Self::Level { offset, .. } => offset * time,
            Self::Bounce {
                depth,
                frequency,
                damping,
            } => {
                let omega = 2.0 * PI * frequency;
                let gamma = damping * omega;
                let decay = exp(-gamma * time);
                -depth * decay * (omega + gamma * gamma / omega) * sin(omega * time)
            }
        }
    }
}
