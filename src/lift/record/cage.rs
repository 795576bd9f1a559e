//! What the cage does and what is done to it, in order of time.

use super::class::{Class, Ranges};
use super::disturbance::{disturbance, handling};
use super::lift::{FLOOR, Lift};
use crate::lift::Journey;
use crate::lift::draws::Draws;
use crate::lift::drive::Drive;
use crate::lift::pulse::{Pulse, Shape, footfalls};

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
        let steps = draws.within(ranges.footfalls).max(1e-3);
        for &rest in &cage.rests {
            cage.disturbances.extend(footfalls(steps, rest, draws));
        }
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

    /// Somebody handles the sensor.
    fn handle(&mut self, draws: &mut Draws) {
        let until = self.now + draws.within([1.0, 4.0]);
        (self.disturbances).extend(handling(self.now, until, draws));
        self.now = until;
    }

    fn add(&mut self, class: Class, from: f64, draws: &mut Draws) {
        self.disturbances.extend(disturbance(class, from, draws));
    }

    /// What the class is named after, where it is something that happens to a cage.
    fn disturb(&mut self, draws: &mut Draws) {
        let class = self.class;
        let times = match class {
            Class::LevelShift
            | Class::LevelStep
            | Class::Tilt
            | Class::Turned
            | Class::TurnedAtStart => 1,
            Class::Held => draws.whole([1, 2]),
            Class::Shocks | Class::Jumps | Class::Boarding => draws.whole([1, 3]),
            Class::Relevelling => return self.relevel(draws),
            _ => 0,
        };
        for _ in 0..times {
            // The monitor may learn rest from the first seconds.
            let from = match class {
                Class::Jumps | Class::Boarding | Class::Turned | Class::Held => {
                    let (from, to) = self.rests[draws.whole([0, self.rests.len() - 1])];
                    let before = if class == Class::Held { 11.0 } else { 1.0 };
                    draws.within([from, (to - before).max(from)]).max(6.0)
                }
                Class::Tilt => {
                    let trip = self.journeys[draws.whole([0, self.journeys.len() - 1])];
                    draws.within([trip.start, trip.stop])
                }
                Class::TurnedAtStart => {
                    let trip = self.journeys[draws.whole([0, self.journeys.len() - 1])];
                    trip.start + draws.within([-0.5, 0.5])
                }
                _ => draws.within([6.0, self.now]),
            };
            self.add(class, from, draws);
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
            let pulse = |from, sign| Pulse {
                from,
                shape: Shape::SpeedChange { change, sign },
            };
            self.motion
                .extend([pulse(start, sign), pulse(until, -sign)]);
            self.drum.push((start, until + change.duration));
        }
    }
}
