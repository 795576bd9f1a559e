//! `quantities.csv`, the single numbers of an experiment, and the claim that one lies in a range.
//!
//! An interval may be open: if a search ends without a crossing, only a bound is known. Then `value` is that
//! bound, and the side beyond it is infinite. An open side neither lies inside a range that ends on that side
//! nor outside it, so only the other side can decide.

use super::words::{exact, interval};
use super::{ClaimError, Judgement, Verdict};
use serde::{Deserialize, Serialize};

/// A named number with its interval; an exact one is its own interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// The name, in snake case.
    pub name: String,
    /// The estimate, or the bound if only one side is known.
    pub value: f64,
    /// Lower end of the interval; −∞ if it is open.
    pub low: f64,
    /// Upper end of the interval; +∞ if it is open.
    pub high: f64,
}

impl Quantity {
    /// A number without uncertainty.
    pub fn exact(name: &str, value: f64) -> Self {
        Self {
            name: name.to_owned(),
            value,
            low: value,
            high: value,
        }
    }
}

pub(super) fn judge(
    name: &str,
    [from, to]: [Option<f64>; 2],
    quantities: &[Quantity],
) -> Result<Judgement, ClaimError> {
    let &Quantity {
        value, low, high, ..
    } = named_quantity(name, quantities)?;
    let start = from.unwrap_or(f64::NEG_INFINITY);
    let end = to.unwrap_or(f64::INFINITY);
    let verdict = if low >= start && high <= end {
        Verdict::Holds
    } else if high < start || low > end {
        Verdict::DoesNotHold
    } else {
        Verdict::Undecided
    };
    let range = match (from, to) {
        (Some(from), Some(to)) => format!("in [{}, {}]", exact(from), exact(to)),
        (Some(from), None) => format!("at least {}", exact(from)),
        _ => format!("at most {}", exact(end)),
    };
    Ok(Judgement {
        verdict,
        evidence: interval(value, low, high),
        how: if low == high {
            format!("`{name}` {range}, exactly")
        } else {
            format!("the interval of `{name}` {range}")
        },
    })
}

/// The quantity of this name.
///
/// # Errors
/// If there is no such quantity.
pub fn named_quantity<'a>(
    name: &str,
    quantities: &'a [Quantity],
) -> Result<&'a Quantity, ClaimError> {
    let named = quantities.iter().find(|quantity| quantity.name == name);
    named.ok_or_else(|| {
        let known: Vec<&str> = quantities.iter().map(|q| q.name.as_str()).collect();
        ClaimError::NoQuantity {
            name: name.to_owned(),
            known: if known.is_empty() {
                "none".to_owned()
            } else {
                known.join(", ")
            },
        }
    })
}
