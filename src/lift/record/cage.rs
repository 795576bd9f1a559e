//! What the cage does and what is done to it, in order of time.

use super::class::{Class, Ranges};
use super::draws::Draws;
use super::pulse::{Pulse, Shape, jump};
use crate::lift::Journey;
use crate::lift::drive::{Drive, Start};
use crate::signal::recording::GRAVITY;
use libm::{ceil, cos};
use std::f64::consts::PI;

/// The height of a floor, m.
const FLOOR: f64 = 3.0;

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
    floors: usize,
}

/// The motion of a cage, from time 0 on.
pub(super) struct Cage {
    class: Class,
    pub lift: Lift,
    floor: usize,
    now: f64,
    /// Every change of its speed.
    pub motion: Vec<Pulse>,
    /// Everything else that the sensor feels.
    pub disturbances: Vec<Pulse>,
    pub journeys: Vec<Journey>,
    /// From when to when it rests, s.
    pub rests: Vec<(f64, f64)>,
    /// From when to when the drum turns, s.
    pub drum: Vec<(f64, f64)>,
    /// From when to when it turns although the cage stands, s.
    pub slack: Vec<(f64, f64)>,
}

impl Lift {
    fn draw(class: Class, ranges: &Ranges, draws: &mut Draws) -> Self {
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
}

impl Cage {
    pub fn draw(class: Class, ranges: &Ranges, draws: &mut Draws) -> Self {
        let mut cage = Self {
            class,
            lift: Lift::draw(class, ranges, draws),
            floor: 0,
            now: 0.0,
            motion: Vec::new(),
            disturbances: Vec::new(),
            journeys: Vec::new(),
            rests: Vec::new(),
            drum: Vec::new(),
            slack: Vec::new(),
        };
        cage.floor = draws.whole([0, cage.lift.floors]);
        let handled = class == Class::Handled;
        // The drum turns in the first rest, in the last, or after a jam.
        let drum = (class == Class::Drum).then(|| draws.whole([0, 2]));
        if handled {
            cage.handle(draws);
        }
        cage.rest(draws.within(ranges.first));
        if drum == Some(0) {
            cage.pay_out(draws);
        }
        let trips = draws.whole(ranges.trips);
        for trip in 1..=trips {
            cage.travel(draws, drum == Some(2) && trip == trips);
            cage.rest(draws.within(ranges.rest));
        }
        if drum == Some(1) {
            cage.pay_out(draws);
        }
        if handled {
            cage.handle(draws);
        }
        cage.disturb(draws);
        cage.walk(ranges, draws);
        cage
    }

    /// When all has happened, s.
    pub fn until(&self) -> f64 {
        self.now
    }

    /// m/s, up positive.
    pub fn speed_at(&self, time: f64) -> f64 {
        // Rounding leaves no speed at rest.
        let changes = self.motion.iter().filter(|change| change.from < time);
        let speed: f64 = changes.map(|change| change.speed_at(time)).sum();
        if speed.abs() < 1e-9 { 0.0 } else { speed }
    }

    fn rest(&mut self, seconds: f64) {
        self.rests.push((self.now, self.now + seconds));
        self.now += seconds;
    }

    /// To another floor.
    fn travel(&mut self, draws: &mut Draws, jams: bool) {
        let floors = self.lift.floors;
        let floor = match self.class {
            // Far enough to reach its speed.
            Class::Express if 2 * self.floor > floors => draws.whole([0, floors / 4]),
            Class::Express => draws.whole([3 * floors / 4, floors]),
            _ => {
                let others = draws.whole([0, floors - 1]);
                others + usize::from(others >= self.floor)
            }
        };
        let way = FLOOR * (floor as f64 - self.floor as f64);
        self.floor = floor;
        let jam = jams.then(|| draws.within([0.2, 0.8]));
        let journey = self.lift.trip(self.now, way, jam, &mut self.motion);
        self.now = journey.stop;
        self.drum.push((journey.start, journey.stop));
        if jams {
            let until = self.now + draws.within([4.0, 15.0]);
            self.drum.push((self.now, until));
            self.slack.push((self.now, until));
            self.rest(until - self.now);
        }
        self.journeys.push(journey);
    }

    /// A rest in which something disturbs, and then the drum turns.
    fn pay_out(&mut self, draws: &mut Draws) {
        let disturbances = [
            Class::LevelShift,
            Class::LevelStep,
            Class::Shocks,
            Class::Jumps,
            Class::Boarding,
        ];
        let disturbance = disturbances[draws.whole([0, disturbances.len() - 1])];
        self.rest(draws.within([1.0, 5.0]));
        self.add(disturbance, self.now, draws);
        self.rest(draws.within([0.5, 8.0]));
        let from = self.now;
        self.rest(draws.within([4.0, 15.0]));
        self.drum.push((from, self.now));
        self.slack.push((from, self.now));
        self.rest(draws.within([2.0, 5.0]));
    }

    /// Somebody handles the sensor: swings and tilts.
    fn handle(&mut self, draws: &mut Draws) {
        let until = self.now + draws.within([1.0, 4.0]);
        let mut tilt = self.now;
        while tilt < until {
            let seconds = draws.within([0.3, 1.0]).min(until - tilt);
            let offset = draws.within([-1.0, 0.3]);
            (self.disturbances).push(Pulse::new(tilt, Shape::Level { offset, seconds }));
            tilt += seconds;
        }
        while self.now < until {
            let seconds = draws.within([0.1, 0.5]).min(until - self.now);
            let peak = draws.sign() * draws.within([2.0, 8.0]);
            (self.disturbances).push(Pulse::new(self.now, Shape::Sine { peak, seconds }));
            self.now += seconds * draws.within([1.0, 1.5]);
        }
        self.now = self.now.max(until);
    }

    /// What the class is named after, where it is something that happens.
    fn disturb(&mut self, draws: &mut Draws) {
        let anywhere = [6.0, self.now];
        match self.class {
            Class::LevelShift | Class::LevelStep => {
                let from = draws.within(anywhere);
                self.add(self.class, from, draws);
            }
            Class::Shocks => {
                for _ in 0..draws.whole([1, 3]) {
                    let from = draws.within(anywhere);
                    self.add(self.class, from, draws);
                }
            }
            Class::Jumps | Class::Boarding => {
                for _ in 0..draws.whole([1, 3]) {
                    let (from, to) = self.rests[draws.whole([0, self.rests.len() - 1])];
                    let from = draws.within([from, (to - 1.0).max(from)]).max(6.0);
                    self.add(self.class, from, draws);
                }
            }
            Class::Tilt => {
                let Journey { start, stop, .. } =
                    self.journeys[draws.whole([0, self.journeys.len() - 1])];
                let from = draws.within([start, stop]);
                self.add(self.class, from, draws);
            }
            Class::Relevelling => self.relevel(draws),
            _ => {}
        }
    }

    /// One disturbance of a class.
    fn add(&mut self, class: Class, from: f64, draws: &mut Draws) {
        let mut push = |shape| self.disturbances.push(Pulse::new(from, shape));
        match class {
            Class::LevelShift => push(Shape::Level {
                offset: draws.sign() * draws.within([0.02, 0.1]),
                seconds: draws.within([3.0, 15.0]),
            }),
            Class::LevelStep => push(Shape::Level {
                offset: draws.sign() * draws.within([0.02, 0.1]),
                seconds: f64::INFINITY,
            }),
            Class::Shocks => push(Shape::HalfSine {
                peak: draws.sign() * draws.decades([2.0, 20.0]),
                seconds: draws.within([0.01, 0.08]),
            }),
            Class::Boarding => push(Shape::Bounce {
                depth: draws.sign() * draws.within([0.005, 0.03]),
                frequency: draws.within([0.5, 1.5]),
                damping: draws.within([0.03, 0.15]),
            }),
            Class::Tilt => {
                let angle = draws.within([2.0, 6.0]) * PI / 180.0;
                push(Shape::Level {
                    offset: -GRAVITY * (1.0 - cos(angle)),
                    seconds: f64::INFINITY,
                });
                push(Shape::Sine {
                    peak: draws.sign() * draws.within([0.3, 2.0]),
                    seconds: draws.within([0.2, 0.5]),
                });
            }
            Class::Jumps => {
                (self.disturbances).extend(jump(from, 0.3, draws.decades([0.05, 1.0])));
            }
            _ => {}
        }
    }

    /// Corrections at rest, one to a rest of 4 s or more.
    fn relevel(&mut self, draws: &mut Draws) {
        const SPEED: f64 = 0.05;
        let correction = Drive {
            speed: SPEED,
            acceleration: 0.4,
            jerk: 4.0,
        };
        let change = correction.start_to(SPEED);
        for &(from, to) in self.rests.iter().filter(|(from, to)| to - from >= 4.0) {
            let start = draws.within([from + 1.0, to - 2.5]);
            let until = start + draws.within([0.02, 0.05]) / SPEED;
            let sign = draws.sign();
            let shape = |sign| Shape::SpeedChange { change, sign };
            self.motion.push(Pulse::new(start, shape(sign)));
            self.motion.push(Pulse::new(until, shape(-sign)));
            self.drum.push((start, until + change.duration));
        }
    }

    /// People walk about at rest.
    fn walk(&mut self, ranges: &Ranges, draws: &mut Draws) {
        let footfalls = draws.within(ranges.footfalls).max(1e-3);
        for &(from, to) in &self.rests {
            let mut now = from + draws.gap(footfalls);
            while now < to {
                let shape = Shape::Sine {
                    peak: draws.sign() * draws.decades([0.03, 0.4]),
                    seconds: draws.within([0.06, 0.2]),
                };
                self.disturbances.push(Pulse::new(now, shape));
                now += draws.gap(footfalls);
            }
        }
    }
}

impl Lift {
    /// A trip over about `way` metres, up positive; a jam after a share of the uniform motion.
    fn trip(&self, start: f64, way: f64, jam: Option<f64>, motion: &mut Vec<Pulse>) -> Journey {
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
            motion.push(Pulse::new(from, Shape::SpeedChange { change, sign }));
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
