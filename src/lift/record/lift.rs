//! A lift in its building, and its trips.

use super::class::{Class, Ranges};
use super::draws::Draws;
use super::pulse::{Pulse, Shape};
use crate::lift::Journey;
use crate::lift::drive::{Drive, Start};
use libm::ceil;

/// The height of a floor, m.
pub(super) const FLOOR: f64 = 3.0;

/// A lift in its building.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lift {
    pub drive: Drive,
    braking: Drive,
    /// Speed, m/s, and time, s, of the levelling.
    levelling: (f64, f64),
    /// The limits of its last stop.
    stop: Drive,
    /// The highest floor.
    pub floors: usize,
}

impl Lift {
    pub fn draw(class: Class, ranges: &Ranges, draws: &mut Draws) -> Self {
        let drive = Drive {
            speed: draws.decades(ranges.speed),
            acceleration: draws.within(ranges.acceleration),
            jerk: draws.within(ranges.jerk),
        };
        let braking = Drive {
            acceleration: drive.acceleration * draws.within(ranges.braking),
            ..drive
        };
        let most = ceil((12.0 * drive.speed).max(2.0)) as usize;
        Self {
            drive,
            braking,
            levelling: (
                draws.within(ranges.levelling),
                draws.within(ranges.levelling_time),
            ),
            stop: Drive {
                acceleration: draws.within([0.2, 0.6]),
                jerk: draws.within([1.0, 4.0]),
                ..drive
            },
            floors: match class {
                Class::Express => most,
                _ => draws.whole([1, most]),
            },
        }
    }

    /// A trip over about `way` metres, up positive; a jam after a share of the uniform motion.
    pub fn trip(&self, start: f64, way: f64, jam: Option<f64>, motion: &mut Vec<Pulse>) -> Journey {
        let Self {
            drive,
            braking,
            stop,
            ..
        } = self;
        let sign = way.signum();
        let slower = if drive.acceleration < braking.acceleration {
            drive
        } else {
            braking
        };
        let speed = slower.start(way.abs()).speed;
        let slow = self.levelling.0.min(speed / 2.0);
        let up = drive.start_to(speed);
        let (down, slow, levels) = match jam {
            Some(_) => (jammed(speed), 0.0, 0.0),
            None => (braking.start_to(speed - slow), slow, self.levelling.1),
        };
        let last = stop.start_to(slow);
        // Each change of speed is symmetric, so its mean speed is that between its ends.
        let mut distance =
            (up.duration * speed + down.duration * (speed + slow) + last.duration * slow) / 2.0
                + slow * levels;
        let uniform = ((way.abs() - distance) / speed).max(0.0) * jam.unwrap_or(1.0);
        distance += uniform * speed;
        let begins = start + up.duration;
        let brakes = begins + uniform;
        let braked = brakes + down.duration;
        let is_levelled = slow > 0.0;
        let mut change = |from, change, sign| {
            let shape = Shape::SpeedChange { change, sign };
            motion.push(Pulse { from, shape });
        };
        change(start, up, sign);
        change(brakes, down, -sign);
        if is_levelled {
            change(braked + levels, last, -sign);
        }
        Journey {
            start,
            uniform: begins,
            braking: brakes,
            levelling: is_levelled.then_some(braked),
            stop: braked
                + if is_levelled {
                    levels + last.duration
                } else {
                    0.0
                },
            direction: sign as i8,
            distance: sign * distance,
            speed,
            jammed: jam.is_some(),
        }
    }
}

/// From a speed to a stand within 0.1 s.
fn jammed(speed: f64) -> Start {
    const WITHIN: f64 = 0.1;
    let drive = Drive {
        speed,
        acceleration: 2.0 * speed / WITHIN,
        jerk: 4.0 * speed / (WITHIN * WITHIN),
    };
    drive.start_to(speed)
}
