//! One trip: from rest over a distance to rest again, or to a jam.
//!
//! A commanded trip ends like its start, reversed in time, or by a braking with limits of its own and a creep of
//! speed c to the landing: then its highest speed v ≤ V is the largest for which start, braking and creep are
//! no longer than the trip, by bisection, since each grows with v. A trip too short to creep does without.
//!
//! A cage that jams in uniform motion at speed v stops
//! within w seconds by a half-sine deceleration, a(t) = −(πv/2w) sin(πt/w), the shape used in shock tests:
//! v(t) = v (1 + cos(πt/w))/2, and the stopping distance is vw/2. At 1 m/s and 0.1 s the peak is 15.7 m/s².
//! The cage stays where it jammed, or where an emergency brake has stopped it.

use super::course::Course;
use super::drive::Drive;
use crate::stats::bisect::bisect;

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
    /// The same with limits of its own.
    Braked(Braking),
    /// Half way through the uniform motion, by a deceleration of this size, m/s², that is reached within 0.1 s.
    Emergency(f64),
    /// By a jam in uniform motion.
    Jam {
        /// Time of the jam, s from the start of the trip.
        after: f64,
        /// Stopping time, s.
        within: f64,
    },
}

/// A braking that is not the start reversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    /// m/s².
    pub acceleration: f64,
    /// m/s³.
    pub jerk: f64,
    /// Speed of the creep to the landing, m/s; 0 for none.
    pub creep: f64,
    /// Its duration, s.
    pub seconds: f64,
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
            braking: start,
            creep: 0.0,
            stop: self.drive.start_to(0.0),
            jam: None,
        };
        match self.ending {
            Ending::Commanded => Ok(course),
            Ending::Braked(braking) => self.braked(braking),
            Ending::Emergency(deceleration) => stopped(course, deceleration),
            Ending::Jam { after, within } => jammed(course, after, within, self.distance),
        }
    }

    fn braked(&self, braking: Braking) -> Result<Course, TripError> {
        let limits = braking.limits()?;
        let (distance, full) = (self.distance.abs(), self.drive.speed);
        let with = |creep: f64, seconds, speed: f64| Course {
            direction: self.distance.signum(),
            start: self.drive.start_to(speed),
            uniform: 0.0,
            braking: limits.start_to(speed - creep),
            creep: seconds,
            stop: limits.start_to(creep),
            jam: None,
        };
        let fits = |course: Course| course.distance().abs() <= distance;
        let (creep, seconds) = (braking.creep.min(full), braking.seconds);
        let creeps = creep > 0.0 && seconds > 0.0 && fits(with(creep, seconds, creep));
        let (creep, seconds) = if creeps { (creep, seconds) } else { (0.0, 0.0) };
        let speed = if fits(with(creep, seconds, full)) {
            full
        } else {
            // Below the boundary, so that uniform motion fills what is left.
            let boundary = bisect(creep, full, |speed| fits(with(creep, seconds, speed)));
            (boundary * (1.0 - 2e-12)).max(creep)
        };
        let course = with(creep, seconds, speed);
        let uniform = (distance - course.distance().abs()) / speed;
        Ok(Course {
            uniform: uniform.max(0.0),
            ..course
        })
    }
}

impl Braking {
    fn limits(&self) -> Result<Drive, TripError> {
        positive("braking.acceleration", self.acceleration)?;
        positive("braking.jerk", self.jerk)?;
        Ok(Drive {
            speed: f64::INFINITY,
            acceleration: self.acceleration,
            jerk: self.jerk,
        })
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), TripError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(TripError::NotPositive { name, value })
    }
}

/// Stopped half way through the uniform motion, at once.
fn stopped(course: Course, deceleration: f64) -> Result<Course, TripError> {
    const WITHIN: f64 = 0.1;
    positive("deceleration", deceleration)?;
    let brake = Drive {
        speed: f64::INFINITY,
        acceleration: deceleration,
        jerk: deceleration / WITHIN,
    };
    Ok(Course {
        uniform: course.uniform / 2.0,
        braking: brake.start_to(course.start.speed),
        ..course
    })
}

fn jammed(course: Course, after: f64, within: f64, distance: f64) -> Result<Course, TripError> {
    positive("jam.within", within)?;
    let (from, to) = course.uniform_motion();
    // If the drive just reaches its speed, rounding may leave a uniform motion of almost no duration.
    if course.uniform < 1e-9 {
        return Err(TripError::NeverUniform { distance });
    }
    if !(from..=to).contains(&after) {
        return Err(TripError::JamOutside { after, from, to });
    }
    Ok(Course {
        uniform: after - from,
        jam: Some(within),
        ..course
    })
}
