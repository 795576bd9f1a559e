//! Numbers in a paragraph: placeholders that name what is to stand in their place.
//!
//! | placeholder | becomes |
//! |---|---|
//! | `{rate:LABEL@VALUE}` | the rate of a curve at a value of the axis, with its interval |
//! | `{false_alarm:LABEL}`, `{false_alarm:LABEL@VALUE}` | the same at rest |
//! | `{size:LABEL}`, `{size:LABEL@VALUE}` | the exact size of its region |
//! | `{reachable:LABEL}`, `{reachable:LABEL@VALUE}` | the smallest level that its rule can be held to |
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
    #[error("unknown placeholder {{{0}}} (one of rate, false_alarm, size, reachable, quantity)")]
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
    if kind == "quantity" {
        return quantity(placeholder, name, evidence);
    }
    if !["rate", "false_alarm", "size", "reachable"].contains(&kind) {
        return Err(unknown());
    }
    let is_at_rest = kind == "false_alarm" || !moves(evidence, name);
    let rows = find(placeholder, name, evidence, is_at_rest)?;
    let show = |row: &Row| match kind {
        "size" => row.size.map_or("no exact size".to_owned(), exact),
        "reachable" => row.reachable.map_or("no smallest level".to_owned(), exact),
        _ => interval(row.rate, row.low, row.high),
    };
    // Many points may share one size; a rate is one point's.
    let is_shared = ["size", "reachable"].contains(&kind);
    let is_one =
        rows.len() == 1 || is_shared && rows.iter().all(|(_, r)| show(r) == show(rows[0].1));
    match is_one {
        true => Ok(show(rows[0].1)),
        false => Err(PlaceholderError::Value {
            placeholder: placeholder.to_owned(),
            known: values(&rows),
        }),
    }
}

fn quantity(
    placeholder: &str,
    name: &str,
    evidence: &Evidence,
) -> Result<String, PlaceholderError> {
    match named_quantity(name, evidence.quantities) {
        Ok(quantity) => Ok(interval(quantity.value, quantity.low, quantity.high)),
        Err(error) => Err(PlaceholderError::Quantity {
            placeholder: placeholder.to_owned(),
            error,
        }),
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

/// Whether the curve has rows in motion.
fn moves(evidence: &Evidence, name: &str) -> bool {
    let (label, _) = parts(evidence, name);
    let mut rows = evidence.rows.iter();
    rows.any(|row| row.label == label && !row.is_at_rest())
}

/// The rows that a placeholder names, at least one.
fn find<'a>(
    placeholder: &str,
    name: &str,
    evidence: &Evidence<'a>,
    is_at_rest: bool,
) -> Result<Vec<(String, &'a Row)>, PlaceholderError> {
    let (label, value) = parts(evidence, name);
    let rows = placed(evidence.axis, evidence.rows, label, is_at_rest);
    let placeholder = placeholder.to_owned();
    if rows.is_empty() {
        let known = labels(evidence, placeholder.starts_with("false_alarm"));
        return Err(PlaceholderError::Curve { placeholder, known });
    }
    let is_meant = |there: &str| value.is_none_or(|value| is_same(value, there));
    let meant: Vec<_> = (rows.iter())
        .filter(|(there, _)| is_meant(there))
        .cloned()
        .collect();
    match meant.is_empty() {
        true => Err(PlaceholderError::Value {
            placeholder,
            known: values(&rows),
        }),
        false => Ok(meant),
    }
}

fn values(rows: &[(String, &Row)]) -> String {
    let values: Vec<&str> = rows.iter().map(|(value, _)| value.as_str()).collect();
    values.join(", ")
}

/// 1 and 1.0 are the same value.
fn is_same(a: &str, b: &str) -> bool {
    match (a.trim().parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a.trim() == b,
    }
}

/// Every curve, or those alone that have rows at rest.
fn labels(evidence: &Evidence, must_rest: bool) -> String {
    let mut labels: Vec<&str> = Vec::new();
    for row in evidence.rows {
        if (row.is_at_rest() || !must_rest) && !labels.contains(&row.label.as_str()) {
            labels.push(&row.label);
        }
    }
    labels.join(", ")
}
