//! Numbers in a paragraph: placeholders and their replacement.
//!
//! | placeholder | becomes |
//! |---|---|
//! | `{rate:LABEL@VALUE}` | the rate of a curve at a value of the axis, with its interval |
//! | `{false_alarm:LABEL}`, `{false_alarm:LABEL@VALUE}` | the same at rest |
//! | `{size:LABEL}`, `{size:LABEL@VALUE}` | the exact size of its region |
//! | `{reachable:LABEL}`, `{reachable:LABEL@VALUE}` | the smallest level that its rule can be held to |
//! | `{quantity:NAME}` | a single number |

use crate::claim::words::{exact, interval};
use crate::claim::{ClaimError, Evidence, Outcome, named_quantity};
use crate::suggest::among;

/// Why a placeholder cannot be replaced.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum PlaceholderError {
    #[error("`{0}` does not end (close the brace)")]
    Open(String),
    #[error("unknown placeholder {{{0}}} (one of rate, false_alarm, size, reachable, quantity)")]
    Unknown(String),
    #[error("{{{placeholder}}}: there are no curves here (write {{quantity:NAME}})")]
    NoCurves { placeholder: String },
    #[error("{{{placeholder}}}: unknown curve {curve}")]
    Curve { placeholder: String, curve: String },
    #[error("{{{placeholder}}}: needs a value of the axis (@ and one of {known})")]
    Value { placeholder: String, known: String },
    #[error("{{{placeholder}}}: {error}")]
    Results {
        placeholder: String,
        error: ClaimError,
    },
}

/// The text with every placeholder replaced.
///
/// # Errors
/// If a placeholder does not name a result.
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
    let Some((kind, name)) = placeholder.split_once(':') else {
        return Err(PlaceholderError::Unknown(placeholder.to_owned()));
    };
    match kind {
        "rate" | "false_alarm" | "size" | "reachable" => {
            let outcomes = named(placeholder, kind, name, evidence)?;
            let shown: Vec<String> = outcomes.iter().map(|(_, o)| show(kind, o)).collect();
            // Many points may share one size, but a rate belongs to one point.
            let is_shared = matches!(kind, "size" | "reachable");
            if shown.len() == 1 || is_shared && shown.iter().all(|one| *one == shown[0]) {
                Ok(shown[0].clone())
            } else {
                Err(needs_value(placeholder, &outcomes))
            }
        }
        "quantity" => match named_quantity(name, &evidence.quantities) {
            Ok(quantity) => Ok(interval(quantity.value, quantity.low, quantity.high)),
            Err(error) => Err(results(placeholder, error)),
        },
        _ => Err(PlaceholderError::Unknown(placeholder.to_owned())),
    }
}

fn show(kind: &str, outcome: &Outcome) -> String {
    match kind {
        "size" => outcome.size.map_or("no exact size".to_owned(), exact),
        "reachable" => (outcome.reachable).map_or("no smallest level".to_owned(), exact),
        _ => interval(outcome.tally.rate(), outcome.low, outcome.high),
    }
}

/// The outcomes that a placeholder names, at least one, each with its value on the axis: at rest if asked for or
/// if the curve never moves, else in motion.
fn named<'a>(
    placeholder: &str,
    kind: &str,
    name: &str,
    evidence: &'a Evidence,
) -> Result<Vec<(&'a str, &'a Outcome)>, PlaceholderError> {
    let labels = evidence
        .scope
        .curves
        .iter()
        .map(|curve| curve.label.as_str());
    // A label may contain an @ itself.
    let (label, value) = match name.rsplit_once('@') {
        Some((label, value)) if !labels.clone().any(|label| label == name) => (label, Some(value)),
        _ => (name, None),
    };
    if !labels.clone().any(|known| known == label) {
        let placeholder = placeholder.to_owned();
        if evidence.scope.curves.is_empty() {
            return Err(PlaceholderError::NoCurves { placeholder });
        }
        let curve = among(label, labels);
        return Err(PlaceholderError::Curve { placeholder, curve });
    }
    let moving = evidence.along(label, false);
    let outcomes = if kind == "false_alarm" || moving.is_empty() {
        evidence.along(label, true)
    } else {
        moving
    };
    if outcomes.is_empty() {
        return Err(results(placeholder, ClaimError::NoRest(label.to_owned())));
    }
    let is_meant = |there: &str| value.is_none_or(|value| is_same(value, there));
    let meant: Vec<_> = outcomes
        .iter()
        .copied()
        .filter(|(there, _)| is_meant(there))
        .collect();
    if meant.is_empty() {
        return Err(needs_value(placeholder, &outcomes));
    }
    Ok(meant)
}

fn needs_value(placeholder: &str, outcomes: &[(&str, &Outcome)]) -> PlaceholderError {
    let known: Vec<&str> = outcomes.iter().map(|(value, _)| *value).collect();
    PlaceholderError::Value {
        placeholder: placeholder.to_owned(),
        known: known.join(", "),
    }
}

fn results(placeholder: &str, error: ClaimError) -> PlaceholderError {
    let placeholder = placeholder.to_owned();
    PlaceholderError::Results { placeholder, error }
}

/// 1 and 1.0 are the same value.
fn is_same(a: &str, b: &str) -> bool {
    match (a.trim().parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a.trim() == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Axis, Curve, Scope};
    use crate::stats::tally::Tally;

    /// Three curves, of which only the first has rows at rest; the last has no rows.
    fn evidence() -> Evidence {
        let outcome = |label: &str, is_at_rest, value: &str| Outcome {
            label: label.to_owned(),
            value: value.to_owned(),
            is_at_rest,
            tally: Tally { hits: 1, trials: 2 },
            low: 0.25,
            high: 0.75,
            alpha: 0.01,
            size: None,
            reachable: None,
        };
        let curve = |label: &str| Curve {
            label: label.to_owned(),
            panel: None,
            series: None,
        };
        Evidence {
            scope: Scope {
                curves: ["weak", "strong", "none"].map(curve).to_vec(),
                axis: Axis::default(),
            },
            outcomes: vec![
                outcome("weak", true, "0"),
                outcome("weak", false, "1"),
                outcome("strong", false, "1"),
            ],
            ..Evidence::default()
        }
    }

    #[test]
    fn refusals_name_what_would_do() {
        let refused = |text: &str| fill(text, &evidence()).unwrap_err().to_string();
        let all = "(one of weak, strong, none)";
        for kind in ["rate", "false_alarm", "size", "reachable"] {
            assert_eq!(
                refused(&format!("{{{kind}:stong@1}}")),
                format!("{{{kind}:stong@1}}: unknown curve `stong`, did you mean `strong`? {all}")
            );
        }
        assert!(refused("{false_alarm:strong}").contains("no row at rest of its own"));
        assert!(refused("{rate:none}").contains("no row at rest of its own"));
        assert!(refused("{rate:weak@2}").contains("(@ and one of 1)"));
        assert_eq!(
            fill("{rate:strong@1.0}", &evidence()).unwrap(),
            "0.50 [0.25, 0.75]"
        );
    }
}
