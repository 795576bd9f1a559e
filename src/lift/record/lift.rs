//! A lift in its building, and its trips.

use super::class::{Class, Ranges};
use crate::lift::Journey;
use crate::lift::draws::Draws;
use crate::lift::drive::{Drive, Start};
use crate::lift::pulse::{Pulse, Shape};
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
    habit: Habit,
    /// The highest floor.
    pub floors: usize,
}

/// With a slow zone, a trip has so much uniform motion beside, s.
const SHORTEST: f64 = 2.0;

/// What it does on every trip beside one start and one braking.
#[derive(Clone, Copy, Debug)]
enum Habit {
    None,
    /// It leaves every floor at this speed, m/s, for so long, s.
    CreepsOut {
        speed: f64,
        /// m/s².
        acceleration: f64,
        seconds: f64,
    },
    /// Half-way it has this share of its speed for so long, s.
    SlowZone {
        share: f64,
        seconds: f64,
    },
}

/// A change of speed, and how long the cage then keeps the new one.
#[derive(Clone, Copy, Debug)]
struct Stage {
    change: Start,
    /// The speeds before and after, m/s.
    from: f64,
    to: f64,
    /// Its share of the uniform motion, and what it lasts beside, s.
    share: f64,
    seconds: f64,
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
        let levelling = (
            draws.within(ranges.levelling),
            draws.within(ranges.levelling_time),
        );
        Self {
            drive,
            braking,
            levelling,
            stop: Drive {
                acceleration: draws.within([0.2, 0.6]),
                jerk: draws.within([1.0, 4.0]),
                ..drive
            },
            floors: match class {
                Class::Express | Class::SlowZone => most,
                _ => draws.whole([1, most]),
            },
            habit: match class {
                Class::TwoStage => Habit::CreepsOut {
                    speed: levelling.0,
                    acceleration: draws.within([0.1, 0.6]),
                    seconds: draws.within([2.0, 8.0]),
                },
                Class::SlowZone => Habit::SlowZone {
                    share: draws.within([0.3, 0.6]),
                    seconds: draws.within([3.0, 10.0]),
                },
                _ => Habit::None,
            },
        }
    }

    /// A trip over about `way` metres, up positive; a jam after a share of the uniform motion.
    pub fn trip(&self, start: f64, way: f64, jam: Option<f64>, motion: &mut Vec<Pulse>) -> Journey {
        let sign = way.signum();
        let slower = if self.drive.acceleration < self.braking.acceleration {
            self.drive
        } else {
            self.braking
        };
        let speed = slower.start(way.abs()).speed;
        let stops = self.stops(speed, jam.is_some());
        let mut starts = self.starts(speed, self.habit);
        if way.abs() < covered(&starts) + covered(&stops) + SHORTEST * speed {
            starts = self.starts(speed, self.habit.of_short_trips());
        }
        let stages = starts.iter().chain(&stops);
        let mut distance = covered(&starts) + covered(&stops);
        let uniform = ((way.abs() - distance) / speed).max(0.0) * jam.unwrap_or(1.0);
        distance += uniform * speed;
        let mut now = start;
        // When each change begins and ends.
        let changes: Vec<(f64, f64)> = stages
            .map(|stage| {
                let sign = if stage.to > stage.from { sign } else { -sign };
                let change = stage.change;
                let shape = Shape::SpeedChange { change, sign };
                motion.push(Pulse { from: now, shape });
                let (began, changed) = (now, now + change.duration);
                now = changed + stage.share * uniform + stage.seconds;
                (began, changed)
            })
            .collect();
        let (braking, braked) = changes[starts.len()];
        let stop = changes[changes.len() - 1].1;
        Journey {
            start,
            uniform: changes[starts.len() - 1].1,
            braking,
            levelling: (stop > braked).then_some(braked),
            stop,
            direction: sign as i8,
            distance: sign * distance,
            speed,
            jammed: jam.is_some(),
        }
    }

    /// From rest to a speed.
    fn starts(&self, speed: f64, habit: Habit) -> Vec<Stage> {
        let up = |from, share| Stage::new(&self.drive, (from, speed), share, 0.0);
        match habit {
            Habit::None => vec![up(0.0, 1.0)],
            Habit::CreepsOut {
                speed: creep,
                acceleration,
                seconds,
            } => {
                let gently = Drive {
                    acceleration,
                    ..self.drive
                };
                let creep = creep.min(speed / 2.0);
                let out = Stage::new(&gently, (0.0, creep), 0.0, seconds);
                vec![out, up(creep, 1.0)]
            }
            Habit::SlowZone { share, seconds } => {
                let slow = share * speed;
                let down = Stage::new(&self.braking, (speed, slow), 0.0, seconds);
                vec![up(0.0, 0.5), down, up(slow, 0.5)]
            }
        }
    }

    /// From a speed to rest.
    fn stops(&self, speed: f64, jams: bool) -> Vec<Stage> {
        if jams {
            let change = jammed(speed);
            return vec![Stage {
                change,
                ..Stage::new(&self.braking, (speed, 0.0), 0.0, 0.0)
            }];
        }
        let (slow, seconds) = self.levelling;
        if slow == 0.0 {
            return vec![Stage::new(&self.braking, (speed, 0.0), 0.0, 0.0)];
        }
        let slow = slow.min(speed / 2.0);
        let down = Stage::new(&self.braking, (speed, slow), 0.0, seconds);
        vec![down, Stage::new(&self.stop, (slow, 0.0), 0.0, 0.0)]
    }
}

impl Habit {
    /// A short trip does not pass the zone.
    fn of_short_trips(self) -> Self {
        match self {
            Self::SlowZone { .. } => Self::None,
            other => other,
        }
    }
}

/// How far the cage goes in stages, but for its uniform motion, m. Each change of speed is symmetric, so its mean speed is
/// that between its ends.
fn covered(stages: &[Stage]) -> f64 {
    let of_change = |stage: &Stage| stage.change.duration * (stage.from + stage.to);
    let of_changes: f64 = stages.iter().map(of_change).sum();
    let kept: f64 = stages.iter().map(|stage| stage.seconds * stage.to).sum();
    of_changes / 2.0 + kept
}

impl Stage {
    fn new(drive: &Drive, (from, to): (f64, f64), share: f64, seconds: f64) -> Self {
        let change = drive.start_to((to - from).abs());
        Self {
            change,
            from,
            to,
            share,
            seconds,
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
