//! A record shown to the monitor, sample by sample.

use crate::lift::{Class, Record};
use crate::monitor::{Alarm, Design, Direction, Event, Kind, Knowledge, Monitor, State};
use crate::recording::Sample;
use crate::study::ride::account::{Account, Seen, Truth};

/// What a monitor said of a record, one entry for each event that it was given or that it reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watched {
    /// How long it said `rest` above [`FAST`] beyond [`BRIEF`], ms.
    pub rest_in_motion: u64,
    /// How often the drum turned although the cage stood.
    pub slack_owed: u64,
    /// How often that did not alarm in time.
    pub slack_missed: u64,
    /// Slack alarms while the drum did not turn, or the cage moved.
    pub false_slack: u64,
    /// Motions told of a standing cage.
    pub false_rides: u64,
    /// How long the cage stood, s.
    pub stood: f64,
    /// For how long of that it said `rest`, s.
    pub known: f64,
    pub heading: Heading,
    /// From each start, and from each stop, to when it was told, s; infinite if it never was.
    pub start_delays: Vec<f64>,
    pub stop_delays: Vec<f64>,
}

/// Above this speed `rest` is dangerous, and so is a wrong direction, m/s.
const FAST: f64 = 0.2;
/// For so long it may be said, s.
const BRIEF: f64 = 1.0;

impl Watched {
    /// Shows a record to a monitor that knows that the cage stands at the beginning, and of [`Class::Drum`] whether
    /// the drum turns.
    pub fn new(class: Class, record: &Record, design: &Design, tolerance: f64) -> Self {
        let knowledge = Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        };
        let mut monitor = Monitor::new(design.clone(), knowledge);
        let mut events: Vec<Event> = Vec::new();
        let mut danger = Danger::default();
        let mut watched = Self::default();
        let (seconds, mut direction) = (1.0 / record.rate, None);
        let readings = record.times.iter().zip(&record.acceleration);
        for ((&time, &acceleration), speed) in readings.zip(&record.speed) {
            let turns = || {
                record
                    .drum
                    .iter()
                    .any(|(from, to)| (*from..*to).contains(&time))
            };
            let drum = (class == Class::Drum).then(turns);
            let new = monitor.step(Sample { time, acceleration }, drum);
            let mut changes = new.iter().rev();
            let change = changes.find(|event| matches!(event.kind, Kind::Change { .. }));
            direction = change.map_or(direction, |event| event.kind.direction());
            events.extend_from_slice(new);
            danger.step(time, monitor.state() == State::REST && speed.abs() > FAST);
            watched.heading.step(seconds, *speed, direction);
            if *speed == 0.0 {
                watched.stood += seconds;
            }
        }
        let truth = Truth {
            journeys: record.journeys.clone(),
            to: record.times.last().copied().unwrap_or_default(),
        };
        let seen = Seen::of(events);
        let account = Account::new(&truth, &seen, tolerance);
        watched.rest_in_motion = danger.milliseconds();
        watched.false_rides = account.false_motions;
        watched.known = account.known;
        for trip in &account.trips {
            watched.start_delays.push(tenths(trip.start_delay));
            watched.stop_delays.push(tenths(trip.stop_delay));
        }
        let patience = design.settings.monitor.longest_slack + tolerance;
        watched.judge_slack(record, &seen.events, patience);
        watched
    }

    fn judge_slack(&mut self, record: &Record, events: &[Event], patience: f64) {
        let alarms = events.iter();
        let alarms = alarms.filter(|event| event.kind.alarm() == Some(Alarm::Slack));
        let alarms: Vec<f64> = alarms.map(|event| event.reported).collect();
        let owed = record
            .slack
            .iter()
            .filter(|(from, to)| to - from >= patience);
        for (from, _) in owed {
            let in_time = |alarm: &f64| (*from..=from + patience).contains(alarm);
            self.slack_owed += 1;
            self.slack_missed += u64::from(!alarms.iter().any(in_time));
        }
        let is_false = |alarm: &&f64| {
            let mut slack = record.slack.iter();
            !slack.any(|(from, to)| (*from..=to + patience).contains(alarm))
        };
        self.false_slack = alarms.iter().filter(is_false).count() as u64;
    }
}

/// What stands of the direction of a cage above [`FAST`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// How long the cage is so fast, s.
    pub moved: f64,
    /// For how long of that its direction stands, and for how long the other one, s.
    pub right: f64,
    pub wrong: f64,
}

impl Heading {
    pub fn step(&mut self, seconds: f64, speed: f64, told: Option<Direction>) {
        if speed.abs() > FAST {
            self.moved += seconds;
            match told {
                Some(told) if told == Direction::of(speed) => self.right += seconds,
                Some(_) => self.wrong += seconds,
                None => {}
            }
        }
    }
}

/// Stretches in which `rest` is said of a fast cage. A hole in the record ends one.
#[derive(Default)]
pub(super) struct Danger {
    since: Option<f64>,
    last: f64,
    beyond: f64,
}

/// A longer step of time is a hole, s.
const HOLE: f64 = 0.5;

impl Danger {
    pub fn step(&mut self, time: f64, is_now: bool) {
        if time - self.last > HOLE || !is_now {
            self.close();
        }
        if is_now {
            self.since.get_or_insert(time);
        }
        self.last = time;
    }

    fn close(&mut self) {
        if let Some(since) = self.since.take() {
            self.beyond += (self.last - since - BRIEF).max(0.0);
        }
    }

    pub fn milliseconds(mut self) -> u64 {
        self.close();
        (1e3 * self.beyond).ceil() as u64
    }
}

/// A delay to a tenth of a second: of many trials a histogram.
fn tenths(delay: f64) -> f64 {
    (delay * 10.0).round() / 10.0
}
