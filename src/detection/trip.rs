//! What a recording holds, for the report: trips, stretches that are not decided, and everything else that moved the
//! sensor. Times are in s.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::decisions::Decisions;
use crate::explain::{self, Cause, Doubt, Explanation, Faults};
use crate::monitor::{Decision, Direction};
use crate::recording::Moment;
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
    /// When the last change of its speed began: the braking, or after levelling the landing.
    #[serde(skip)]
    pub landing: Option<f64>,
    pub stop: Option<f64>,
    /// The highest speed, m/s.
    pub speed: f64,
    pub ended: End,
    /// Another start or stop that is nearly as likely.
    pub or_start: Option<f64>,
    pub or_stop: Option<f64>,
    pub start_decision: Option<Decision>,
    pub stop_decision: Option<Decision>,
    /// The moments of its start and its stop, where the clock has dates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_at: Option<Moment>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop_at: Option<Moment>,
}

impl Trip {
    /// Where time 0 is at this moment, if the clock has dates.
    pub fn date(&mut self, zero: Option<Moment>) {
        let at = |time: Option<f64>| Some(zero?.after(time?));
        (self.start_at, self.stop_at) = (at(self.start), at(self.stop));
    }
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

/// A stretch of which the record does not say what the cage did.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Undecided {
    pub from: f64,
    pub to: f64,
    pub why: Why,
    /// The likelier trips.
    pub either: Vec<Brief>,
    /// The others.
    pub or: Vec<Brief>,
    /// How much likelier the first are: the logarithm of the odds.
    pub log_odds: f64,
    /// How many other explanations are close.
    pub more: usize,
    /// Whether it begins with the record.
    #[serde(skip)]
    pub(super) is_first: bool,
}

/// Why a stretch is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// Two explanations are close.
    Close,
    /// Two rides there and back may be one, behind a high-pass filter.
    Filter,
    /// A change of speed fits no ride.
    NoRide,
    /// The sensor repeats one value.
    Frozen,
    /// Somebody has the sensor in hand.
    InHand,
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
    /// The level of the sensor is another for a while: it was turned a little.
    LevelShift,
    /// What would be a trip if it were faster than `least_speed`.
    SlowMotion,
}

/// The trips that are decided.
pub(super) fn trips(explanation: &Explanation, decisions: &Decisions) -> Vec<Trip> {
    let doubted = |trip: &&explain::Trip| {
        let mut doubts = explanation.doubts.iter();
        doubts.any(|doubt| doubt.trips.contains(trip) && has_others(doubt))
    };
    let decided = explanation
        .reading
        .trips
        .iter()
        .filter(|trip| !doubted(trip));
    let rows = (1..).zip(decided).map(|(ride, trip)| {
        let others = explanation
            .doubts
            .iter()
            .filter(|doubt| doubt.trips.contains(trip));
        let others: Vec<&explain::Trip> = others.filter_map(|doubt| other(doubt, trip)).collect();
        let other_end = |end: fn(&explain::Trip) -> Option<f64>| {
            let ends = others.iter().map(|other| end(other));
            ends.flatten()
                .find(|time| !explain::is_near(Some(*time), end(trip)))
        };
        let pulse = |place: usize| &explanation.record.pulses[trip.changes[place]];
        Trip {
            ride,
            direction: direction(trip),
            start: trip.start,
            inertial: trip.inertial,
            braking: trip.braking,
            levelling: trip.levelling,
            landing: trip.stop.map(|_| pulse(trip.changes.len() - 1).from),
            stop: trip.stop,
            speed: trip.speed,
            ended: match trip.stop {
                None => End::NotRecorded,
                Some(_) if trip.is_jam => End::Jam,
                Some(_) => End::Stop,
            },
            or_start: other_end(|trip| trip.start),
            or_stop: other_end(|trip| trip.stop),
            start_decision: trip.start.and_then(|_| decisions.start(pulse(0))),
            stop_decision: trip
                .stop
                .and_then(|_| decisions.stop(pulse(braking(trip, explanation)))),
            start_at: None,
            stop_at: None,
        }
    });
    rows.collect()
}

/// The trip of the other explanation that differs in one end at most.
fn other<'a>(doubt: &'a Doubt, trip: &explain::Trip) -> Option<&'a explain::Trip> {
    doubt.instead.iter().find(|other| trip.is_like(other))
}

/// Whether the two explanations differ in more than one end of each trip.
fn has_others(doubt: &Doubt) -> bool {
    let is_new = |trip: &explain::Trip| !doubt.trips.iter().any(|other| other.is_like(trip));
    doubt.trips.len() != doubt.instead.len()
        || doubt.trips.iter().any(|trip| other(doubt, trip).is_none())
        || doubt.instead.iter().any(is_new)
}

/// The stretches that are not decided: where another explanation has other trips, and where a change of speed fits
/// none.
pub(super) fn undecided(
    explanation: &Explanation,
    events: &[Event],
    least_speed: f64,
    faults: &Faults,
) -> Vec<Undecided> {
    let doubts = explanation
        .doubts
        .iter()
        .filter(|doubt| has_others(doubt))
        .map(|doubt| Undecided::of(explanation, doubt));
    let pushes = events.iter();
    let pushes = pushes.filter(|it| it.what == What::Push && it.speed.abs() >= least_speed);
    let pushes = pushes.map(|event| Undecided::unknown(event.from, event.to, Why::NoRide));
    let all = |spans: &[(f64, f64)], why| -> Vec<Undecided> {
        let one = |&(from, to): &(f64, f64)| Undecided::unknown(from, to, why);
        spans.iter().map(one).collect()
    };
    let unread = [
        all(&faults.frozen, Why::Frozen),
        all(&explanation.in_hand, Why::InHand),
    ];
    let unread = unread.into_iter().flatten();
    let mut undecided: Vec<Undecided> = doubts.chain(pushes).chain(unread).collect();
    undecided.sort_by(|a, b| a.from.total_cmp(&b.from));
    merged(undecided)
}

/// Stretches in order of time, those that overlap as one.
fn merged(stretches: Vec<Undecided>) -> Vec<Undecided> {
    let mut merged: Vec<Undecided> = Vec::new();
    for next in stretches {
        match merged.last_mut() {
            Some(last) if last.overlaps(&next) => last.merge(next),
            _ => merged.push(next),
        }
    }
    merged
}

/// The change with the main braking: the first of those that end the motion.
fn braking(trip: &explain::Trip, explanation: &Explanation) -> usize {
    let begins = |place: &usize| {
        let pulse = &explanation.record.pulses[trip.changes[*place]];
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

impl Undecided {
    fn unknown(from: f64, to: f64, why: Why) -> Self {
        Self {
            from,
            to,
            why,
            either: Vec::new(),
            or: Vec::new(),
            log_odds: 0.0,
            more: 0,
            is_first: false,
        }
    }

    /// Whether a later one is about the same stretch.
    fn overlaps(&self, later: &Self) -> bool {
        let is_about_rides = |it: &Self| matches!(it.why, Why::Close | Why::NoRide);
        later.from <= self.to && is_about_rides(self) && is_about_rides(later)
    }

    /// With a later one: the closer explanation is told, and those of the likelier rides that it leaves alone.
    fn merge(&mut self, later: Self) {
        let (from, to) = (self.from.min(later.from), self.to.max(later.to));
        let is_first = self.is_first || later.is_first;
        let (mut closer, farther) = match (self.why, later.why) {
            (Why::Close, Why::Close) if later.log_odds < self.log_odds => (later, self.clone()),
            (Why::Close, _) => (self.clone(), later),
            _ => (later, self.clone()),
        };
        if farther.why == Why::Close {
            closer.more += farther.more + 1;
        }
        let known = closer.either.clone();
        let new = farther
            .either
            .into_iter()
            .filter(|trip| !known.contains(trip));
        for trip in new {
            closer.either.push(trip);
            closer.or.push(trip);
        }
        *self = Self {
            from,
            to,
            is_first,
            ..closer
        };
    }

    fn of(explanation: &Explanation, doubt: &Doubt) -> Self {
        let brief = |trips: &[explain::Trip]| trips.iter().map(Brief::of).collect();
        let blocks = &explanation.record.cut.blocks;
        let places = doubt
            .trips
            .iter()
            .chain(&doubt.instead)
            .map(|trip| explanation.blocks_of(trip));
        let place = places.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        let place = place.expect("a doubt has a trip");
        Self {
            from: blocks[place.start].from,
            to: blocks[place.end - 1].to,
            why: match doubt.cause {
                Cause::Cage => Why::Close,
                Cause::Filter => Why::Filter,
            },
            either: brief(&doubt.trips),
            or: brief(&doubt.instead),
            log_odds: doubt.margin,
            more: 0,
            is_first: place.start == 0,
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
pub(super) fn events(explanation: &Explanation) -> Vec<Event> {
    let slow = explanation.slow.iter().map(|trip| {
        let pulses = &explanation.record.pulses[trip.pulses.clone()];
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
        let pulses = &explanation.record.pulses[pulses.clone()];
        let is_shock = pulses.iter().any(|pulse| pulse.is_violent);
        Event {
            from: pulses[0].from,
            to: pulses[pulses.len() - 1].to,
            what: match pulses.len() {
                _ if is_shock => What::Shock,
                1 if pulses[0].shift != 0.0 => What::LevelShift,
                1 if !pulses[0].is_swing => What::Push,
                _ => What::Swing,
            },
            speed: pulses.iter().map(|pulse| pulse.change).sum(),
        }
    });
    let mut events: Vec<Event> = others.chain(slow).collect();
    events.sort_by(|a, b| a.from.total_cmp(&b.from));
    events
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brief(start: f64, stop: f64) -> Brief {
        Brief {
            direction: Direction::Up,
            start: Some(start),
            stop: Some(stop),
            speed: 1.0,
        }
    }

    fn close(from: f64, to: f64, either: &[Brief], or: &[Brief], log_odds: f64) -> Undecided {
        Undecided {
            either: either.to_vec(),
            or: or.to_vec(),
            log_odds,
            ..Undecided::unknown(from, to, Why::Close)
        }
    }

    /// The closer explanation is told, with the rides of the other that it leaves alone; a frozen sensor stays apart.
    #[test]
    fn overlapping_doubts_are_one() {
        let [first, second, third] = [brief(1.0, 5.0), brief(6.0, 9.0), brief(1.0, 9.0)];
        let merged = merged(vec![
            close(1.0, 9.0, &[first, second], &[third], 2.0),
            close(1.0, 5.0, &[first], &[], 1.0),
            Undecided::unknown(4.0, 7.0, Why::NoRide),
            Undecided::unknown(8.0, 12.0, Why::Frozen),
            close(20.0, 30.0, &[third], &[], 1.0),
        ]);
        let [one, frozen, other] = &merged[..] else {
            panic!("{merged:?}");
        };
        assert_eq!((one.from, one.to, one.more), (1.0, 9.0, 1));
        assert_eq!(
            (&one.either[..], &one.or[..]),
            (&[first, second][..], &[second][..])
        );
        assert_eq!((frozen.why, other.from), (Why::Frozen, 20.0));
    }
}
