//! The motion of a trip: a start, uniform motion, and a braking that ends in a creep, a stand, or a jam.

use super::drive::Start;
use crate::signal::Phase;
use libm::{cos, sin};
use std::f64::consts::PI;

/// The motion of a trip at any time, in seconds from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    pub(super) direction: f64,
    pub(super) start: Start,
    /// Duration of the uniform motion, s.
    pub(super) uniform: f64,
    /// From the highest speed to that of the creep, or to rest; reversed in time.
    pub(super) braking: Start,
    /// Duration of the creep, s.
    pub(super) creep: f64,
    /// From the creep to rest, reversed in time.
    pub(super) stop: Start,
    /// Stopping time, s, if it ends in a jam.
    pub(super) jam: Option<f64>,
}

impl Course {
    /// 1 up, −1 down.
    pub fn direction(&self) -> i8 {
        self.direction as i8
    }

    /// The highest speed, m/s, without its sign.
    pub fn top_speed(&self) -> f64 {
        self.start.speed
    }

    /// Whether it ends in a jam.
    pub fn is_jammed(&self) -> bool {
        self.jam.is_some()
    }

    /// Start and end of the uniform motion, s from the start; equal if there is none.
    pub fn uniform_motion(&self) -> (f64, f64) {
        (self.start.duration, self.start.duration + self.uniform)
    }

    /// Start of the creep to the landing, s from the start.
    pub fn levelling(&self) -> Option<f64> {
        (self.creep > 0.0).then(|| self.braking_until())
    }

    /// The duration of the trip, s.
    pub fn duration(&self) -> f64 {
        self.braking_until() + self.landing()
    }

    /// The distance travelled, m, up positive.
    pub fn distance(&self) -> f64 {
        self.position_at(self.duration())
    }

    /// Its phases in order, each with its duration in s; phases of no length are left out.
    pub fn phases(&self) -> impl Iterator<Item = (Phase, f64)> {
        let phases = [
            (Phase::Accelerating, self.start.duration),
            (Phase::Inertial, self.uniform),
            (Phase::Braking, self.braking()),
            (Phase::Levelling, self.landing()),
        ];
        phases.into_iter().filter(|(_, duration)| *duration > 0.0)
    }

    /// The phase at `time`.
    pub fn phase_at(&self, time: f64) -> Phase {
        match time {
            _ if !(0.0..self.duration()).contains(&time) => Phase::Rest,
            _ if time < self.start.duration => Phase::Accelerating,
            _ if time < self.braking_from() => Phase::Inertial,
            _ if time < self.braking_until() => Phase::Braking,
            _ => Phase::Levelling,
        }
    }

    /// m/s², up positive.
    pub fn acceleration_at(&self, time: f64) -> f64 {
        let (braked, left) = (time - self.braking_from(), self.duration() - time);
        let size = match self.jam {
            _ if braked <= 0.0 => self.start.acceleration_at(time),
            None => {
                let slower = self.braking_until() - time;
                -self.braking.acceleration_at(slower) - self.stop.acceleration_at(left)
            }
            Some(_) if left <= 0.0 => 0.0,
            Some(within) => -self.start.speed * PI / (2.0 * within) * sin(PI * braked / within),
        };
        self.direction * size
    }

    /// m/s, up positive.
    pub fn speed_at(&self, time: f64) -> f64 {
        let (braked, left) = (time - self.braking_from(), self.duration() - time);
        let size = match self.jam {
            _ if braked <= 0.0 => self.start.speed_at(time),
            None => {
                let slower = self.braking_until() - time;
                self.braking.speed_at(slower) + self.stop.speed_at(left)
            }
            Some(_) if left <= 0.0 => 0.0,
            Some(within) => self.start.speed * (1.0 + cos(PI * braked / within)) / 2.0,
        };
        self.direction * size
    }

    /// m from the start, up positive.
    pub fn position_at(&self, time: f64) -> f64 {
        let braked = (time - self.braking_from()).clamp(0.0, self.braking());
        let uniform = (time - self.start.duration).clamp(0.0, self.uniform);
        let of_braking = match self.jam {
            None => {
                // Each change of speed is reversed in time: what it has gone is what it has not to go any more.
                let gone =
                    |change: Start, left| change.way_at(change.duration) - change.way_at(left);
                let creeping = (time - self.braking_from()).clamp(0.0, self.braking() + self.creep);
                gone(self.braking, self.braking() - braked)
                    + self.stop.speed * creeping
                    + gone(self.stop, self.duration() - time)
            }
            Some(within) => {
                self.start.speed / 2.0 * (braked + within / PI * sin(PI * braked / within))
            }
        };
        self.direction * (self.start.way_at(time) + self.start.speed * uniform + of_braking)
    }

    /// Start of the braking or the jam, s from the start.
    fn braking_from(&self) -> f64 {
        self.uniform_motion().1
    }

    fn braking_until(&self) -> f64 {
        self.braking_from() + self.braking()
    }

    fn braking(&self) -> f64 {
        self.jam.unwrap_or(self.braking.duration)
    }

    /// From the end of the braking to the stand, s.
    fn landing(&self) -> f64 {
        self.creep + self.stop.duration
    }
}
