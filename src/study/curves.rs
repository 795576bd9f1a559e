//! Tables that measure something along an axis, for several curves: what `[ride]` and `[floors]` share.

use crate::config::{AxisValue, Conflict, Node, Refusal};
use crate::experiment::schema;
use crate::experiment::{ConfigError, Experiment, Keys, Overlay};
use crate::rule::OutOfRange;
use schemars::{JsonSchema, SchemaGenerator};
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::fmt::Display;
use std::ops::Range;

/// A point by its keys.
pub trait Keyed: Sized {
    /// The table, with a dot after it.
    const PREFIX: &'static str;
    /// What the table is, for its schema.
    const ABOUT: &'static str;
    /// Groups of keys of which a point has one.
    const CHOICES: &'static [&'static [&'static str]] = &[];
    /// What is asked of each trial.
    type Measure: Copy + Display + DeserializeOwned + JsonSchema;

    /// The keys that a curve may change and an axis may sweep.
    fn names() -> impl Iterator<Item = &'static str> + Clone;

    /// Their schemas.
    fn properties(generator: &mut SchemaGenerator) -> Map<String, Value>;

    /// Those that do not affect a measure.
    fn unused(measure: Self::Measure) -> &'static [&'static str];

    /// Makes the point of these keys.
    ///
    /// # Errors
    /// If one breaks its rule, or they do not fit each other.
    fn read(measure: Self::Measure, values: &Node) -> Result<Self, Conflict>;
}

/// Points along an axis, curve by curve.
#[derive(Clone, Debug)]
pub struct Curves<P: Keyed> {
    /// What is measured in each trial.
    pub measure: P::Measure,
    /// The key that is swept.
    pub axis: String,
    /// The labels of the curves, at least one.
    pub labels: Vec<String>,
    /// All points of the first curve, then of the next.
    pub points: Vec<Point<P>>,
}

/// A curve at a value of the axis.
#[derive(Clone, Debug)]
pub struct Point<P> {
    /// The index of the curve.
    pub curve: usize,
    /// The value.
    pub x: f64,
    /// The point itself.
    pub of: P,
}

/// The fields that the table must have. Everything else overrides defaults.
#[derive(Deserialize)]
struct Required<M> {
    measure: M,
    #[serde(rename = "axis")]
    _axis: IgnoredAny,
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
enum Problem {
    #[error(transparent)]
    Read(#[from] Refusal),
    #[error("{prefix}{error}")]
    Value {
        prefix: &'static str,
        error: OutOfRange,
    },
    #[error("{table}: unknown key {among}")]
    UnknownKey { table: &'static str, among: String },
    #[error("{prefix}{key}: means nothing to measure = \"{measure}\" (take it out)")]
    Unused {
        prefix: &'static str,
        key: String,
        measure: String,
    },
    #[error(
        "{prefix}axis.{key}: must be numbers, which a picture has on its axis (words go into [[{prefix}curve]])"
    )]
    NoNumber { prefix: &'static str, key: String },
}

/// Reads the keys of a point from their values, and checks them.
///
/// # Errors
/// If one is not what it must be.
pub fn read_keys<P: Keyed + DeserializeOwned>(
    values: &Node,
    check: impl Fn(&P) -> Result<(), OutOfRange>,
) -> Result<P, Conflict> {
    let keys = P::deserialize(values).map_err(|refusal: Refusal| {
        let span = refusal.span.clone();
        let table = P::PREFIX.trim_end_matches('.');
        let conflict = Conflict::of([""; 0], Problem::from(refusal.within(table)));
        Conflict { span, ..conflict }
    })?;
    check(&keys).map_err(|error| {
        let span = values.get(&error.key).map(|node| node.span.clone());
        let prefix = P::PREFIX;
        let conflict = Conflict::of([""; 0], Problem::Value { prefix, error });
        Conflict { span, ..conflict }
    })?;
    Ok(keys)
}

impl<P: Keyed + Serialize> Point<P> {
    /// The measure and every key but these, with their values.
    pub fn parameters(&self, measure: P::Measure, without: &[&str]) -> Vec<(String, String)> {
        let keys = serde_json::to_value(&self.of).expect("keys are plain data");
        let keys = keys.as_object().into_iter().flatten();
        let keys = keys.filter(|(key, _)| !without.contains(&&key[..]));
        let keys = keys.map(|(key, value)| (key.clone(), value.to_string()));
        let measure = ("measure".to_owned(), measure.to_string());
        [measure].into_iter().chain(keys).collect()
    }
}

impl<P: Keyed> Curves<P> {
    /// Reads the table.
    ///
    /// # Errors
    /// If a key is unknown or does not affect the measure, or a point is refused.
    pub fn parse(experiment: &Experiment) -> Result<Self, ConfigError> {
        let table = experiment.table();
        let required = table.only(|key| ["measure", "axis"].contains(&key));
        let Required { measure, .. } = experiment.read_part(&required)?;
        Self::of(measure, table).map_err(|conflict| experiment.conflict(conflict))
    }

    fn of(measure: P::Measure, table: &Node) -> Result<Self, Conflict> {
        check_known::<P>(table, &["measure", "axis", "curve"])?;
        let swept: Vec<_> = P::names().map(|key| (key, vec![key])).collect();
        let keys = Keys {
            prefix: P::PREFIX,
            swept: &swept,
            is_parameter: &|key| P::names().any(|known| known == key),
            choices: P::CHOICES,
            name: name_of,
        };
        let overlay = Overlay::read(table, &keys)?;
        let axis = &overlay.axis;
        if P::unused(measure).contains(&axis.name.as_str()) {
            return Err(unused::<P>(measure, &axis.name, &axis.key_span));
        }
        let mut points = Vec::new();
        for (curve, laid) in overlay.curves.iter().enumerate() {
            check_known::<P>(&laid.header, &["label"])?;
            check_used::<P>(measure, &laid.values)?;
            for value in &axis.values {
                let x = number::<P>(value, &axis.name)?;
                let of = P::read(measure, &overlay.at(curve, value))?;
                points.push(Point { curve, x, of });
            }
        }
        let labels = overlay.curves.into_iter().map(|laid| laid.label).collect();
        let axis = overlay.axis.name;
        Ok(Self {
            measure,
            axis,
            labels,
            points,
        })
    }

    /// A curve, from 1, at a value of the axis, as a part of the name of a quantity.
    pub fn name_at(&self, curve: usize, x: f64) -> String {
        let curve = name_of(&self.labels[curve - 1]);
        format!("{curve}_at_{}", x.to_string().replace('.', "_"))
    }
}

fn unused<P: Keyed>(measure: P::Measure, key: &str, place: &Range<usize>) -> Conflict {
    let problem = Problem::Unused {
        prefix: P::PREFIX,
        key: key.to_owned(),
        measure: measure.to_string(),
    };
    Conflict::at(place, problem)
}

/// Refuses the first key that does not affect the measure.
fn check_used<P: Keyed>(measure: P::Measure, values: &Node) -> Result<(), Conflict> {
    let mut entries = values.table().into_iter().flatten();
    match entries.find(|(key, _)| P::unused(measure).contains(&&key[..])) {
        Some((key, (_, node))) => Err(unused::<P>(measure, key, &node.span)),
        None => Ok(()),
    }
}

/// Refuses the first key of a table that is neither a parameter nor in `more`.
fn check_known<P: Keyed>(table: &Node, more: &[&'static str]) -> Result<(), Conflict> {
    let Some((span, among)) = table.unknown(more.iter().copied().chain(P::names())) else {
        return Ok(());
    };
    let table = P::PREFIX.trim_end_matches('.');
    Err(Conflict::at(&span, Problem::UnknownKey { table, among }))
}

fn number<P: Keyed>(value: &AxisValue, axis: &str) -> Result<f64, Conflict> {
    let problem = || Problem::NoNumber {
        prefix: P::PREFIX,
        key: axis.to_owned(),
    };
    value
        .number()
        .ok_or_else(|| Conflict::at(&value.0.span, problem()))
}

/// A label as part of a quantity's name: letters and digits, with `_` for anything between.
pub fn name_of(label: &str) -> String {
    let lower = label.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("_")
}

/// The JSON Schema of the table.
pub fn schema<P: Keyed>(generator: &mut SchemaGenerator) -> Value {
    let mut keys = P::properties(generator);
    let axis = keys
        .iter()
        .map(|(key, schema)| (key.as_str(), schema.clone()));
    let axis = schema::axis(axis);
    let mut curve = keys.clone();
    curve.insert("label".to_owned(), json!({ "type": "string" }));
    let measure = P::Measure::json_schema(generator).to_value();
    let curve = json!({
        "type": "array",
        "items": { "type": "object", "properties": curve, "additionalProperties": false },
    });
    for (key, schema) in [("measure", measure), ("axis", axis), ("curve", curve)] {
        keys.insert(key.to_owned(), schema);
    }
    json!({
        "description": P::ABOUT,
        "type": "object",
        "properties": keys,
        "required": ["measure", "axis"],
        "additionalProperties": false,
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn labels_become_names() {
        assert_eq!(super::name_of("σ = 0.4 m/s², 100 Hz"), "σ_0_4_m_s²_100_hz");
    }
}
