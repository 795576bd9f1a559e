//! The monitor on constructed records.

use super::*;
use crate::detect::Statistics;
use crate::rng::Stream;
use crate::signal::{Phase, white_noise};
use crate::stats::binomial;
use crate::whiten::Order;

mod decisions;
mod running;
mod surroundings;
mod turns;

const RATE: f64 = 100.0;

/// A lift changes its acceleration in this time, s, and by no more than this, m/s²; what changes by more is a shock.
const RAMP: f64 = 0.3;
const MOST_RAMPED: f64 = 1.0;

/// A record built piece by piece.
#[derive(Clone)]
struct Record {
    samples: Vec<f64>,
    acceleration: f64,
    noise: Vec<f64>,
    sigma: f64,
}

impl Record {
    /// An empty record whose noise at rest has this standard deviation, m/s².
    fn new(sigma: f64, index: u64) -> Self {
        let mut generator = Stream::new(2014, "monitor tests", "").at(index);
        let noise = white_noise(400_000, &mut generator);
        Self {
            samples: Vec::new(),
            acceleration: 0.0,
            noise,
            sigma,
        }
    }

    fn quiet() -> Self {
        Self::new(0.01, 0)
    }

    /// Adds `seconds` of this acceleration, with `noise` times the noise at rest.
    fn with(self, seconds: f64, acceleration: f64, noise: f64) -> Self {
        let by = acceleration - self.acceleration;
        let ramp = if by.abs() > MOST_RAMPED { 0.0 } else { RAMP };
        self.changing(seconds, by, ramp, noise)
    }

    /// Adds `seconds` of an acceleration that first changes by so much, in this time, s.
    fn changing(mut self, seconds: f64, by: f64, ramp: f64, noise: f64) -> Self {
        for sample in 1..=(seconds * RATE).round() as usize {
            let share = (sample as f64 / RATE / ramp).min(1.0);
            let xi = self.noise[self.samples.len()];
            let acceleration = self.acceleration + share * by;
            self.samples.push(acceleration + noise * self.sigma * xi);
        }
        self.acceleration += by;
        self
    }

    fn rest(self, seconds: f64) -> Self {
        self.with(seconds, 0.0, 1.0)
    }

    /// Adds a trip at 1 m/s: 2 s of ±0.5 m/s², 8 s, 2 s.
    fn trip(self, sign: f64) -> Self {
        self.with(2.0, sign * 0.5, 1.0)
            .with(8.0, 0.0, 2.0)
            .with(2.0, -sign * 0.5, 1.0)
    }

    /// The same on a level of the sensor, with the noise of its motion, and a rest of 10 s.
    fn trip_on(self, level: f64, sign: f64, noise: f64) -> Self {
        self.with(2.0, level + sign * 0.5, 1.0)
            .with(8.0, level, noise)
            .with(2.0, level - sign * 0.5, 1.0)
            .with(10.0, level, 1.0)
    }

    fn now(&self) -> f64 {
        self.samples.len() as f64 / RATE
    }

    fn watch(&self, monitor: &mut Monitor) -> Vec<Event> {
        self.watch_with(monitor, |_| None)
    }

    /// With what is known of the drum at a time, s.
    fn watch_with(&self, monitor: &mut Monitor, drum: impl Fn(f64) -> Option<bool>) -> Vec<Event> {
        let sample = |(i, a): (usize, &f64)| Sample {
            time: i as f64 / RATE,
            acceleration: *a,
        };
        let samples = self.samples.iter().enumerate().map(sample);
        samples
            .flat_map(|sample| monitor.step(sample, drum(sample.time)).to_vec())
            .collect()
    }
}

fn design() -> Design {
    Settings::default().at(RATE).unwrap()
}

/// A monitor that knows that the cage stands at first.
fn standing() -> Monitor {
    Monitor::new(
        design(),
        Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        },
    )
}

fn states(events: &[Event]) -> Vec<State> {
    let change = |event: &Event| match event.kind {
        Kind::Change { state, .. } => Some(state),
        _ => None,
    };
    events.iter().filter_map(change).collect()
}

fn alarms(events: &[Event]) -> Vec<Alarm> {
    events
        .iter()
        .filter_map(|event| event.kind.alarm())
        .collect()
}

fn faults(events: &[Event]) -> Vec<Fault> {
    let fault = |event: &Event| match event.kind {
        Kind::Sensor(fault) => Some(fault),
        _ => None,
    };
    events.iter().filter_map(fault).collect()
}

/// The states that were known, each once in a row.
fn known(events: &[Event]) -> Vec<State> {
    let mut states = states(events);
    states.retain(|state| *state != State::Unknown);
    states.dedup();
    states
}

const REST: State = State::REST;
const ACCELERATING: State = State::Known(Phase::Accelerating);
const INERTIAL: State = State::Known(Phase::Inertial);
const BRAKING: State = State::Known(Phase::Braking);
const LEVELLING: State = State::Known(Phase::Levelling);
const RIDE: [State; 4] = [ACCELERATING, INERTIAL, BRAKING, REST];

#[test]
fn a_ride_is_followed_phase_by_phase() {
    for sign in [1.0, -1.0] {
        let record = Record::quiet().rest(8.0).trip(sign).rest(5.0);
        let events = record.watch(&mut standing());
        assert_eq!(known(&events), [[REST].as_slice(), &RIDE].concat());
        let told: Vec<&Event> = events
            .iter()
            .filter(|event| {
                !matches!(
                    event.kind,
                    Kind::Change {
                        state: State::Unknown,
                        ..
                    }
                )
            })
            .collect();
        for (event, time) in told[1..].iter().zip([8.0, 10.0 + RAMP, 18.0, 20.0 + RAMP]) {
            assert!((event.time - time).abs() <= 0.31, "{event:?}");
            assert!(
                (0.0..2.0).contains(&(event.reported - event.time)),
                "{event:?}"
            );
        }
        let Kind::Change {
            direction,
            speed,
            decision,
            ..
        } = told[1].kind
        else {
            panic!("{events:?}")
        };
        assert_eq!(direction, Some(Direction::of(sign)));
        assert!(decision.is_some() && speed.is_some());
    }
}

#[test]
fn without_knowledge_it_decides_within_two_trips() {
    let cold = || Monitor::new(design(), Knowledge::default());
    // Smooth motion, as quiet as rest: + − | − +
    let smooth = |record: Record, sign: f64| {
        record
            .with(2.0, 0.5 * sign, 1.0)
            .rest(8.0)
            .with(2.0, -0.5 * sign, 1.0)
            .rest(8.0)
    };
    let turning = smooth(smooth(Record::quiet().rest(8.0), 1.0), -1.0);
    let events = turning.watch(&mut cold());
    assert_eq!(known(&events).last(), Some(&REST), "{events:?}");
    // Switched on in motion: braking, start the other way, braking.
    let in_motion = Record::quiet()
        .rest(8.0)
        .with(2.0, -0.5, 1.0)
        .rest(8.0)
        .with(2.0, -0.5, 1.0)
        .rest(8.0)
        .with(2.0, 0.5, 1.0)
        .rest(8.0);
    let mut monitor = cold();
    let events = in_motion.watch(&mut monitor);
    let moves = [0.0..9.0, 19.0..29.0];
    for event in &events {
        let is_rest = states(&[*event]) == [REST];
        let is_wrong = moves.iter().any(|span| span.contains(&event.reported));
        assert!(!(is_rest && is_wrong), "{events:?}");
    }
    assert!(!monitor.state().moves());
}

#[test]
fn told_that_it_moves_it_waits_for_the_stop() {
    let mut monitor = Monitor::new(design(), Knowledge::default());
    monitor.begin_in_motion();
    let record = Record::quiet().rest(8.0).with(2.0, -0.5, 1.0).rest(8.0);
    let events = record.watch(&mut monitor);
    assert_eq!(known(&events).last(), Some(&REST), "{events:?}");
    let rest = events.iter().find(|event| states(&[**event]) == [REST]);
    assert!(rest.is_some_and(|rest| (rest.time - 10.0 - RAMP / 2.0).abs() < 0.3));
}

#[test]
fn what_is_quiet_for_longer_than_any_motion_is_rest() {
    let mut settings = Settings::default();
    settings.monitor.longest_motion = 30.0;
    let mut monitor = Monitor::new(settings.at(RATE).unwrap(), Knowledge::default());
    let events = Record::quiet().rest(45.0).watch(&mut monitor);
    assert_eq!(states(&events), [REST]);
    // A motion that never ends is given up, and not said to be rest.
    let mut monitor = Monitor::new(
        settings.at(RATE).unwrap(),
        Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        },
    );
    let record = Record::quiet()
        .rest(8.0)
        .with(2.0, 0.5, 1.0)
        .with(40.0, 0.0, 2.0);
    let events = record.watch(&mut monitor);
    assert_eq!(known(&events), [REST, ACCELERATING, INERTIAL]);
    assert_eq!(monitor.state(), State::Unknown);
    assert!((events[events.len() - 1].time - 38.0).abs() < 0.5);
}

#[test]
fn a_jam_is_an_alarm_unless_motion_goes_on() {
    let moving = || {
        Record::quiet()
            .rest(8.0)
            .with(2.0, 0.5, 1.0)
            .with(6.0, 0.0, 3.0)
    };
    let violent = |record: Record| record.with(0.1, -10.0, 1.0);
    let events = violent(moving()).rest(6.0).watch(&mut standing());
    assert_eq!(alarms(&events), [Alarm::Jam]);
    let alarm = events.iter().find(|event| event.kind.alarm().is_some());
    let alarm = alarm.unwrap();
    assert!((alarm.time - 16.0).abs() < 0.3, "{alarm:?}");
    assert!(alarm.reported - alarm.time < 1.6, "{alarm:?}");

    // A rail joint: a shock that swings back.
    let struck = violent(moving()).with(0.1, 10.0, 1.0);
    let struck = struck.with(6.0, 0.0, 3.0).with(2.0, -0.5, 1.0).rest(6.0);
    let events = struck.watch(&mut standing());
    assert_eq!(alarms(&events), []);
    assert_eq!(known(&events).last(), Some(&REST));
}

#[test]
fn a_creeping_cage_has_not_stopped() {
    let record = Record::quiet()
        .rest(8.0)
        .with(2.0, 0.5, 1.0)
        .with(6.0, 0.0, 2.0);
    // 1 m/s to 0.6, 3 s later to 0.
    let record = record
        .with(0.8, -0.5, 1.0)
        .with(3.0, 0.0, 2.0)
        .with(1.2, -0.5, 1.0);
    let stop = record.now();
    let events = record.rest(6.0).watch(&mut standing());
    let expected = [
        REST,
        ACCELERATING,
        INERTIAL,
        BRAKING,
        LEVELLING,
        BRAKING,
        REST,
    ];
    assert_eq!(known(&events), expected, "{events:?}");
    assert!((events[events.len() - 1].time - stop - RAMP / 2.0).abs() < 0.3);
}

/// A cage that slows down half-way, or creeps out of its floors, on every trip: it is never at rest for a second while it
/// moves, and is told to rest after some trip, unless it creeps out as softly as a level drifts.
#[test]
fn a_lift_in_stages_is_not_at_rest_in_motion() {
    let creeps = [0.25, 0.0, 0.75, 0.0, -0.75, 0.0, -0.25];
    let slows = [1.0, 0.0, -0.5, 0.0, 0.5, 0.0, -1.0];
    for (changes, lasts, is_told) in [
        (slows, 2.0, true),
        (creeps, 1.0, true),
        (creeps, 2.0, false),
    ] {
        let mut record = Record::new(0.02, 0).rest(10.0);
        let (mut speed, mut speeds, mut stops) = (0.0, vec![0.0; record.samples.len()], Vec::new());
        for sign in [1.0, -1.0, -1.0, 1.0, 1.0] {
            for change in changes {
                let seconds = if change == 0.0 { 6.0 } else { lasts };
                let acceleration = sign * change / seconds;
                record = record.with(seconds, acceleration, 1.0);
                for _ in 0..(seconds * RATE) as usize {
                    speed += acceleration / RATE;
                    speeds.push(speed);
                }
            }
            record = record.rest(10.0);
            speeds.resize(record.samples.len(), 0.0);
            stops.push(record.samples.len() - 100);
            speed = 0.0;
        }
        let (mut monitor, mut lasted, mut seen) = (standing(), 0, Vec::new());
        for (at, &acceleration) in record.samples.iter().enumerate() {
            let time = at as f64 / RATE;
            monitor.step(Sample { time, acceleration }, None);
            let is_wrong = monitor.state() == REST && f64::abs(speeds[at]) > 0.2;
            lasted = if is_wrong { lasted + 1 } else { 0 };
            assert!(f64::from(lasted) < RATE, "{changes:?}: rest at {time} s");
            if stops.contains(&at) {
                seen.push(monitor.state());
            }
        }
        assert!(!is_told || seen.contains(&REST), "{changes:?}: {seen:?}");
    }
}

#[test]
fn shocks_and_people_are_no_ride() {
    let mut record = Record::quiet().rest(8.0);
    for (i, strength) in [0.3, 1.0, 3.0, 8.0].into_iter().enumerate() {
        let noise = 1.0 + 3.0 * i as f64;
        record = record
            .with(0.1, strength, 1.0)
            .with(0.1, -strength, 1.0)
            .with(5.0, 0.0, noise);
    }
    let events = record.watch(&mut standing());
    assert_eq!(known(&events), [REST]);
}

/// A person pushes off, flies, lands: three pulses whose sum is zero.
#[test]
fn a_jump_is_no_ride() {
    let record = Record::quiet()
        .rest(8.0)
        .with(0.25, 1.2, 1.0)
        .with(0.3, -2.0, 1.0)
        .with(0.15, 2.0, 1.0)
        .rest(8.0);
    let mut monitor = standing();
    let events = record.watch(&mut monitor);
    assert_eq!(known(&events), [REST], "{events:?}");
    assert_eq!(monitor.state(), REST);
}

/// The level shifts for ten seconds, and for good: that may be a soft start, and is told neither rest nor a ride; a
/// trip decides it.
#[test]
fn a_shift_of_the_level_is_told_as_doubt() {
    for for_good in [false, true] {
        let back = if for_good { 0.07 } else { 0.0 };
        let record = Record::quiet()
            .rest(8.0)
            .with(10.0, 0.07, 1.0)
            .with(6.0, back, 1.0);
        let mut monitor = standing();
        let events = record.watch(&mut monitor);
        assert_eq!(known(&events), [REST], "{for_good}: {events:?}");
        assert_eq!(monitor.state(), State::Unknown, "{for_good}");
    }
}
