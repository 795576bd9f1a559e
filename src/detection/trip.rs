//! What a recording holds, for the report: trips, stretches that are not decided, and everything else that moved the
//! sensor. Times are in s.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::decisions::Decisions;
use crate::explain::{self, Doubt, Explanation, Prior};
use crate::monitor::{Decision, Direction};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A motion of the cage. What lies outside the record, or in a hole of it, is missing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trip {
    /// Its number, from 1.
    pub ride: usize,
    pub direction: Direction,
    pub start: Option<f64>,
    /// When the acceleration ended.
    pub inertial: Option<f64>,
    /// When the braking began.
    pub braking: Option<f64>,
    /// When the braking ended and the cage crept on to the landing, if it did.
    pub levelling: Option<f64>,
    pub stop: Option<f64>,
    /// The highest speed, m/s.
    pub speed: f64,
    pub ended: End,
    /// Another start or stop that is nearly as likely.
    pub or_start: Option<f64>,
    pub or_stop: Option<f64>,
    pub start_decision: Option<Decision>,
    pub stop_decision: Option<Decision>,
}

/// The end of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// A commanded stop.
    Stop,
    Jam,
    /// Not in the record.
    #[serde(rename = "not recorded")]
    NotRecorded,
}

/// A stretch with two explanations that are close.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Undecided {
    pub from: f64,
    pub to: f64,
    /// The likelier trips.
    pub either: Vec<Brief>,
    /// The others.
    pub or: Vec<Brief>,
    /// How much likelier the first are: the logarithm of the odds.
    pub log_odds: f64,
}

/// A trip in a few words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Brief {
    pub direction: Direction,
    pub start: Option<f64>,
    pub stop: Option<f64>,
    pub speed: f64,
}

/// Something that moved the sensor and is no trip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Event {
    pub from: f64,
    pub to: f64,
    pub what: What,
    /// The change of speed it leaves, m/s, or the speed of a slow motion.
    pub speed: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// Stronger than any acceleration of a lift.
    Shock,
    /// To and fro: a jump, a swinging rope.
    Swing,
    /// A change of speed that belongs to no trip.
    Push,
    /// What would be a trip if it were faster than `least_speed`.
    SlowMotion,
}

/// Ends of trips that lie nearer than this are the same, s.
const SAME: f64 = 0.5;

/// Another start or stop is worth a word below this difference in cost.
const END_DECIDED: f64 = 1.0;

/// The trips that are decided, and the stretches that are not.
pub(super) fn told(
    explanation: &Explanation,
    decisions: &Decisions,
) -> (Vec<Trip>, Vec<Undecided>) {
    let mut is_decided = vec![true; explanation.reading.trips.len()];
    let mut ends = vec![(None, None); is_decided.len()];
    let mut undecided = Vec::new();
    for doubt in &explanation.doubts {
        let pair = |trip: &explain::Trip| doubt.instead.iter().find(|other| is_same(trip, other));
        let is_lost = |trip: &&explain::Trip| pair(trip).is_none();
        let is_new = |other: &&explain::Trip| !doubt.trips.iter().any(|trip| is_same(trip, other));
        if doubt.trips.iter().any(|trip| is_lost(&trip))
            || doubt.instead.iter().any(|trip| is_new(&trip))
        {
            undecided.push(Undecided::of(doubt));
        }
        for (place, trip) in explanation.reading.trips.iter().enumerate() {
            if !doubt.trips.contains(trip) {
                continue;
            }
            match pair(trip) {
                None => is_decided[place] = false,
                Some(other) if doubt.margin < END_DECIDED => {
                    if !is_near(trip.start, other.start) {
                        ends[place].0 = other.start;
                    }
                    if !is_near(trip.stop, other.stop) {
                        ends[place].1 = other.stop;
                    }
                }
                Some(_) => {}
            }
        }
    }
    let trips = explanation.reading.trips.iter().zip(ends).zip(is_decided);
    let decided = trips.filter(|(_, is_decided)| *is_decided);
    let rows = decided.enumerate().map(|(index, ((trip, ends), _))| {
        let pulse = |place: usize| &explanation.pulses[trip.changes[place]];
        Trip {
            ride: index + 1,
            direction: direction(trip),
            start: trip.start,
            inertial: trip.inertial,
            braking: trip.braking,
            levelling: trip.levelling,
            stop: trip.stop,
            speed: trip.speed,
            ended: match trip.stop {
                None => End::NotRecorded,
                Some(_) if trip.is_jam => End::Jam,
                Some(_) => End::Stop,
            },
            or_start: ends.0,
            or_stop: ends.1,
            start_decision: trip.start.and_then(|_| decisions.start(pulse(0))),
            stop_decision: trip
                .stop
                .and_then(|_| decisions.stop(pulse(braking(trip, explanation)))),
        }
    });
    (rows.collect(), undecided)
}

/// The change with the main braking: the first of those that end the motion.
fn braking(trip: &explain::Trip, explanation: &Explanation) -> usize {
    let begins = |place: &usize| {
        let pulse = &explanation.pulses[trip.changes[*place]];
        trip.braking.is_some_and(|time| pulse.from >= time)
    };
    let last = trip.changes.len() - 1;
    (0..last).find(begins).unwrap_or(last)
}

fn direction(trip: &explain::Trip) -> Direction {
    if trip.is_up {
        Direction::Up
    } else {
        Direction::Down
    }
}

/// Whether two trips differ at most in one of their ends.
fn is_same(one: &explain::Trip, other: &explain::Trip) -> bool {
    let ends = is_near(one.start, other.start) || is_near(one.stop, other.stop);
    one.is_up == other.is_up && ends
}

fn is_near(one: Option<f64>, other: Option<f64>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => (one - other).abs() < SAME,
        (None, None) => true,
        _ => false,
    }
}

impl Undecided {
    /// What the user can do about it, in brackets after a space.
    pub(super) fn remedy(&self) -> &'static str {
        let begins = |trips: &[Brief]| trips.iter().any(|trip| trip.start.is_none());
        if begins(&self.either) != begins(&self.or) {
            " (say how the record begins: --begins rest or --begins motion)"
        } else {
            " (record a few seconds of rest before and after the ride)"
        }
    }

    fn of(doubt: &Doubt) -> Self {
        let brief = |trips: &[explain::Trip]| trips.iter().map(Brief::of).collect();
        Self {
            from: doubt.from,
            to: doubt.to,
            either: brief(&doubt.trips),
            or: brief(&doubt.instead),
            log_odds: doubt.margin,
        }
    }
}

impl Brief {
    fn of(trip: &explain::Trip) -> Self {
        Self {
            direction: direction(trip),
            start: trip.start,
            stop: trip.stop,
            speed: trip.speed,
        }
    }
}

/// What the pulses are that belong to no trip.
pub(super) fn events(explanation: &Explanation, prior: &Prior) -> Vec<Event> {
    let slow = explanation.slow.iter().map(|trip| {
        let pulses = &explanation.pulses[trip.pulses.clone()];
        Event {
            from: trip.start.unwrap_or(pulses[0].from),
            to: trip.stop.unwrap_or(pulses[pulses.len() - 1].to),
            what: What::SlowMotion,
            speed: if trip.is_up { trip.speed } else { -trip.speed },
        }
    });
    let is_slow = |pulses: &&Range<usize>| {
        let mut slow = explanation.slow.iter();
        slow.any(|trip| trip.pulses.start <= pulses.start && pulses.end <= trip.pulses.end)
    };
    let others = explanation
        .reading
        .others
        .iter()
        .filter(|pulses| !is_slow(pulses));
    let others = others.map(|pulses| {
        let pulses = &explanation.pulses[pulses.clone()];
        let is_shock = pulses.iter().any(|pulse| prior.is_violent(pulse));
        Event {
            from: pulses[0].from,
            to: pulses[pulses.len() - 1].to,
            what: match pulses.len() {
                _ if is_shock => What::Shock,
                1 => What::Push,
                _ => What::Swing,
            },
            speed: pulses.iter().map(|pulse| pulse.change).sum(),
        }
    });
    let mut events: Vec<Event> = others.chain(slow).collect();
    events.sort_by(|a, b| a.from.total_cmp(&b.from));
    events
}
