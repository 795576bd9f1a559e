//! What a monitor says.

use crate::detect::Statistics;
use crate::signal::Phase;
use serde::{Deserialize, Serialize};

/// What the cage does, as far as is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It may stand or move.
    Unknown,
    /// It is in this phase.
    Known(Phase),
}

/// Where a motion goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Against gravity.
    Up,
    /// With it.
    Down,
}

/// A decision on three samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// W and T.
    pub statistics: Statistics,
    /// C_W(T): decides for motion where W is at most the first or at least the second.
    pub threshold: (Option<u64>, Option<u64>),
    /// Its level.
    pub alpha: f64,
    /// When X, Y₁ and Y₂ began and ended, s.
    pub samples: [(f64, f64); 3],
}

/// What has happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// When it happened, s.
    pub time: f64,
    /// When it was said, s.
    pub reported: f64,
    /// What.
    pub kind: Kind,
}

/// What has happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The state has changed.
    Change {
        /// To this.
        state: State,
        /// Of the motion.
        direction: Option<Direction>,
        /// Of the motion, m/s, as far as pulses of acceleration tell.
        speed: Option<f64>,
        /// What decided it, where a decision did.
        decision: Option<Decision>,
    },
    /// The cage needs attention.
    Alarm(Alarm),
}

/// Why the cage needs attention.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alarm {
    /// The motion ended in a violent pulse, without the braking of a commanded stop.
    Jam,
    /// The cage stands while the drum turns.
    Slack,
}

impl Direction {
    /// Of an acceleration of this sign.
    pub fn of(sign: f64) -> Self {
        if sign > 0.0 { Self::Up } else { Self::Down }
    }

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }
}

impl State {
    /// Whether it is known to move.
    pub fn moves(self) -> bool {
        matches!(self, Self::Known(phase) if phase.moves())
    }

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Known(Phase::Rest) => "rest",
            Self::Known(Phase::Accelerating) => "accelerating",
            Self::Known(Phase::Inertial) => "inertial",
            Self::Known(Phase::Braking) => "braking",
        }
    }
}

impl Alarm {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Jam => "jam",
            Self::Slack => "slack",
        }
    }
}
