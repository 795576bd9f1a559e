//! What is said of a stop, and of a floor.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A stop as judged at once, and the stop before it judged again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// Where the car stands, m above the floor of the first stop.
    pub position: f64,
    /// m.
    pub deviation: f64,
    /// The floor that it left, from 0 up; none off every floor, or where it may be at any.
    pub from: Option<usize>,
    /// The floor that it stands at; none off every floor.
    pub floor: Option<usize>,
    /// The share of this course of events in the likelihood of all that are kept.
    pub probability: f64,
    /// None where the stop itself gave the floor.
    pub judgement: Option<Judgement>,
    /// The stop before, by the trip in and the trip out; none where this stop says nothing about it.
    pub earlier: Option<Judgement>,
    /// A new floor of the map. Floors above it have moved up by one.
    pub added: Option<usize>,
}

/// A stop against the floor that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// From 0 up.
    pub floor: usize,
    /// How far above it the car stands, m.
    pub offset: f64,
    /// Of the offset, were the car at the floor, m.
    pub deviation: f64,
    /// The scaled ξ.
    pub xi: f64,
    /// None where ξ is at most γ_s.
    pub fault: Option<Fault>,
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.fault {
            Some(fault) => write!(f, "alarm, {fault}")?,
            None => f.write_str("no alarm")?,
        }
        let side = if self.offset < 0.0 { "below" } else { "above" };
        let (offset, deviation, floor) = (self.offset.abs(), self.deviation, self.floor);
        write!(f, ": {offset:.3} ± {deviation:.3} m {side} floor {floor}")
    }
}

/// What an alarm means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// Out of level with a floor.
    MisLevelling,
    /// Below the lowest floor.
    Pit,
    /// Above the highest floor.
    Overrun,
    /// Between two floors.
    BetweenFloors,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MisLevelling => "out of level",
            Self::Pit => "in the pit",
            Self::Overrun => "above the top",
            Self::BetweenFloors => "between floors",
        })
    }
}

/// A height, m above the floor of the first stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Height {
    /// m.
    pub mean: f64,
    /// m².
    pub variance: f64,
}

/// A floor of the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Floor {
    /// m above the floor of the first stop.
    pub height: f64,
    /// m.
    pub deviation: f64,
    /// From its height as commissioned, m.
    pub drift: f64,
    /// Of the drift of a floor that has not moved, m.
    pub drift_deviation: f64,
    /// Stops at it since it is known.
    pub visits: u64,
}
