//! `points.csv` of a sweep: one row per point and hypothesis, with every parameter.
//!
//! Its columns are the row's own and, between them, those of the table of parameters.

use crate::claim::Outcome;
use crate::counts::DecisionSummary;
use crate::format::eight_digits;
use crate::plan::{Hypothesis, Point};
use crate::scenario::{Parameter, Scenario, Values, columns};
use crate::stats::tally::Tally;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::ser::{SerializeStruct, Serializer};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A point, its decision rule and its counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The number of the curve, from 1.
    pub curve: usize,
    /// The label of the curve.
    pub label: String,
    /// `H0` or `H1`.
    pub hypothesis: String,
    /// P(ϑ | H₀), if an exact law gives it.
    pub size: Option<f64>,
    /// The confidence of the interval.
    pub confidence: f64,
    /// The number of decisions for H₁ and of trials.
    pub tally: Tally,
    /// The threshold of a score.
    pub threshold: Option<f64>,
    /// The smallest level that its rule can reach.
    pub reachable: Option<f64>,
    /// The values of all parameters.
    pub values: Values,
}

/// The number of parameters written before the counts; columns added later come after them.
const BEFORE_COUNTS: usize = 11;

impl Row {
    /// The row of a point, with its decision if it is known.
    pub fn new(
        point: &Point,
        decision: Option<DecisionSummary>,
        tally: Tally,
        confidence: f64,
    ) -> Self {
        let decision = decision.unwrap_or(DecisionSummary {
            size: point.design.size(),
            threshold: None,
            reachable: None,
        });
        Self {
            curve: point.curve + 1,
            label: point.label.clone(),
            hypothesis: match point.hypothesis {
                Hypothesis::H0 => "H0".to_owned(),
                Hypothesis::H1 => "H1".to_owned(),
            },
            size: decision.size,
            confidence,
            tally,
            threshold: decision.threshold,
            reachable: decision.reachable,
            values: Values::of(&point.scenario),
        }
    }

    /// The summary of the decision.
    pub fn decision(&self) -> DecisionSummary {
        DecisionSummary {
            size: self.size,
            threshold: self.threshold,
            reachable: self.reachable,
        }
    }

    /// α.
    pub fn alpha(&self) -> f64 {
        self.values.number("alpha")
    }

    /// Its position on an axis of numbers.
    pub fn on_axis(&self, parameter: &Parameter) -> Option<f64> {
        self.values.cell(parameter.column()).number()
    }

    /// The part that claims and texts use, on an axis of this parameter.
    pub fn outcome(&self, parameter: &Parameter) -> Outcome {
        let (low, high) = self.tally.interval(self.confidence);
        Outcome {
            label: self.label.clone(),
            value: match self.on_axis(parameter) {
                Some(number) => number.to_string(),
                None if parameter.name == "rule" => self.values.rule_name(),
                None => "none".to_owned(),
            },
            is_at_rest: self.is_at_rest(),
            tally: self.tally,
            low: eight_digits(low),
            high: eight_digits(high),
            alpha: self.alpha(),
            size: self.size,
            reachable: self.reachable,
        }
    }

    /// Whether the point is at rest.
    pub fn is_at_rest(&self) -> bool {
        self.hypothesis == "H0"
    }
}

/// Every parameter of a scenario by its column.
pub fn parameters(scenario: &Scenario) -> Vec<(String, String)> {
    let values = Values::of(scenario);
    let named = values
        .iter()
        .map(|(name, cell)| (name.to_owned(), cell.to_string()));
    named.collect()
}

impl Serialize for Row {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (low, high) = self.tally.interval(self.confidence);
        let mut row = serializer.serialize_struct("Row", columns().count() + 12)?;
        row.serialize_field("curve", &self.curve)?;
        row.serialize_field("label", &self.label)?;
        row.serialize_field("hypothesis", &self.hypothesis)?;
        for (name, cell) in self.values.iter().take(BEFORE_COUNTS) {
            row.serialize_field(name, cell)?;
        }
        row.serialize_field("size", &self.size)?;
        row.serialize_field("trials", &self.tally.trials)?;
        row.serialize_field("detections", &self.tally.hits)?;
        row.serialize_field("rate", &self.tally.rate())?;
        row.serialize_field("low", &eight_digits(low))?;
        row.serialize_field("high", &eight_digits(high))?;
        row.serialize_field("confidence", &self.confidence)?;
        for (name, cell) in self.values.iter().skip(BEFORE_COUNTS) {
            row.serialize_field(name, cell)?;
        }
        row.serialize_field("threshold", &self.threshold)?;
        row.serialize_field("reachable", &self.reachable)?;
        row.end()
    }
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RowVisitor)
    }
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Row;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a row of a sweep")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Row, A::Error> {
        let mut row = Row {
            curve: 0,
            label: String::new(),
            hypothesis: String::new(),
            size: None,
            confidence: 0.0,
            tally: Tally::default(),
            threshold: None,
            reachable: None,
            values: Values::unknown(),
        };
        let mut seen = 0;
        while let Some(name) = map.next_key::<String>()? {
            seen += 1;
            match name.as_str() {
                "curve" => row.curve = map.next_value()?,
                "label" => row.label = map.next_value()?,
                "hypothesis" => row.hypothesis = map.next_value()?,
                "size" => row.size = map.next_value()?,
                "trials" => row.tally.trials = map.next_value()?,
                "detections" => row.tally.hits = map.next_value()?,
                "confidence" => row.confidence = map.next_value()?,
                "threshold" => row.threshold = map.next_value()?,
                "reachable" => row.reachable = map.next_value()?,
                // These follow from the counts.
                "rate" | "low" | "high" => drop(map.next_value::<f64>()?),
                name => {
                    if !row.values.set(name, map.next_value()?) {
                        return Err(A::Error::custom(format_args!("unknown column {name}")));
                    }
                }
            }
        }
        if seen != columns().count() + 12 {
            return Err(A::Error::custom("columns are missing"));
        }
        if row.tally.hits > row.tally.trials || row.tally.trials == 0 {
            let Tally { hits, trials } = row.tally;
            return Err(A::Error::custom(format_args!(
                "{hits} detections in {trials} trials"
            )));
        }
        Ok(row)
    }
}

/// Rows as a CSV file.
pub fn csv_bytes<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("a row is plain data");
    }
    writer.into_inner().expect("a vector takes every byte")
}
