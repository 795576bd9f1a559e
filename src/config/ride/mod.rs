//! `[ride]`: whole simulated rides before the monitor, counted along an axis for several curves.
//!
//! Accelerations are in m/s², times in s. What stands for the strength of the noise is one of three keys:
//! `sigma`, the deviation of a sample; `density`, the one-sided root density of the noise in m/s²/√Hz, which is
//! what a sensor has whatever it is sampled at, so that sigma = density √(rate/2); `delta_over_sigma`, the
//! drive's acceleration in units of sigma. Vibration, θ, quantum and jolt are in units of sigma.

mod keys;
mod point;
mod problem;
#[cfg(test)]
mod tests;

pub use point::RidePoint;
pub use problem::RideProblem;

use super::axis::{self, AxisValue};
use super::drawing::Refused;
use super::error::Problem;
use super::exhibit::ExhibitKind;
use super::file::AxisTable;
use super::tree::{Node, Value};
use keys::STRENGTH;
use serde::Deserialize;
use std::ops::Range;

/// What must be there; everything else is read from the tree.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct RideTable {
    measure: Measure,
    axis: AxisTable,
}

/// What is asked of each trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A ride: are its trips found, and how late?
    Rides,
    /// A rest: how often does it look like motion?
    Rest,
    /// A ride and a rest: what does finding soon cost?
    Tradeoff,
    /// A ride whose last trip jams: does it alarm, and how late?
    Jam,
    /// A ride that the monitor sees from somewhere in its first uniform motion on: does it take that for
    /// rest, and when does it know better?
    SwitchedOn,
}

/// Rides along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct RideStudy {
    /// What is asked of each trial.
    pub measure: Measure,
    /// The key that is swept.
    pub axis: &'static str,
    /// At least one.
    pub curves: Vec<RideCurve>,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct RideCurve {
    /// What tells it from the others.
    pub label: String,
    /// Each value of the axis and its point.
    pub points: Vec<(f64, RidePoint)>,
}

/// More trips than anyone needs in a ride.
const MOST_TRIPS: usize = 100;

impl Measure {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rides => "rides",
            Self::Rest => "rest",
            Self::Tradeoff => "tradeoff",
            Self::Jam => "jam",
            Self::SwitchedOn => "switched_on",
        }
    }

    /// Whether it makes trips.
    pub fn rides(self) -> bool {
        self != Self::Rest
    }

    /// Whether it rests for a given time.
    pub fn rests(self) -> bool {
        matches!(self, Self::Rest | Self::Tradeoff)
    }

    /// The keys that change nothing in it.
    fn unused(self) -> &'static [&'static str] {
        match self {
            Self::Rides => &["length", "jam_within"],
            Self::Rest => &[
                "distance",
                "speed",
                "jerk",
                "trips",
                "rest",
                "jam_within",
                "tolerance",
                "vibration",
                "nu",
                "theta",
            ],
            Self::Tradeoff => &["jam_within"],
            Self::Jam => &["length"],
            Self::SwitchedOn => &["length", "jam_within"],
        }
    }
}

/// The axis and where it stands.
struct Axis {
    name: &'static str,
    values: Vec<AxisValue>,
    span: Range<usize>,
}

/// The study of a `[ride]` table.
pub(super) fn study(table: &RideTable, node: &Node) -> Result<ExhibitKind, Refused> {
    let measure = table.measure;
    let base = keys::values(node, &["measure", "axis", "curve"]).map_err(placed)?;
    let axis = Axis::new(table)?;
    axis.check_free(&base)?;
    keys::check_used(measure, &base).map_err(placed)?;
    let mut curves: Vec<RideCurve> = Vec::new();
    for (index, curve) in tables(node).iter().enumerate() {
        let values = keys::values(curve, &["label"]).map_err(placed)?;
        axis.check_free(&values)?;
        keys::check_used(measure, &values).map_err(placed)?;
        let label = label(curve, index, &curves)?;
        let points = axis.points(measure, &values.over(&base, &[&STRENGTH]))?;
        curves.push(RideCurve { label, points });
    }
    Ok(ExhibitKind::Ride(RideStudy {
        measure,
        axis: axis.name,
        curves,
    }))
}

fn placed((span, problem): keys::Refused) -> Refused {
    (span, problem.into())
}

/// The curves, or the one that a table without any stands for.
fn tables(node: &Node) -> Vec<Node> {
    match node.get("curve").map(|curves| &curves.value) {
        Some(Value::List(curves)) if !curves.is_empty() => curves.clone(),
        _ => vec![Node::empty(node.span.clone())],
    }
}

/// A label of its own, also when it is part of a quantity's name.
fn label(table: &Node, index: usize, before: &[RideCurve]) -> Result<String, Refused> {
    let given = table.get("label");
    let label = given.map(String::deserialize).transpose();
    let label = label.map_err(|refusal| {
        let problem = RideProblem::Read(refusal.within("ride.curve.label"));
        (given.map(|node| node.span.clone()), problem.into())
    })?;
    let label = label.unwrap_or((index + 1).to_string());
    let name = RideCurve::name_of(&label);
    if name.is_empty() || before.iter().any(|other| other.name() == name) {
        return Err((given.map(|node| node.span.clone()), Problem::Label(label)));
    }
    Ok(label)
}

impl RideCurve {
    /// Its label as part of a quantity's name: letters and digits, `_` for anything between.
    pub fn name(&self) -> String {
        Self::name_of(&self.label)
    }

    fn name_of(label: &str) -> String {
        let lower = label.to_lowercase();
        let words = lower.split(|c: char| !c.is_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        words.join("_")
    }
}

impl Axis {
    fn new(table: &RideTable) -> Result<Self, Refused> {
        let (key, value) = axis::only(&table.axis)?;
        let Some(name) = keys::all().find(|name| name == key.get_ref()) else {
            return Err(axis::unknown(key, keys::all()));
        };
        let measure = table.measure;
        if measure.unused().contains(&name) {
            let key_name = name.to_owned();
            let problem = RideProblem::Unused {
                key: key_name,
                measure,
            };
            return Err((Some(key.span()), problem.into()));
        }
        let span = value.span();
        let values =
            axis::values(name, value.get_ref()).map_err(|problem| (Some(span.clone()), problem))?;
        Ok(Self { name, values, span })
    }

    /// What is swept must not be set as well.
    fn check_free(&self, values: &Node) -> Result<(), Refused> {
        match place(values, self.name) {
            Some(span) => Err((Some(span), Problem::FixedAndSwept(self.name))),
            None => Ok(()),
        }
    }

    /// Each value and its point.
    fn points(&self, measure: Measure, values: &Node) -> Result<Vec<(f64, RidePoint)>, Refused> {
        let at = |problem: RideProblem| (Some(self.span.clone()), problem.into());
        let point = |value: &AxisValue| {
            let no_number = || at(RideProblem::NoNumber(self.name.to_owned()));
            let number = value.number().ok_or_else(no_number)?;
            let mut values = values.clone();
            values.set(self.name, self.node(value, number));
            let (keys, settings) = keys::read(&values).map_err(placed)?;
            let point = RidePoint::new(measure, &keys, settings);
            let point = point.map_err(|problem| {
                let key = problem.key();
                (key.and_then(|key| place(&values, key)), problem.into())
            })?;
            Ok((number, point))
        };
        self.values.iter().map(point).collect()
    }

    /// A value as it would stand in the table.
    fn node(&self, value: &AxisValue, number: f64) -> Node {
        let value = match value.written().as_integer() {
            Some(whole) => Value::Integer(whole),
            None => Value::Float(number),
        };
        let span = self.span.clone();
        Node { span, value }
    }
}

/// Where the value of a key stands, or that of a key that says the same in another way.
fn place(values: &Node, key: &str) -> Option<Range<usize>> {
    let rivals: &[&str] = if STRENGTH.contains(&key) {
        &STRENGTH
    } else {
        &[key]
    };
    let mut found = rivals.iter().filter_map(|key| values.get(key));
    found.next().map(|node| node.span.clone())
}
