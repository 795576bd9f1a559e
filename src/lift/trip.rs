//! One trip: from rest over a distance to rest again, or to a jam.
//!
//! A commanded trip ends like its start, reversed in time. A cage that jams in uniform motion at speed v stops
//! within w seconds by a half-sine deceleration, a(t) = −(πv/2w) sin(πt/w), the shape used in shock tests:
//! v(t) = v (1 + cos(πt/w))/2, and the stopping distance is vw/2. At 1 m/s and 0.1 s the peak is 15.7 m/s².
//! The cage stays where it jammed.

use super::drive::{Drive, Start};
use crate::signal::Phase;
use libm::{cos, sin};
use std::f64::consts::PI;

/// A trip as asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trip {
    /// m, up positive.
    pub distance: f64,
    /// The limits of its motion.
    pub drive: Drive,
    /// How it ends.
    pub ending: Ending,
}

/// How a trip ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// By braking, at the distance asked for.
    Commanded,
    /// By a jam in uniform motion.
    Jam {
        /// Time of the jam, s from the start of the trip.
        after: f64,
        /// Stopping time, s.
        within: f64,
    },
}

/// Why a trip was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TripError {
    /// A zero or infinite distance.
    #[error("distance must be finite and not zero, got {0} (positive is up)")]
    Distance(f64),
    /// A limit of the drive, or the time of a jam, that is not positive.
    #[error("{name} must be positive and finite, got {value}")]
    NotPositive {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A jam of a trip without uniform motion.
    #[error(
        "jam: a trip of {distance} m never moves uniformly (lengthen it, or lower the drive's speed)"
    )]
    NeverUniform {
        /// m.
        distance: f64,
    },
    /// A jam outside the uniform motion.
    #[error(
        "jam.after must lie in the uniform motion, {from:.3} to {to:.3} s from the start, got {after}"
    )]
    JamOutside {
        /// s.
        after: f64,
        /// Start of the uniform motion, s.
        from: f64,
        /// Its end, s.
        to: f64,
    },
}

/// The motion of a trip at any time, in seconds from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    direction: f64,
    start: Start,
    /// Duration of the uniform motion, s.
    uniform: f64,
    /// Stopping time, s, if it ends in a jam.
    jam: Option<f64>,
}

impl Trip {
    /// Computes the motion.
    ///
    /// # Errors
    /// If the distance is zero, a limit is not positive, or the jam is not in uniform motion.
    pub fn course(&self) -> Result<Course, TripError> {
        let Drive {
            speed,
            acceleration,
            jerk,
        } = self.drive;
        if !(self.distance.is_finite() && self.distance != 0.0) {
            return Err(TripError::Distance(self.distance));
        }
        positive("speed", speed)?;
        positive("acceleration", acceleration)?;
        positive("jerk", jerk)?;
        let distance = self.distance.abs();
        let start = self.drive.start(distance);
        let course = Course {
            direction: self.distance.signum(),
            start,
            uniform: (distance / start.speed - start.duration).max(0.0),
            jam: None,
        };
        match self.ending {
            Ending::Commanded => Ok(course),
            Ending::Jam { after, within } => course.jammed(after, within, self.distance),
        }
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), TripError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(TripError::NotPositive { name, value })
    }
}

impl Course {
    fn jammed(self, after: f64, within: f64, distance: f64) -> Result<Self, TripError> {
        positive("jam.within", within)?;
        let (from, to) = self.uniform_motion();
        // If the drive just reaches its speed, rounding may leave a uniform motion of almost no duration.
        if self.uniform < 1e-9 {
            return Err(TripError::NeverUniform { distance });
        }
        if !(from..=to).contains(&after) {
            return Err(TripError::JamOutside { after, from, to });
        }
        Ok(Self {
            uniform: after - from,
            jam: Some(within),
            ..self
        })
    }

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

    /// The duration of the trip, s.
    pub fn duration(&self) -> f64 {
        self.braking_from() + self.braking()
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
        ];
        phases.into_iter().filter(|(_, duration)| *duration > 0.0)
    }

    /// The phase at `time`.
    pub fn phase_at(&self, time: f64) -> Phase {
        match time {
            _ if !(0.0..self.duration()).contains(&time) => Phase::Rest,
            _ if time < self.start.duration => Phase::Accelerating,
            _ if time < self.braking_from() => Phase::Inertial,
            _ => Phase::Braking,
        }
    }

    /// m/s², up positive.
    pub fn acceleration_at(&self, time: f64) -> f64 {
        let (braked, left) = (time - self.braking_from(), self.duration() - time);
        let size = match self.jam {
            _ if braked <= 0.0 => self.start.acceleration_at(time),
            None => -self.start.acceleration_at(left),
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
            None => self.start.speed_at(left),
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
            None => self.start.way_at(self.braking()) - self.start.way_at(self.braking() - braked),
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

    fn braking(&self) -> f64 {
        self.jam.unwrap_or(self.start.duration)
    }
}
