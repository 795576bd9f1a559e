//! One explanation of a record as trips: when each starts, levels and stops.

use super::lattice::Part;
use super::pulse::Pulse;
use super::record::Record;
use super::trips::Motion;
use std::ops::Range;

/// The speed at which a motion counts as begun, m/s.
const MOVING: f64 = 0.01;

/// Trips and everything else, in order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The trips.
    pub trips: Vec<Trip>,
    /// Pulses that are no motion: the first to the last of each event.
    pub others: Vec<Range<usize>>,
}

/// A trip, as far as the record shows it. Times in s; what lies outside the record or in a hole is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Trip {
    /// Whether it goes up.
    pub is_up: bool,
    /// When the cage begins to move.
    pub start: Option<f64>,
    /// When it has reached its speed.
    pub inertial: Option<f64>,
    /// When it begins to brake.
    pub braking: Option<f64>,
    /// When it has braked to the speed at which it creeps to the landing, if it does.
    pub levelling: Option<f64>,
    /// When it stands.
    pub stop: Option<f64>,
    /// The highest speed, m/s.
    pub speed: f64,
    /// The speed that the changes leave at its end, m/s, up positive.
    pub closing: f64,
    /// Whether a shock ends it.
    pub is_jam: bool,
    /// The pulses from the first to the last.
    pub pulses: Range<usize>,
    /// Those that change its speed.
    pub changes: Vec<usize>,
}

impl Reading {
    /// Puts the parts of an explanation together.
    pub fn of(record: &Record, parts: &[&Part]) -> Self {
        let mut reading = Self::default();
        // Whether the latest trip goes on across the hole after it.
        let (mut goes_on, mut is_joined) = (false, false);
        for part in parts {
            match part {
                Part::Hole { moves_on } => is_joined = goes_on && *moves_on,
                Part::Other(pulses) => {
                    reading.others.push(pulses.clone());
                    goes_on = false;
                }
                Part::Through(pulses) => {
                    reading
                        .others
                        .extend(pulses.clone().map(|pulse| pulse..pulse + 1));
                    goes_on = is_joined;
                }
                Part::Motion(motion) => {
                    let unused = motion
                        .pulses
                        .clone()
                        .filter(|pulse| !motion.changes.contains(pulse));
                    reading.others.extend(unused.map(|pulse| pulse..pulse + 1));
                    let mut trips = record.trips(motion).into_iter();
                    if let Some(last) = reading.trips.last_mut().filter(|_| is_joined) {
                        trips.next().into_iter().for_each(|trip| last.join(trip));
                    }
                    reading.trips.extend(trips);
                    (goes_on, is_joined) = (motion.is_open.1, false);
                }
            }
        }
        reading
    }
}

/// Ends of trips that lie nearer than this are the same, s.
const SAME: f64 = 0.5;

/// Whether two ends of trips are the same, or both unknown.
pub fn is_near(one: Option<f64>, other: Option<f64>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => (one - other).abs() < SAME,
        (None, None) => true,
        _ => false,
    }
}

impl Trip {
    /// Whether two trips differ at most in one of their ends.
    pub fn is_like(&self, other: &Self) -> bool {
        let is_near = is_near(self.start, other.start) || is_near(self.stop, other.stop);
        self.is_up == other.is_up && is_near
    }

    /// Adds what follows a hole.
    fn join(&mut self, later: Self) {
        self.speed = self.speed.max(later.speed);
        self.braking = later.braking;
        self.levelling = later.levelling;
        self.stop = later.stop;
        self.closing = 0.0;
        self.is_jam = later.is_jam;
        self.pulses.end = later.pulses.end;
        self.changes.extend(later.changes);
    }
}

/// Speeds of both signs beyond this share of the highest are two trips.
const TURN: f64 = 0.2;

/// A pulse at an end of the record is cut off there if in the outermost seconds it has more than this share of its mean
/// acceleration: it does not rise or fall.
const OUTERMOST: f64 = 0.3;
const STRONG: f64 = 0.7;

/// The share of the highest speed at which a motion counts as uniform; below it, it levels.
const FAST: f64 = 0.6;

impl Record {
    /// The trips of a motion: two where it goes through zero speed, since it stops there, however briefly.
    fn trips(&self, motion: &Motion) -> Vec<Trip> {
        let before = if motion.is_open.0 { motion.speed } else { 0.0 };
        let speeds = self.speeds(motion, before);
        let top = speeds.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
        let turns =
            |pair: &[f64]| pair[0] * pair[1] < 0.0 && pair[0].abs().min(pair[1].abs()) > TURN * top;
        let Some(turn) = speeds
            .windows(2)
            .position(turns)
            .filter(|turn| turn + 1 < motion.changes.len())
        else {
            return vec![self.trip(motion, before)];
        };
        let pulse = motion.changes[turn];
        let part = |changes: &[usize],
                    is_open: (bool, bool),
                    pulses: Range<usize>,
                    top: f64,
                    speed: f64| Motion {
            changes: changes.to_vec(),
            is_open,
            pulses,
            top,
            speed,
            ..motion.clone()
        };
        let first = part(
            &motion.changes[..=turn],
            (motion.is_open.0, false),
            motion.pulses.start..pulse + 1,
            speeds[turn],
            motion.speed,
        );
        let second = part(
            &motion.changes[turn..],
            (false, motion.is_open.1),
            pulse..motion.pulses.end,
            speeds[turn + 1],
            motion.speed,
        );
        let next = &self.pulses[motion.changes[turn + 1]];
        let time = self.zero_of(&self.pulses[pulse], speeds[turn]);
        let time = time.min(next.from);
        let (mut first, mut second) = (self.trip(&first, before), self.trip(&second, speeds[turn]));
        (first.stop, second.start) = (Some(time), Some(time));
        vec![first, second]
    }

    /// When the speed, before a pulse so much, is zero in it.
    fn zero_of(&self, pulse: &Pulse, before: f64) -> f64 {
        let mut speed = before;
        for block in pulse.blocks.clone() {
            speed += self.change_by(pulse, block..block + 1);
            if speed * before <= 0.0 {
                return self.cut.blocks[block].to;
            }
        }
        pulse.to
    }

    /// The trip of a motion that has the speed `before` at first; what has another sign than its own does not count.
    fn trip(&self, motion: &Motion, before: f64) -> Trip {
        let mut speeds = self.speeds(motion, before);
        speeds
            .iter_mut()
            .filter(|speed| **speed * motion.top < 0.0)
            .for_each(|speed| *speed = 0.0);
        // speeds[i] is the speed before change i.
        let top = speeds.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
        let is_fast = |speed: &f64| speed.abs() >= FAST * top;
        let fast = speeds.iter().position(is_fast).unwrap_or(0);
        let after = |place: usize| speeds.iter().skip(place).position(|speed| !is_fast(speed));
        let slow = after(fast).map(|count| fast + count);
        let change = |place: usize| &self.pulses[motion.changes[place]];
        // A shift of the level may go on beside other changes, which end what it began.
        let end = |place: usize| {
            let next = (place + 1 < motion.changes.len()).then(|| change(place + 1).from);
            change(place).to.min(next.unwrap_or(f64::INFINITY))
        };
        let (first, last) = (change(0), change(motion.changes.len() - 1));
        let levels = slow.filter(|place| motion.is_open.1 || *place < motion.changes.len());
        Trip {
            is_up: motion.top > 0.0,
            start: (!motion.is_open.0 && !self.is_cut_off(first, first.blocks.start, top))
                .then(|| self.leaves_zero(first).min(end(0))),
            inertial: fast.checked_sub(1).map(end),
            braking: slow.map(|place| change(place - 1).from),
            levelling: levels.map(|place| end(place - 1)),
            stop: (!motion.is_open.1 && !self.is_cut_off(last, last.blocks.end, top))
                .then(|| self.reaches_zero(last)),
            speed: top,
            closing: motion.speed,
            is_jam: !motion.is_open.1 && last.is_violent,
            pulses: motion.pulses.clone(),
            changes: motion.changes.clone(),
        }
    }

    /// The speeds before each change, and after the last, m/s.
    fn speeds(&self, motion: &Motion, before: f64) -> Vec<f64> {
        let mut speed = before;
        let mut speeds = vec![speed];
        speeds.extend(motion.changes.iter().map(|pulse| {
            speed += self.pulses[*pulse].change;
            speed
        }));
        speeds
    }

    /// Whether a pulse is cut off at this end of its blocks: by a hole, or by an end of the record at which it is
    /// strong, if it changes a good part of the highest speed.
    fn is_cut_off(&self, pulse: &Pulse, block: usize, top: f64) -> bool {
        let cut = &self.cut;
        let reach = cut.blocks_in(OUTERMOST);
        let outermost = if block == 0 {
            0..reach.min(pulse.blocks.end)
        } else if block == cut.blocks.len() {
            block.saturating_sub(reach).max(pulse.blocks.start)..block
        } else {
            return cut.ends.contains(&block);
        };
        let seconds = outermost.len() as f64 * cut.seconds;
        let strength = self.change_by(pulse, outermost) / seconds;
        let is_stage = pulse.change.abs() > TURN * top;
        is_stage
            && strength * pulse.change.signum()
                > STRONG * pulse.change.abs() / (pulse.to - pulse.from)
    }

    /// When a pulse begins to move the cage.
    fn leaves_zero(&self, pulse: &Pulse) -> f64 {
        let block = self.first_moving(pulse, pulse.blocks.clone());
        self.cut.blocks[block].from
    }

    /// When a pulse has brought it to rest.
    fn reaches_zero(&self, pulse: &Pulse) -> f64 {
        let block = self.first_moving(pulse, pulse.blocks.clone().rev());
        self.cut.blocks[block].to
    }

    /// The block at which the change of speed exceeds what noise and the level's error may add up to.
    fn first_moving(&self, pulse: &Pulse, blocks: impl Iterator<Item = usize>) -> usize {
        let (mut speed, mut seconds, mut last) = (0.0f64, 0.0, pulse.blocks.start);
        for block in blocks {
            last = block;
            speed += self.change_by(pulse, block..block + 1);
            seconds += self.cut.blocks[block].seconds;
            let noise = 2.0 * pulse.deviation * seconds / (pulse.to - pulse.from);
            if speed.abs() > MOVING + noise {
                break;
            }
        }
        last
    }
}
