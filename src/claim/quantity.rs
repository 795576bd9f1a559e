//! Does a number lie in a range?

use super::words::{exact, interval};
use super::{ClaimError, Judgement, Verdict};
use crate::results::Quantity;

pub(super) fn judge(
    name: &str,
    [from, to]: [Option<f64>; 2],
    quantities: &[Quantity],
) -> Result<Judgement, ClaimError> {
    let quantity = named_quantity(name, quantities)?;
    let &Quantity {
        value, low, high, ..
    } = quantity;
    let (start, end) = (
        from.unwrap_or(f64::NEG_INFINITY),
        to.unwrap_or(f64::INFINITY),
    );
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
        how: match low == high {
            true => format!("`{name}` {range}, exactly"),
            false => format!("the interval of `{name}` {range}"),
        },
    })
}

/// The quantity of this name.
///
/// # Errors
/// Where there is none.
pub fn named_quantity<'a>(
    name: &str,
    quantities: &'a [Quantity],
) -> Result<&'a Quantity, ClaimError> {
    let mut named = quantities.iter();
    named.find(|quantity| quantity.name == name).ok_or_else(|| {
        let known: Vec<&str> = quantities.iter().map(|q| q.name.as_str()).collect();
        let known = match known.is_empty() {
            true => "none".to_owned(),
            false => known.join(", "),
        };
        let name = name.to_owned();
        ClaimError::NoQuantity { name, known }
    })
}
