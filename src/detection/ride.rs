//! A motion, put together from what a monitor said of it.

use crate::monitor::{Alarm, Decision, Direction, Event, Kind, State};
use crate::signal::Phase;

/// A motion of the cage. Times are in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ride {
    /// Where it went.
    pub direction: Direction,
    /// When it started.
    pub start: f64,
    /// When that was said.
    pub start_reported: f64,
    /// What decided it.
    pub start_decision: Option<Decision>,
    /// When the acceleration ended.
    pub inertial: Option<f64>,
    /// When the braking began, the last one if there were several.
    pub braking: Option<f64>,
    /// The highest speed, m/s.
    pub speed: f64,
    /// How it ended; while it goes on, it has not.
    pub end: Option<End>,
    /// When it ended, or was lost from sight.
    pub stop: Option<f64>,
    /// When that was said.
    pub stop_reported: Option<f64>,
    /// What decided it.
    pub stop_decision: Option<Decision>,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By a braking.
    Stop,
    /// By a jam.
    Jam,
    /// The monitor lost sight of it.
    Lost,
}

impl End {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Jam => "jam",
            Self::Lost => "lost",
        }
    }
}

/// Puts an event where it belongs.
pub(super) fn take(rides: &mut Vec<Ride>, event: &Event) {
    let open = rides.last_mut().filter(|ride| ride.stop.is_none());
    match (&event.kind, open) {
        (
            Kind::Change {
                state: State::Known(Phase::Accelerating),
                direction: Some(direction),
                speed,
                decision,
            },
            _,
        ) => rides.push(Ride {
            direction: *direction,
            start: event.time,
            start_reported: event.reported,
            start_decision: *decision,
            inertial: None,
            braking: None,
            speed: speed.unwrap_or(0.0),
            end: None,
            stop: None,
            stop_reported: None,
            stop_decision: None,
        }),
        (
            Kind::Change {
                state,
                speed,
                decision,
                ..
            },
            Some(ride),
        ) => {
            ride.speed = ride.speed.max(speed.unwrap_or(0.0));
            match state {
                State::Known(Phase::Inertial) => {
                    ride.inertial.get_or_insert(event.time);
                }
                State::Known(Phase::Braking) => ride.braking = Some(event.time),
                State::Known(Phase::Accelerating) => {}
                State::Known(Phase::Rest) => {
                    ride.end.get_or_insert(End::Stop);
                    ride.close(event, *decision);
                }
                State::Unknown => {
                    ride.end = Some(End::Lost);
                    ride.close(event, None);
                }
            }
        }
        (Kind::Alarm(Alarm::Jam), Some(ride)) => ride.end = Some(End::Jam),
        _ => {}
    }
}

impl Ride {
    fn close(&mut self, event: &Event, decision: Option<Decision>) {
        self.stop = Some(event.time);
        self.stop_reported = Some(event.reported);
        self.stop_decision = decision;
    }
}
