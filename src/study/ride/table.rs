//! `[ride]`: what is measured on rides, along which axis, and for which curves.
//!
//! Accelerations are in m/s², times in s. One of three keys gives the strength of the noise. `sigma` is the
//! deviation of a sample. `density` is the one-sided root density of the noise in m/s²/√Hz: it belongs to the
//! sensor and does not depend on the sampling rate, so sigma = density √(rate/2). `delta_over_sigma` is the
//! drive's acceleration in units of sigma. Vibration, θ, quantum and jolt are in units of sigma.

use super::keys::{self, RideKeys, STRENGTH};
use super::measure::Measure;
use super::point::RidePoint;
use super::problem::RideProblem;
use crate::config::{AxisValue, Conflict, Node};
use crate::experiment::schema::{self, properties};
use crate::experiment::{ConfigError, Experiment, Keys, Overlay};
use crate::monitor::Settings;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};
use std::ops::Range;

/// Rides along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct RideTable {
    /// What is measured in each trial.
    pub measure: Measure,
    /// The key that is swept.
    pub axis: String,
    /// The curves, at least one.
    pub curves: Vec<RideCurve>,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct RideCurve {
    /// The label that distinguishes it from other curves.
    pub label: String,
    /// Each value of the axis and the point of this curve there.
    pub points: Vec<(f64, RidePoint)>,
}

/// The fields that the table must have. Everything else overrides defaults.
#[derive(Deserialize)]
struct Required {
    measure: Measure,
    #[serde(rename = "axis")]
    _axis: IgnoredAny,
}

impl RideTable {
    /// Reads the table.
    ///
    /// # Errors
    /// If a key is unknown or does not affect the measure, or a point cannot be simulated.
    pub fn read(experiment: &Experiment) -> Result<Self, ConfigError> {
        let table = experiment.table();
        let required = table.only(|key| ["measure", "axis"].contains(&key));
        let Required { measure, .. } = experiment.read_part(&required)?;
        Self::of(measure, table).map_err(|conflict| experiment.conflict(conflict))
    }

    fn of(measure: Measure, table: &Node) -> Result<Self, Conflict> {
        keys::check_known(table, &["measure", "axis", "curve"])?;
        let swept: Vec<_> = keys::all().map(|key| (key, vec![key])).collect();
        let overlay = Overlay::read(
            table,
            &Keys {
                prefix: "ride.",
                swept: &swept,
                is_parameter: &|key| keys::all().any(|known| known == key),
                choices: &[&STRENGTH],
                name: name_of,
            },
        )?;
        let axis = &overlay.axis;
        if measure.unused().contains(&axis.name.as_str()) {
            return Err(refuse(measure, &axis.name, &axis.key_span));
        }
        let mut curves = Vec::new();
        for (index, laid) in overlay.curves.iter().enumerate() {
            keys::check_known(&laid.header, &["label"])?;
            let points = axis.values.iter();
            let points = points.map(|value| point(measure, &overlay, index, value));
            curves.push(RideCurve {
                label: laid.label.clone(),
                points: points.collect::<Result<_, _>>()?,
            });
        }
        Ok(Self {
            measure,
            axis: axis.name.clone(),
            curves,
        })
    }
}

fn refuse(measure: Measure, key: &str, place: &Range<usize>) -> Conflict {
    let key = key.to_owned();
    Conflict::at(place, RideProblem::Unused { key, measure })
}

/// Refuses the first key that does not affect the measure.
fn check_used(measure: Measure, values: &Node) -> Result<(), Conflict> {
    let mut entries = values.table().into_iter().flatten();
    match entries.find(|(key, _)| measure.unused().contains(&&key[..])) {
        Some((key, (_, node))) => Err(refuse(measure, key, &node.span)),
        None => Ok(()),
    }
}

impl RideCurve {
    /// Its label as part of a quantity's name: letters and digits, with `_` for anything between.
    pub fn name(&self) -> String {
        name_of(&self.label)
    }
}

fn name_of(label: &str) -> String {
    let lower = label.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("_")
}

/// Reads a value of the axis and makes its point.
fn point(
    measure: Measure,
    overlay: &Overlay,
    curve: usize,
    value: &AxisValue,
) -> Result<(f64, RidePoint), Conflict> {
    let axis = &overlay.axis.name;
    let no_number = || Conflict::at(&value.0.span, RideProblem::NoNumber(axis.clone()));
    let number = value.number().ok_or_else(no_number)?;
    check_used(measure, &overlay.curves[curve].values)?;
    let values = overlay.at(curve, value);
    let (keys, settings) = keys::read(&values)?;
    let point = RidePoint::new(measure, keys, settings).map_err(|problem| {
        let span = problem.key().and_then(|key| place(&values, key));
        Conflict {
            span,
            ..Conflict::of([""; 0], problem)
        }
    })?;
    Ok((number, point))
}

/// The place of a key's value in the file, or of the value of a key that expresses the same in another way.
fn place(values: &Node, key: &str) -> Option<Range<usize>> {
    let rivals = STRENGTH.iter().filter(|_| STRENGTH.contains(&key));
    let mut found = [&key]
        .into_iter()
        .chain(rivals)
        .filter_map(|key| values.get(key));
    found.next().map(|node| node.span.clone())
}

/// The JSON Schema of the table.
pub fn schema(generator: &mut SchemaGenerator) -> Value {
    let mut keys = properties::<RideKeys>(generator);
    for table in properties::<Settings>(generator).values() {
        keys.extend(table["properties"].as_object().cloned().unwrap_or_default());
    }
    let axis = keys
        .iter()
        .map(|(key, schema)| (key.as_str(), schema.clone()));
    let axis = schema::axis(axis);
    let mut curve = keys.clone();
    curve.insert("label".to_owned(), json!({ "type": "string" }));
    let measure = Measure::json_schema(generator).to_value();
    let curve = json!({
        "type": "array",
        "items": { "type": "object", "properties": curve, "additionalProperties": false },
    });
    for (key, schema) in [("measure", measure), ("axis", axis), ("curve", curve)] {
        keys.insert(key.to_owned(), schema);
    }
    json!({
        "description": "Whole simulated rides before the monitor, counted along `axis` for each `curve`. \
            Lengths in m, times in s; vibration, theta, quantum and jolt in units of sigma.",
        "type": "object",
        "properties": keys,
        "required": ["measure", "axis"],
        "additionalProperties": false,
    })
}
