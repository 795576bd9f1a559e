//! What a monitor says, and how it is written: one JSON object each.
//!
//! `{"time":8.93,"reported":9.99,"state":"accelerating","direction":"up","speed":0.56,"decision":{…}}` or
//! `{"time":12.1,"reported":13.3,"alarm":"jam"}`. Times are in s, speeds in m/s. What is not known is left out.

use crate::detect::Statistics;
use crate::signal::Phase;
use serde::ser::{Serialize, SerializeStruct, Serializer};

/// What the cage does, as far as is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It may stand or move.
    Unknown,
    /// It is in this phase.
    Known(Phase),
}

/// Where a motion goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// When X, Y₁ and Y₂ began and ended, s; X has no time of its own where it was taken from all rest of a
    /// record.
    pub samples: [Option<(f64, f64)>; 3],
}

/// Something that has happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// When it happened, s.
    pub time: f64,
    /// When it was said, s.
    pub reported: f64,
    /// What it is.
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

impl Serialize for Event {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_struct("Event", 6)?;
        object.serialize_field("time", &rounded(self.time))?;
        object.serialize_field("reported", &rounded(self.reported))?;
        match &self.kind {
            Kind::Alarm(alarm) => object.serialize_field("alarm", alarm.name())?,
            Kind::Change {
                state,
                direction,
                speed,
                decision,
            } => {
                object.serialize_field("state", state.name())?;
                if let Some(direction) = direction {
                    object.serialize_field("direction", direction.name())?;
                }
                if let Some(speed) = speed {
                    object.serialize_field("speed", &rounded(*speed))?;
                }
                if let Some(decision) = decision {
                    object.serialize_field("decision", decision)?;
                }
            }
        }
        object.end()
    }
}

impl Serialize for Decision {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_struct("Decision", 7)?;
        object.serialize_field("rank_sum", &self.statistics.rank_sum)?;
        object.serialize_field("exceedances", &self.statistics.exceedances)?;
        object.serialize_field("threshold", &self.threshold)?;
        object.serialize_field("alpha", &self.alpha)?;
        for (name, span) in ["reference", "shift", "scale"].iter().zip(self.samples) {
            object.serialize_field(name, &span.map(|(from, to)| [rounded(from), rounded(to)]))?;
        }
        object.end()
    }
}

/// To a tenth of a millisecond, or of a millimetre per second: more than a block can tell.
pub fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
