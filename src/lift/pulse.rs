//! What acts on a sensor along the vertical, each by the speed that its acceleration adds up to.
//!
//! A sample is the mean acceleration over its period, so it is the difference of two such speeds divided by the
//! period: samples add up exactly, however short the pulse.

use super::draws::Draws;
use super::drive::Start;
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

    /// Adds it to samples that begin at time 0, `scale` to a change of 1 m/s in a sample.
    pub fn add_to(&self, acceleration: &mut [f64], rate: f64, scale: f64) {
        let until = self.from + self.shape.seconds();
        let span = (self.from, until);
        add_speed(acceleration, rate, scale, span, |time| self.speed_at(time));
    }
}

/// Adds the acceleration of what changes its speed from one time to another: the mean over each sample's period.
pub(super) fn add_speed(
    acceleration: &mut [f64],
    rate: f64,
    scale: f64,
    (from, until): (f64, f64),
    speed_at: impl Fn(f64) -> f64,
) {
    let edge = |i: usize| (i as f64 - 0.5) / rate;
    let first = (from * rate).round().max(0.0) as usize;
    let mut speed = speed_at(edge(first));
    for (i, a) in acceleration.iter_mut().enumerate().skip(first) {
        let next = speed_at(edge(i + 1));
        *a += (next - speed) * scale;
        speed = next;
        if edge(i + 1) >= until {
            break;
        }
    }
}

/// People walk about, with so many steps a second.
pub(super) fn footfalls(steps: f64, (from, to): (f64, f64), draws: &mut Draws) -> Vec<Pulse> {
    let mut pulses = Vec::new();
    let mut now = from + draws.gap(steps);
    while now < to {
        let shape = Shape::Sine {
            peak: draws.sign() * draws.decades([0.03, 0.4]),
            seconds: draws.within([0.06, 0.2]),
        };
        pulses.push(Pulse { from: now, shape });
        now += draws.gap(steps);
    }
    pulses
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
