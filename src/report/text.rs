//! Numbers in a paragraph: placeholders that name what is to stand in their place.
//!
//! | placeholder | becomes |
//! |---|---|
//! | `{rate:LABEL@VALUE}` | the rate of a curve at a value of the axis, with its interval |
//! | `{false_alarm:LABEL}`, `{false_alarm:LABEL@VALUE}` | the same at rest |
//! | `{size:LABEL}`, `{size:LABEL@VALUE}` | the exact size of its region |
//! | `{quantity:NAME}` | a single number |

use crate::claim::words::{exact, interval};
use crate::claim::{ClaimError, Evidence, named_quantity, placed};
use crate::results::Row;

/// Why a placeholder stands for nothing.
#[derive(Debug, thiserror::Error)]
pub enum PlaceholderError {
    /// A brace alone.
    #[error("`{0}` does not end (close the brace)")]
    Open(String),
    /// Not one of the four.
    #[error("unknown placeholder {{{0}}} (one of rate, false_alarm, size, quantity)")]
    Unknown(String),
    /// No such curve, or no row of it under this hypothesis.
    #[error("{{{placeholder}}}: no such curve (one of {known})")]
    Curve {
        /// As written.
        placeholder: String,
        /// The labels that would do.
        known: String,
    },
    /// No such value, or none given where there are several.
    #[error("{{{placeholder}}}: needs a value of the axis (@ and one of {known})")]
    Value {
        /// As written.
        placeholder: String,
        /// The values that would do.
        known: String,
    },
    /// No such quantity.
    #[error("{{{placeholder}}}: {error}")]
    Quantity {
        /// As written.
        placeholder: String,
        /// What is wrong.
        error: ClaimError,
    },
}

/// The text with every placeholder replaced.
///
/// # Errors
/// Where one stands for nothing.
pub fn fill(text: &str, evidence: &Evidence) -> Result<String, PlaceholderError> {
    let mut parts = text.split('{');
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let Some((placeholder, rest)) = part.split_once('}') else {
            let start: String = part.chars().take(20).collect();
            return Err(PlaceholderError::Open(format!("{{{start}")));
        };
        filled += &value(placeholder, evidence)?;
        filled += rest;
    }
    Ok(filled)
}

fn value(placeholder: &str, evidence: &Evidence) -> Result<String, PlaceholderError> {
    let unknown = || PlaceholderError::Unknown(placeholder.to_owned());
    let (kind, name) = placeholder.split_once(':').ok_or_else(unknown)?;
    let rate = |row: &Row| interval(row.rate, row.low, row.high);
    match kind {
        "rate" => {
            let is_at_rest = !is_there(evidence, name, false);
            find(placeholder, name, evidence, is_at_rest, rate)
        }
        "false_alarm" => find(placeholder, name, evidence, true, rate),
        "size" => {
            let is_at_rest = !is_there(evidence, name, false);
            find(placeholder, name, evidence, is_at_rest, |row| {
                exact(row.size)
            })
        }
        "quantity" => named_quantity(name, evidence.quantities)
            .map(|quantity| interval(quantity.value, quantity.low, quantity.high))
            .map_err(|error| PlaceholderError::Quantity {
                placeholder: placeholder.to_owned(),
                error,
            }),
        _ => Err(unknown()),
    }
}

/// The label and the value of `LABEL@VALUE`. A label may hold an @ of its own.
fn parts<'a>(evidence: &Evidence, name: &'a str) -> (&'a str, Option<&'a str>) {
    let is_label = evidence.rows.iter().any(|row| row.label == name);
    match name.rsplit_once('@') {
        Some((label, value)) if !is_label => (label, Some(value)),
        _ => (name, None),
    }
}

/// Whether the curve has rows of this kind.
fn is_there(evidence: &Evidence, name: &str, is_at_rest: bool) -> bool {
    let (label, _) = parts(evidence, name);
    let mut rows = evidence.rows.iter();
    rows.any(|row| row.label == label && row.is_at_rest() == is_at_rest)
}

/// What `show` makes of the row that a placeholder names. Without a value, all rows of the curve must
/// show the same.
fn find(
    placeholder: &str,
    name: &str,
    evidence: &Evidence,
    is_at_rest: bool,
    show: impl Fn(&Row) -> String,
) -> Result<String, PlaceholderError> {
    let (label, value) = parts(evidence, name);
    let rows = placed(evidence.axis, evidence.rows, label, is_at_rest);
    let placeholder = placeholder.to_owned();
    if rows.is_empty() {
        let known = labels(evidence, is_at_rest);
        return Err(PlaceholderError::Curve { placeholder, known });
    }
    let is_meant = |there: &str| value.is_none_or(|value| is_same(value, there));
    let mut shown: Vec<String> = (rows.iter())
        .filter(|(there, _)| is_meant(there))
        .map(|(_, row)| show(row))
        .collect();
    shown.dedup();
    match shown.len() {
        1 => Ok(shown.remove(0)),
        _ => {
            let values: Vec<&str> = rows.iter().map(|(value, _)| value.as_str()).collect();
            let known = values.join(", ");
            Err(PlaceholderError::Value { placeholder, known })
        }
    }
}

/// 1 and 1.0 are the same value.
fn is_same(a: &str, b: &str) -> bool {
    match (a.trim().parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a.trim() == b,
    }
}

/// The curves that have rows of this kind.
fn labels(evidence: &Evidence, is_at_rest: bool) -> String {
    let rows = evidence
        .rows
        .iter()
        .filter(|row| row.is_at_rest() == is_at_rest);
    let mut labels: Vec<&str> = rows.map(|row| row.label.as_str()).collect();
    labels.dedup();
    labels.join(", ")
}
