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

use super::curve_tables;
use crate::config::{Axis, AxisValue, ConfigError, Conflict, Node, Source, Unfit};
use keys::{RideKeys, STRENGTH};
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use std::ops::Range;

/// What is asked of each trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
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
    pub axis: String,
    /// At least one.
    pub curves: Vec<RideCurve>,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct RideCurve {
    /// What tells it from the others.
    pub label: String,
    /// Each value of the axis and what it comes to here.
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

/// What must be there; everything else is read from the tree.
#[derive(Deserialize)]
struct Required {
    measure: Measure,
    #[serde(rename = "axis")]
    _axis: serde::de::IgnoredAny,
}

/// The study of the `[ride]` table.
pub(super) fn read(source: &Source, root: &Node) -> Result<RideStudy, ConfigError> {
    let table = root.get("ride").expect("it is asked for");
    let required = table.only(|key| ["measure", "axis"].contains(&key));
    let Required { measure, .. } = source.read(&required, "ride")?;
    study(measure, table).map_err(|conflict| source.conflict(root, conflict, &table.span))
}

fn study(measure: Measure, table: &Node) -> Result<RideStudy, Conflict> {
    let base = keys::values(table, &["measure", "axis", "curve"])?;
    let axis = Axis::read(table.get("axis").expect("it is required"), keys::all())?;
    check_axis(measure, &axis)?;
    check_free(&axis, &base)?;
    keys::check_used(measure, &base)?;
    let mut curves: Vec<RideCurve> = Vec::new();
    for (index, curve) in curve_tables(table, "ride.curve")?.iter().enumerate() {
        let values = keys::values(curve, &["label"])?;
        check_free(&axis, &values)?;
        keys::check_used(measure, &values)?;
        let label = label(curve, index, &curves)?;
        let values = values.over(&base, &[&STRENGTH]);
        let points = axis
            .values
            .iter()
            .map(|value| point(measure, &axis, value, &values));
        let points = points.collect::<Result<_, _>>()?;
        curves.push(RideCurve { label, points });
    }
    Ok(RideStudy {
        measure,
        axis: axis.name,
        curves,
    })
}

/// A label of its own, also when it is part of a quantity's name.
fn label(table: &Node, index: usize, before: &[RideCurve]) -> Result<String, Conflict> {
    let given = table.get("label");
    let span = given.map_or(&table.span, |node| &node.span);
    let label = given.map(String::deserialize).transpose();
    let label = label.map_err(|refusal| Conflict::at(span, refusal.within("ride.curve.label")))?;
    let label = label.unwrap_or((index + 1).to_string());
    let name = RideCurve::name_of(&label);
    if name.is_empty() || before.iter().any(|other| other.name() == name) {
        let (path, rule) = (
            format!("ride.curve[{index}].label"),
            "be there and differ from every other",
        );
        return Err(Conflict::at(
            span,
            Unfit::new(path, rule, format_args!("\"{label}\"")),
        ));
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

fn check_axis(measure: Measure, axis: &Axis) -> Result<(), Conflict> {
    if measure.unused().contains(&axis.name.as_str()) {
        let key = axis.name.clone();
        return Err(Conflict::at(
            &axis.key_span,
            RideProblem::Unused { key, measure },
        ));
    }
    Ok(())
}

/// What is swept must not be set as well.
fn check_free(axis: &Axis, values: &Node) -> Result<(), Conflict> {
    match place(values, &axis.name) {
        Some(span) => Err(Conflict::at(&span, axis.swept_and_set())),
        None => Ok(()),
    }
}

/// A value of the axis and its point.
fn point(
    measure: Measure,
    axis: &Axis,
    value: &AxisValue,
    values: &Node,
) -> Result<(f64, RidePoint), Conflict> {
    let no_number = || Conflict::at(&value.0.span, RideProblem::NoNumber(axis.name.clone()));
    let number = value.number().ok_or_else(no_number)?;
    let mut values = values.clone();
    values.set(&axis.name, value.0.clone());
    let (keys, settings) = keys::read(&values)?;
    let point = RidePoint::new(measure, &keys, settings).map_err(|problem| {
        let span = problem.key().and_then(|key| place(&values, key));
        Conflict {
            span,
            ..Conflict::of([""; 0], problem)
        }
    })?;
    Ok((number, point))
}

/// Where the value of a key stands, or that of a key that says the same in another way.
fn place(values: &Node, key: &str) -> Option<Range<usize>> {
    let own = [key];
    let rivals: &[&str] = if STRENGTH.contains(&key) {
        &STRENGTH
    } else {
        &own
    };
    let mut found = rivals.iter().filter_map(|key| values.get(key));
    found.next().map(|node| node.span.clone())
}

/// What the table may say, as a JSON Schema.
pub(super) fn schema(generator: &mut SchemaGenerator) -> serde_json::Value {
    let own = super::reference::properties::<RideKeys>(generator);
    let tables = super::reference::properties::<crate::monitor::Settings>(generator);
    let mut keys = own;
    for table in tables.values() {
        keys.extend(table["properties"].as_object().cloned().unwrap_or_default());
    }
    let axis = super::reference::axis(
        keys.iter()
            .map(|(key, schema)| (key.as_str(), schema.clone())),
    );
    let mut curve = keys.clone();
    curve.insert("label".to_owned(), serde_json::json!({ "type": "string" }));
    keys.insert(
        "measure".to_owned(),
        Measure::json_schema(generator).to_value(),
    );
    keys.insert("axis".to_owned(), axis);
    keys.insert(
        "curve".to_owned(),
        serde_json::json!({
            "type": "array",
            "items": { "type": "object", "properties": curve, "additionalProperties": false },
        }),
    );
    serde_json::json!({
        "description": "Whole simulated rides before the monitor, counted along `axis` for each `curve`. \
            Lengths in m, times in s; vibration, theta, quantum and jolt in units of sigma.",
        "type": "object",
        "properties": keys,
        "required": ["measure", "axis"],
        "additionalProperties": false,
    })
}
