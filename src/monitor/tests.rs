//! The monitor on constructed records.

use super::*;
use crate::detect::Statistics;
use crate::rng::Stream;
use crate::signal::{Law, Noise, Phase};
use crate::stats::binomial;
use crate::whiten::Order;

const RATE: f64 = 100.0;

/// A record built piece by piece.
struct Record {
    samples: Vec<f64>,
    noise: Vec<f64>,
    sigma: f64,
}

impl Record {
    /// An empty record whose noise at rest has this standard deviation, m/s².
    fn new(sigma: f64, index: u64) -> Self {
        let mut noise = vec![0.0; 400_000];
        let mut generator = Stream::new(2014, "monitor tests", "").at(index);
        Noise::new(Law::Normal)
            .unwrap()
            .fill(&mut generator, &mut noise);
        Self {
            samples: Vec::new(),
            noise,
            sigma,
        }
    }

    fn quiet() -> Self {
        Self::new(0.01, 0)
    }

    /// Adds `seconds` of this acceleration, with `noise` times the noise at rest.
    fn with(mut self, seconds: f64, acceleration: f64, noise: f64) -> Self {
        for _ in 0..(seconds * RATE).round() as usize {
            let xi = self.noise[self.samples.len()];
            self.samples.push(acceleration + noise * self.sigma * xi);
        }
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

    fn now(&self) -> f64 {
        self.samples.len() as f64 / RATE
    }

    fn watch(&self, monitor: &mut Monitor) -> Vec<Event> {
        let sample = |(i, a): (usize, &f64)| Sample {
            time: i as f64 / RATE,
            acceleration: *a,
        };
        let samples = self.samples.iter().enumerate().map(sample);
        samples
            .flat_map(|sample| monitor.step(sample, None).to_vec())
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
        for (event, time) in told[1..].iter().zip([8.0, 10.0, 18.0, 20.0]) {
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

/// W and T of every decision against a recount from the record at the stated times: means of five, no
/// filter, ranks by sorting.
#[test]
fn decisions_are_those_of_a_recount() {
    let mut settings = Settings::default();
    settings.whitening.order = Order::Fixed(0);
    let record = Record::quiet()
        .rest(8.0)
        .trip(1.0)
        .rest(7.0)
        .trip(-1.0)
        .rest(5.0);
    let mut monitor = Monitor::new(
        settings.at(RATE).unwrap(),
        Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        },
    );
    let blocks: Vec<f64> = record
        .samples
        .chunks_exact(5)
        .map(|c| c.iter().sum::<f64>() / 5.0)
        .collect();
    let at = |(from, to): (f64, f64)| {
        blocks[(from * 20.0).round() as usize..(to * 20.0).ceil() as usize].to_vec()
    };
    let events = record.watch(&mut monitor);
    let mut counted = 0;
    for event in events {
        let Kind::Change {
            decision: Some(decision),
            ..
        } = event.kind
        else {
            continue;
        };
        let x = at(decision.reference.unwrap());
        let [y1, y2] = [decision.shift, decision.scale].map(at);
        // X is the end of the record that the reference was learnt from.
        let x = x[x.len() - 24..].to_vec();
        assert_eq!([x.len(), y1.len(), y2.len()], [24, 12, 12]);
        let others = || x.iter().chain(&y2);
        let won = y1
            .iter()
            .map(|y| others().filter(|other| y > other).count() as u64);
        let [low, high] = [f64::min, f64::max].map(|f| x.iter().copied().reduce(f).unwrap());
        let naive = Statistics {
            rank_sum: 78 + won.sum::<u64>(),
            exceedances: y2.iter().filter(|y| **y < low || **y > high).count(),
        };
        let statistics = (decision.rank_sum, decision.exceedances);
        let expected = (naive.rank_sum, naive.exceedances);
        assert_eq!(statistics, expected, "{event:?}");
        let Decision { lower, upper, .. } = decision;
        let moves = lower.is_some_and(|w| naive.rank_sum <= w)
            || upper.is_some_and(|w| naive.rank_sum >= w);
        assert!(moves, "{decision:?}");
        counted += 1;
    }
    assert_eq!(counted, 4);
}

/// One decision of each of 40 000 monitors on white noise, with X and a filter of order 0 from the noise
/// before: its level is exact. Two-sided test at 1e-6.
#[test]
fn a_decision_at_rest_has_its_exact_size() {
    let mut settings = Settings::default();
    settings.whitening.order = Order::Fixed(0);
    settings.detector.alpha = 0.01;
    let design = settings.at(20.0).unwrap();
    let trials = 40_000;
    let mut alarms = 0;
    let normal = Noise::new(Law::Normal).unwrap();
    let stream = Stream::new(2014, "monitor size", "");
    let mut blocks = vec![0.0; 24 + 24 + 24];
    for trial in 0..trials {
        normal.fill(&mut stream.at(trial), &mut blocks);
        let reference = Reference::from_rest(&blocks[..48], (0.0, 0.0), &design);
        let mut monitor = Monitor::new(
            design.clone(),
            Knowledge {
                reference: Some(reference),
                ..Knowledge::default()
            },
        );
        for (i, acceleration) in blocks[48..].iter().enumerate() {
            let sample = Sample {
                time: i as f64 * 0.05,
                acceleration: *acceleration,
            };
            monitor.step(sample, None);
        }
        alarms += u64::from(monitor.newest().unwrap().moves.unwrap());
    }
    let size = design.region.size();
    let tail =
        binomial::lower_tail(alarms, trials, size).min(binomial::upper_tail(alarms, trials, size));
    println!("{alarms} of {trials} at exact size {size}: smaller tail {tail:.3e}");
    assert!(tail > 5e-7);
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
    assert!(rest.is_some_and(|rest| (rest.time - 10.0).abs() < 0.3));
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
    assert!((events[events.len() - 1].time - stop).abs() < 0.3);
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

#[test]
fn a_gap_makes_the_state_unknown() {
    let record = Record::quiet()
        .rest(8.0)
        .with(2.0, 0.5, 1.0)
        .with(4.0, 0.0, 2.0);
    let mut monitor = standing();
    let before = record.watch(&mut monitor);
    assert_eq!(known(&before), [REST, ACCELERATING, INERTIAL]);
    let time = record.now() + 10.0;
    let sample = Sample {
        time,
        acceleration: 0.0,
    };
    let after = monitor.step(sample, None);
    assert_eq!(faults(after), [Fault::Silent]);
    assert_eq!(states(after), [State::Unknown]);
    assert_eq!(after[1].time, time);
}

/// What each fault is told of, and that the state is unknown while it lasts.
#[test]
fn faults_of_the_sensor_are_told() {
    let rest = || Record::quiet().rest(10.0);
    let told = |record: Record| {
        let mut monitor = standing();
        let events = record.watch(&mut monitor);
        (faults(&events), monitor.state())
    };
    let unknown = State::Unknown;
    assert_eq!(
        told(rest().with(3.0, 0.003, 0.0)),
        (vec![Fault::Stuck], unknown)
    );
    assert_eq!(
        told(rest().with(0.5, 19.6, 0.0)),
        (vec![Fault::Saturated], unknown)
    );
    assert_eq!(told(rest().with(30.0, 0.0, 200.0)).0, [Fault::Noisy]);
}

/// One stamp far ahead, and the way back: two holes, and the next trips are seen.
#[test]
fn a_clock_that_is_set_back_costs_a_gap() {
    let record = Record::quiet()
        .rest(8.0)
        .trip(1.0)
        .rest(6.0)
        .trip(-1.0)
        .rest(6.0);
    let mut monitor = standing();
    let mut events = Vec::new();
    for (i, acceleration) in record.samples.iter().enumerate() {
        let time = if i == 600 { 1e6 } else { i as f64 / RATE };
        let sample = Sample {
            time,
            acceleration: *acceleration,
        };
        events.extend_from_slice(monitor.step(sample, None));
    }
    assert_eq!(faults(&events), [Fault::Silent, Fault::Clock]);
    assert_eq!(known(&events).last(), Some(&REST), "{events:?}");
}

#[test]
fn a_drum_that_turns_without_the_cage_is_an_alarm() {
    let record = Record::quiet().rest(8.0).trip(-1.0).rest(20.0);
    let mut monitor = standing();
    let turns = |time: f64| (8.0..20.2).contains(&time) || (30.0..36.0).contains(&time);
    let mut events = Vec::new();
    for (i, a) in record.samples.iter().enumerate() {
        let time = i as f64 / RATE;
        let sample = Sample {
            time,
            acceleration: *a,
        };
        events.extend_from_slice(monitor.step(sample, Some(turns(time))));
    }
    assert_eq!(alarms(&events), [Alarm::Slack]);
    let alarm = events
        .iter()
        .find(|event| event.kind.alarm().is_some())
        .unwrap();
    assert!(
        (alarm.time - 30.0).abs() < 0.1 && (alarm.reported - 33.0).abs() < 0.1,
        "{alarm:?}"
    );
}

/// The reference follows an offset that drifts by three times the weakest acceleration, 0.09 m/s² a minute.
#[test]
fn every_rest_is_learnt_anew() {
    let mut record = Record::quiet();
    for step in 0..2000 {
        record = record.with(0.1, 0.3 * f64::from(step) / 2000.0, 1.0);
    }
    let mut monitor = standing();
    let events = record.watch(&mut monitor);
    assert_eq!(states(&events), [REST]);
    let reference = monitor.reference().unwrap();
    assert!(reference.span.unwrap().1 > record.now() - 12.0);
    assert!((reference.level - 0.3).abs() < 0.05, "{}", reference.level);
}

#[test]
fn a_saved_state_is_read_back_unchanged() {
    let mut monitor = standing();
    Record::quiet().rest(12.0).watch(&mut monitor);
    let saved = SavedState {
        settings: Settings::default(),
        rate: RATE,
        first_sample: None,
        knowledge: Knowledge {
            reference: monitor.reference().cloned(),
            begins_at_rest: true,
            motion_shows: false,
        },
    };
    let read: SavedState = serde_json::from_str(&saved.to_json()).unwrap();
    assert_eq!(read, saved);
}

/// Equal values have no ranks of their own, so random keys decide: decisions for motion are no more frequent
/// than the exact size, and W stays within its range.
#[test]
fn a_constant_record_is_decided_by_keys() {
    let design = design();
    let reference = Reference::from_rest(&[9.81; 48], (0.0, 0.0), &design);
    let mut monitor = Monitor::new(
        design,
        Knowledge {
            reference: Some(reference),
            begins_at_rest: true,
            motion_shows: false,
        },
    );
    let (mut moves, mut decisions) = (0u64, 0u64);
    for i in 0..200_000 {
        let sample = Sample {
            time: f64::from(i) / RATE,
            acceleration: 9.81,
        };
        monitor.step(sample, None);
        if let Some(moved) = monitor.newest().and_then(|block| block.moves) {
            (moves, decisions) = (moves + u64::from(moved), decisions + 1);
        }
    }
    // New keys are drawn at every block, so that these decisions are independent.
    let tail = binomial::upper_tail(moves, decisions, monitor.design().region.size());
    println!("{moves} of {decisions}, upper tail {tail:.2e}");
    assert!(tail > 1e-6);
}
