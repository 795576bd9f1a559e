//! The events of a monitor, written as one JSON object each.
//!
//! `{"time":8.93,"reported":9.99,"state":"acceleration","direction":"up","speed":0.56,"decision":{…}}` or
//! `{"time":12.1,"reported":13.3,"alarm":"jam"}` or `{"time":14.0,"reported":15.0,"sensor":"stuck"}`. Times are in s, speeds in m/s. What is not known is left out.

#![allow(missing_docs, reason = "what a name says is not said again")]

use crate::signal::Phase;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize, Serializer};

/// The state of the cage as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It may stand or move.
    Unknown,
    Known(Phase),
}

/// The direction of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Against gravity.
    Up,
    Down,
}

/// An interval of time: start and end, s.
pub type Span = (f64, f64);

/// A decision on three samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// W
    pub rank_sum: u64,
    /// T
    pub exceedances: usize,
    /// C_W(T): H₁* where W is at most this,
    pub lower: Option<u64>,
    /// or at least this.
    pub upper: Option<u64>,
    pub alpha: f64,
    /// X; `None` if it was taken from all rest of a record.
    #[serde(serialize_with = "rounded")]
    pub reference: Option<Span>,
    /// Y₁
    #[serde(serialize_with = "rounded")]
    pub shift: Span,
    /// Y₂
    #[serde(serialize_with = "rounded")]
    pub scale: Span,
}

/// An alarm of sequential ranks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankDecision {
    /// When S reached its threshold, s.
    #[serde(serialize_with = "rounded")]
    pub alarmed: f64,
    /// The sign of Δ.
    pub side: Direction,
    /// At most so many false alarms per block.
    pub alpha: f64,
    /// The number of blocks that the ranks begin with,
    pub ranked: usize,
    /// and where they are from; `None` if that was all rest of a record.
    #[serde(serialize_with = "rounded")]
    pub reference: Option<Span>,
}

/// The decision of either rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Decided {
    ThreeSample(Decision),
    Sequential(RankDecision),
}

/// An event reported by the monitor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Event {
    /// Time of the event, s.
    #[serde(serialize_with = "rounded")]
    pub time: f64,
    /// Time at which it was known, s.
    #[serde(serialize_with = "rounded")]
    pub reported: f64,
    #[serde(flatten)]
    pub kind: Kind,
}

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The sensor cannot be trusted.
    Sensor(Fault),
    /// The cage needs attention.
    #[serde(untagged)]
    Alarm {
        alarm: Alarm,
        /// Whether the cage is known to be in this state; else that is only plausible.
        certain: bool,
    },
    /// The state has changed.
    #[serde(untagged)]
    Change {
        /// The new state.
        state: State,
        /// The direction of the motion.
        #[serde(skip_serializing_if = "Option::is_none")]
        direction: Option<Direction>,
        /// The speed of the motion, m/s, as far as pulses of acceleration show.
        #[serde(skip_serializing_if = "Option::is_none", serialize_with = "rounded")]
        speed: Option<f64>,
        /// Why the state is unknown.
        #[serde(skip_serializing_if = "Option::is_none")]
        reason: Option<Doubt>,
        /// The decision behind the change, if there was one.
        #[serde(skip_serializing_if = "Option::is_none")]
        decision: Option<Decided>,
    },
}

impl Kind {
    /// The alarm, if it is one.
    pub fn alarm(&self) -> Option<Alarm> {
        match self {
            Self::Alarm { alarm, .. } => Some(*alarm),
            _ => None,
        }
    }

    /// The direction of the motion, if it tells one.
    pub fn direction(&self) -> Option<Direction> {
        match self {
            Self::Change { direction, .. } => *direction,
            _ => None,
        }
    }
}

/// Why the cage needs attention.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Alarm {
    /// The motion ended in a violent pulse, without the braking of a commanded stop.
    Jam,
    /// The cage stands while the drum turns.
    Slack,
}

/// What is wrong with a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// It repeats one value, where it used to scatter or has hardly done so: then it may be too coarse.
    Stuck,
    /// It is at the end of its range.
    Saturated,
    /// It sent nothing for a while.
    Silent,
    /// Its clock was set back.
    Clock,
    /// A start would not be seen in its noise.
    Noisy,
    /// Its level has jumped: it was moved.
    Moved,
    /// Its samples have become far rarer than they were.
    Slow,
}

/// Why a state is unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Doubt {
    /// Too little was seen: it takes three quiet seconds, or without `--begins` one or two trips.
    Beginning,
    /// A pulse of acceleration may be a start, a stop or a disturbance: it takes the rest of it, or the next one.
    Pulse,
    /// The level may have shifted, or a soft motion begun or ended: it takes the next start or stop.
    Level,
    /// The cage may creep: it takes the last stop, or some seconds without one.
    Creep,
    /// The record has a hole: it takes the next trip.
    Hole,
    /// The sensor cannot be trusted: it takes another.
    Sensor,
}

impl Direction {
    /// The direction of an acceleration of this sign.
    pub fn of(sign: f64) -> Self {
        if sign > 0.0 { Self::Up } else { Self::Down }
    }

    /// 1 upwards, −1 downwards.
    pub fn sign(self) -> f64 {
        match self {
            Self::Up => 1.0,
            Self::Down => -1.0,
        }
    }
}

impl State {
    /// The cage stands.
    pub const REST: Self = Self::Known(Phase::Rest);

    /// Whether the cage is known to move.
    pub fn moves(self) -> bool {
        matches!(self, Self::Known(phase) if phase.moves())
    }
}

impl Serialize for State {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(match self {
            Self::Unknown => "unknown",
            Self::Known(phase) => phase.name(),
        })
    }
}

impl<'de> Deserialize<'de> for State {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let known = || Phase::ALL.into_iter().find(|phase| phase.name() == name);
        match &name[..] {
            "unknown" => Ok(Self::Unknown),
            _ => known()
                .map(Self::Known)
                .ok_or_else(|| D::Error::custom(format_args!("no state {name}"))),
        }
    }
}

impl Alarm {
    /// The name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Jam => "jam",
            Self::Slack => "slack",
        }
    }
}

/// Rounds to a tenth of a millisecond, or of a millimetre per second: blocks do not resolve more.
trait Round: Copy + Serialize {
    fn round(self) -> Self;
}

impl Round for f64 {
    fn round(self) -> Self {
        (self * 1e4).round() / 1e4
    }
}

impl Round for Span {
    fn round(self) -> Self {
        (self.0.round(), self.1.round())
    }
}

impl<T: Round> Round for Option<T> {
    fn round(self) -> Self {
        self.map(Round::round)
    }
}

fn rounded<T: Round, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    Round::round(*value).serialize(serializer)
}
