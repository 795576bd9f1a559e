//! The x axis: one key and the values it takes, as a list or as `{ from, to, step }`.

use super::refusal::Refusal;
use super::source::Conflict;
use super::tree::{Node, Value};
use crate::suggest::among;
use serde::Deserialize;
use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

/// A swept key and its values, with their positions in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The swept key.
    pub name: String,
    /// At least one.
    pub values: Vec<AxisValue>,
    /// The position of the key.
    pub key_span: Range<usize>,
    /// The position of all values.
    pub span: Range<usize>,
}

/// One value of an axis, as written in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisValue(pub Node);

/// `{ from, to, step }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Steps {
    from: f64,
    to: f64,
    step: f64,
}

/// Why an axis was refused.
#[derive(Debug, thiserror::Error)]
enum AxisError {
    #[error("axis: exactly one key says what is swept, got {0} (for instance delta = [0.0, 1.0])")]
    Keys(usize),
    #[error("axis: unknown parameter {0}")]
    Unknown(String),
    #[error("axis.{0}: no values (list some, or give from, to and step)")]
    Empty(String),
    #[error("axis.{name}: step must be positive, got {step}")]
    Step { name: String, step: f64 },
    #[error("axis.{name}: from = {from} lies above to = {to} (exchange them)")]
    Reversed { name: String, from: f64, to: f64 },
    #[error(
        "axis.{name}: step = {step} is lost in the twelve digits of from = {from} (raise step)"
    )]
    Lost { name: String, step: f64, from: f64 },
    #[error(
        "axis.{name}: steps of {step} from {from} end at {last}, not at to = {to} (set to = {last}, or change step)"
    )]
    Missed {
        name: String,
        from: f64,
        to: f64,
        step: f64,
        last: f64,
    },
    #[error("axis.{name}: the value {value} is listed twice (remove one)")]
    Repeated { name: String, value: String },
    #[error("axis.{name}: {points:.0} points, more than {MOST_POINTS} (raise step)")]
    TooMany { name: String, points: f64 },
    #[error("axis.{name}: {refusal}")]
    Value { name: String, refusal: Refusal },
}

/// More points than this on one axis are a mistake.
const MOST_POINTS: usize = 10_000;

impl Axis {
    /// Reads an axis table, whose one key must be `known`.
    ///
    /// # Errors
    /// If there is not one key, an unknown one, or no values.
    pub fn read<'a>(
        table: &Node,
        known: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Result<Self, Conflict> {
        let entries = table.table().into_iter().flatten();
        let mut entries: Vec<_> = entries.collect();
        entries.sort_by_key(|(_, (key_span, _))| key_span.start);
        let [(name, (key_span, node))] = &entries[..] else {
            // The second key is the one too many.
            let span = entries.get(1).map_or(&table.span, |(_, (span, _))| span);
            return Err(Conflict::at(span, AxisError::Keys(entries.len())));
        };
        if !known.clone().into_iter().any(|known| known == *name) {
            let error = AxisError::Unknown(among(&crate::format::shorten(name), known));
            return Err(Conflict::at(key_span, error));
        }
        let values = values(name, node).map_err(|error| Conflict::at(&node.span, error))?;
        check_distinct(name, &values)?;
        Ok(Self {
            name: (*name).clone(),
            key_span: key_span.clone(),
            values,
            span: node.span.clone(),
        })
    }
}

impl Axis {
    /// The error message for a key that is both swept and set.
    pub fn swept_and_set(&self) -> String {
        let name = &self.name;
        format!(
            "the axis sweeps {name}, so it cannot be set here too (take it out here, or sweep another)"
        )
    }
}

impl AxisValue {
    /// The value as a number, if it is one.
    pub fn number(&self) -> Option<f64> {
        self.0.number()
    }
}

/// A number in the fewest digits, a name as it is, a table by its name.
impl fmt::Display for AxisValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0.value {
            Value::Text(name) | Value::Date(name) => f.write_str(name),
            Value::Integer(number) => write!(f, "{number}"),
            Value::Float(number) => write!(f, "{number}"),
            Value::Bool(flag) => write!(f, "{flag}"),
            Value::Table(table) => f.write_str(table.keys().next().map_or("", |key| key)),
            Value::List(_) => f.write_str("a list"),
        }
    }
}

/// The values of a list, or of a range.
fn values(name: &str, node: &Node) -> Result<Vec<AxisValue>, AxisError> {
    let values = match &node.value {
        Value::List(list) if list.len() > MOST_POINTS => {
            let (name, points) = (name.to_owned(), list.len() as f64);
            return Err(AxisError::TooMany { name, points });
        }
        Value::List(list) => list.clone(),
        Value::Table(_) => {
            let steps = Steps::deserialize(node).map_err(|refusal| {
                let name = name.to_owned();
                AxisError::Value { name, refusal }
            })?;
            let place = |value| Node {
                span: node.span.clone(),
                value,
            };
            range(name, &steps)?.into_iter().map(place).collect()
        }
        _ => vec![node.clone()],
    };
    if values.is_empty() {
        return Err(AxisError::Empty(name.to_owned()));
    }
    Ok(values.into_iter().map(AxisValue).collect())
}

/// Refuses a value that is the same as an earlier one.
fn check_distinct(name: &str, values: &[AxisValue]) -> Result<(), Conflict> {
    let mut seen = HashSet::new();
    for AxisValue(node) in values {
        let is_new = match &node.value {
            Value::Text(text) => seen.insert(text.clone()),
            // 1 and 1.0 are one number, and so are 0 and -0.
            _ => (node.number()).is_none_or(|number| seen.insert((number + 0.0).to_string())),
        };
        if !is_new {
            let (name, value) = (name.to_owned(), AxisValue(node.clone()).to_string());
            return Err(Conflict::at(
                &node.span,
                AxisError::Repeated { name, value },
            ));
        }
    }
    Ok(())
}

/// from, from + step, …, to; whole numbers stay whole.
fn range(name: &str, &Steps { from, to, step }: &Steps) -> Result<Vec<Value>, AxisError> {
    let name = name.to_owned();
    if step <= 0.0 {
        return Err(AxisError::Step { name, step });
    }
    if from > to {
        return Err(AxisError::Reversed { name, from, to });
    }
    // A billionth of a step absorbs the rounding of (to − from)/step.
    let points = ((to - from) / step + 1e-9).floor() + 1.0;
    if points > MOST_POINTS as f64 {
        return Err(AxisError::TooMany { name, points });
    }
    let number = |i: usize| {
        let value = from + i as f64 * step;
        // A rounding error around zero becomes an exact zero.
        if value.abs() < 1e-9 * step {
            0.0
        } else {
            twelve_digits(value)
        }
    };
    let last = number(points as usize - 1);
    // The last value has twelve digits, and the number of steps an error of a billionth.
    if (to - last).abs() > 1e-8 * step + 1e-11 * to.abs() {
        return Err(AxisError::Missed {
            name,
            from,
            to,
            step,
            last,
        });
    }
    let is_whole = from.fract() == 0.0 && step.fract() == 0.0;
    let value = |i: usize| {
        let value = number(i);
        if is_whole && value.fract() == 0.0 && value.abs() < 1e15 {
            Value::Integer(value as i64)
        } else {
            Value::Float(value)
        }
    };
    let values: Vec<Value> = (0..points as usize).map(value).collect();
    if values.windows(2).any(|pair| pair[0] == pair[1]) {
        return Err(AxisError::Lost { name, step, from });
    }
    Ok(values)
}

/// The nearest number of twelve significant digits: 0.1 + 2 · 0.1 is meant to be 0.3.
fn twelve_digits(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(value: &str) -> Vec<f64> {
        let root = Node::parse(&format!("x = {value}")).unwrap();
        let axis = Axis::read(&root, ["x"]).unwrap();
        axis.values
            .iter()
            .map(|value| value.number().unwrap())
            .collect()
    }

    #[test]
    fn ranges_are_what_they_say() {
        let range = numbers("{ from = 0.0, to = 3.0, step = 0.1 }");
        assert_eq!(range.len(), 31);
        assert_eq!((range[3], range[30]), (0.3, 3.0));
        assert_eq!(numbers("{ from = -0.7, to = 0.7, step = 0.1 }")[7], 0.0);
        assert_eq!(numbers("{ from = 2, to = 8, step = 3 }"), [2.0, 5.0, 8.0]);
        assert_eq!(numbers("{ from = 1.0, to = 1.0, step = 0.5 }"), [1.0]);
        assert_eq!(numbers("[1, 2.5]"), [1.0, 2.5]);
    }

    #[test]
    fn what_is_not_meant_is_refused() {
        let refusal = |value: &str| {
            let root = Node::parse(&format!("x = {value}")).unwrap();
            let Err(conflict) = Axis::read(&root, ["x"]) else {
                panic!("{value} is accepted")
            };
            conflict.error.to_string()
        };
        let missed =
            "axis.x: steps of 3 from 2 end at 8, not at to = 9 (set to = 8, or change step)";
        assert_eq!(refusal("{ from = 2, to = 9, step = 3 }"), missed);
        assert!(refusal("{ from = 0.0, to = 1.0, step = 0.3 }").contains("end at 0.9"));
        assert!(refusal("{ from = 0.0, to = 1.0, step = 2.0 }").contains("end at 0,"));
        assert!(refusal("{ from = -0.3, to = 0.05, step = 0.1 }").contains("end at 0,"));
        assert!(
            refusal("{ from = 1e6, to = 1000000.0005, step = 0.001 }").contains("end at 1000000,")
        );
        for repeated in ["[1, 2, 1.0]", "[0.0, -0.0]", "[\"auto\", 2, \"auto\"]"] {
            assert!(refusal(repeated).contains("is listed twice"), "{repeated}");
        }
    }

    /// A step that twelve digits cannot resolve is refused; any larger step gives all points.
    #[test]
    fn a_step_is_not_lost() {
        for (from, step, is_lost) in [(1e11, 1.0, false), (1e12, 1.0, true), (1e15, 1e5, false)] {
            let to = from + 5.0 * step;
            let text = format!("x = {{ from = {from:?}, to = {to:?}, step = {step:?} }}");
            let axis = Axis::read(&Node::parse(&text).unwrap(), ["x"]);
            assert_eq!(axis.is_err(), is_lost, "{text}");
            if let Err(Conflict { error, .. }) = axis {
                assert!(error.to_string().contains("is lost"), "{error}");
            }
        }
    }
}
