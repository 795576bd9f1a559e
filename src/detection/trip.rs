//! A motion, put together from the events of a monitor.

#![allow(missing_docs, reason = "what a name says is not said again")]

use crate::monitor::{Alarm, Decision, Direction, Event, Kind, State};
use crate::signal::Phase;
use serde::{Deserialize, Serialize};

/// A motion of the cage. Times are in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trip {
    /// Its number, from 1.
    pub ride: usize,
    pub direction: Direction,
    pub start: f64,
    /// When the acceleration ended.
    pub inertial: Option<f64>,
    /// When the braking began, the last one if there were several.
    pub braking: Option<f64>,
    /// When it ended, or was lost from sight.
    pub stop: Option<f64>,
    /// The highest speed, m/s.
    pub speed: f64,
    pub ended: End,
    /// When the start was known.
    pub start_reported: f64,
    pub start_decision: Option<Decision>,
    pub stop_reported: Option<f64>,
    pub stop_decision: Option<Decision>,
}

/// The end of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// A commanded stop.
    Stop,
    Jam,
    /// The monitor lost sight of it.
    Lost,
    /// Nothing yet.
    #[serde(rename = "end of the recording")]
    Recording,
}

/// Adds an event to the trips.
pub(super) fn take(trips: &mut Vec<Trip>, event: &Event) {
    if let Kind::Change {
        state: State::Known(Phase::Accelerating),
        direction: Some(direction),
        speed,
        decision,
    } = event.kind
    {
        trips.push(Trip {
            ride: trips.len() + 1,
            direction,
            start: event.time,
            inertial: None,
            braking: None,
            stop: None,
            speed: speed.unwrap_or(0.0),
            ended: End::Recording,
            start_reported: event.reported,
            start_decision: decision,
            stop_reported: None,
            stop_decision: None,
        });
    } else if let Some(open) = trips.last_mut().filter(|trip| trip.stop.is_none()) {
        open.take(event);
    }
}

impl Trip {
    fn take(&mut self, event: &Event) {
        let (state, speed, decision) = match event.kind {
            Kind::Change {
                state,
                speed,
                decision,
                ..
            } => (state, speed, decision),
            Kind::Alarm(Alarm::Jam) => return self.ended = End::Jam,
            Kind::Alarm(Alarm::Slack) => return,
        };
        self.speed = self.speed.max(speed.unwrap_or(0.0));
        match state {
            State::Known(Phase::Accelerating) => {}
            State::Known(Phase::Inertial) => {
                self.inertial.get_or_insert(event.time);
            }
            State::Known(Phase::Braking) => self.braking = Some(event.time),
            State::Known(Phase::Rest) if self.ended == End::Jam => {
                self.close(End::Jam, event, decision);
            }
            State::Known(Phase::Rest) => self.close(End::Stop, event, decision),
            State::Unknown => self.close(End::Lost, event, None),
        }
    }

    fn close(&mut self, by: End, event: &Event, decision: Option<Decision>) {
        self.ended = by;
        self.stop = Some(event.time);
        self.stop_reported = Some(event.reported);
        self.stop_decision = decision;
    }
}
