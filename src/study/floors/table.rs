//! `[floors]`: what is measured in simulated buildings, along which axis, and for which curves.

use super::keys::Keys;
use super::measure::Measure;
use crate::config::{Conflict, Node, Refusal};
use crate::experiment::schema::{self, properties};
use crate::experiment::{self, ConfigError, Experiment, Overlay};
use crate::fields::names;
use crate::rule::OutOfRange;
use crate::run::Identity;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};

/// Buildings along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub measure: Measure,
    /// The key that is swept.
    pub axis: String,
    /// The labels of the curves.
    pub labels: Vec<String>,
    /// Every point, curve by curve.
    pub points: Vec<Point>,
}

/// A curve at a value of the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub curve: usize,
    pub x: f64,
    pub keys: Keys,
}

#[derive(Deserialize)]
struct Required {
    measure: Measure,
    #[serde(rename = "axis")]
    _axis: IgnoredAny,
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
enum Problem {
    #[error(transparent)]
    Read(#[from] Refusal),
    #[error("floors: unknown key {0}")]
    UnknownKey(String),
    #[error("floors.{key}: means nothing to measure = \"{measure}\" (take it out)")]
    Unused { key: String, measure: Measure },
    #[error("floors.axis.{0}: must be numbers (a picture has them on its axis)")]
    NoNumber(String),
    #[error("floors.{0}")]
    Value(OutOfRange),
}

impl Table {
    /// Reads the table.
    ///
    /// # Errors
    /// If a key is unknown or does not affect the measure, or a value breaks its rule.
    pub fn read(experiment: &Experiment) -> Result<Self, ConfigError> {
        let table = experiment.table();
        let required = table.only(|key| ["measure", "axis"].contains(&key));
        let Required { measure, .. } = experiment.read_part(&required)?;
        Self::of(measure, table).map_err(|conflict| experiment.conflict(conflict))
    }

    fn of(measure: Measure, table: &Node) -> Result<Self, Conflict> {
        check_known(table, &["measure", "axis", "curve"])?;
        let swept: Vec<_> = names::<Keys>()
            .iter()
            .map(|key| (*key, vec![*key]))
            .collect();
        let overlay = Overlay::read(
            table,
            &experiment::Keys {
                prefix: "floors.",
                swept: &swept,
                is_parameter: &|key| names::<Keys>().contains(&key),
                choices: &[],
                name: name_of,
            },
        )?;
        let mut points = Vec::new();
        for (curve, laid) in overlay.curves.iter().enumerate() {
            check_known(&laid.header, &["label"])?;
            for value in &overlay.axis.values {
                let axis = || Problem::NoNumber(overlay.axis.name.clone());
                let x = value
                    .number()
                    .ok_or_else(|| Conflict::at(&value.0.span, axis()))?;
                let keys = read_keys(measure, &overlay.at(curve, value))?;
                points.push(Point { curve, x, keys });
            }
        }
        Ok(Self {
            measure,
            axis: overlay.axis.name.clone(),
            labels: overlay
                .curves
                .iter()
                .map(|laid| laid.label.clone())
                .collect(),
            points,
        })
    }

    /// A curve's label as part of a quantity's name.
    pub fn name(&self, curve: usize) -> String {
        name_of(&self.labels[curve])
    }
}

fn check_known(table: &Node, more: &[&'static str]) -> Result<(), Conflict> {
    let known = more.iter().chain(names::<Keys>()).copied();
    match table.unknown(known) {
        Some((span, among)) => Err(Conflict::at(&span, Problem::UnknownKey(among))),
        None => Ok(()),
    }
}

fn read_keys(measure: Measure, values: &Node) -> Result<Keys, Conflict> {
    let mut entries = values.table().into_iter().flatten();
    if let Some((key, (_, node))) = entries.find(|(key, _)| measure.unused().contains(&&key[..])) {
        let key = key.clone();
        return Err(Conflict::at(&node.span, Problem::Unused { key, measure }));
    }
    let keys = Keys::deserialize(values).map_err(|refusal| {
        let span = refusal.span.clone();
        let conflict = Conflict::of([""; 0], Problem::from(refusal.within("floors")));
        Conflict { span, ..conflict }
    })?;
    keys.check(measure).map_err(|error| {
        let span = values.get(&error.key).map(|node| node.span.clone());
        let conflict = Conflict::of([""; 0], Problem::Value(error));
        Conflict { span, ..conflict }
    })?;
    Ok(keys)
}

fn name_of(label: &str) -> String {
    let lower = label.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("_")
}

impl Point {
    /// Every parameter that changes what is counted here.
    pub fn identity(&self, measure: Measure) -> Identity {
        Identity::new(self.parameters(measure, measure.unused()))
    }

    /// What the points that share a building have in common.
    pub fn building(&self, measure: Measure) -> Identity {
        let apart = [measure.unused(), measure.shared()].concat();
        Identity::new(self.parameters(measure, &apart))
    }

    fn parameters(&self, measure: Measure, without: &[&str]) -> Vec<(String, String)> {
        let keys = serde_json::to_value(&self.keys).expect("keys are plain data");
        let keys = keys.as_object().into_iter().flatten();
        let keys = keys.filter(|(key, _)| !without.contains(&&key[..]));
        let keys = keys.map(|(key, value)| (key.clone(), value.to_string()));
        let settings =
            serde_json::to_string(&self.keys.settings()).expect("settings are plain data");
        let said = [
            ("measure".to_owned(), measure.to_string()),
            ("settings".to_owned(), settings),
        ];
        said.into_iter().chain(keys).collect()
    }
}

/// The JSON Schema of the table.
pub fn schema(generator: &mut SchemaGenerator) -> Value {
    let mut keys = properties::<Keys>(generator);
    let axis = schema::axis(
        keys.iter()
            .map(|(key, schema)| (key.as_str(), schema.clone())),
    );
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
        "description": "Floor maps of simulated buildings, counted along `axis` for each `curve`. Trips are drawn from \
            the law of their errors, without accelerometer records. Lengths in m.",
        "type": "object",
        "properties": keys,
        "required": ["measure", "axis"],
        "additionalProperties": false,
    })
}
