//! Rules for the values that the table of a study lists.

use crate::config::Conflict;
use crate::rule::OutOfRange;
use std::fmt::{Debug, Display};
use std::ops::RangeInclusive;

/// Refuses a number outside a range.
pub(super) fn within(
    path: &str,
    value: usize,
    allowed: RangeInclusive<usize>,
) -> Result<(), Conflict> {
    if allowed.contains(&value) {
        return Ok(());
    }
    let rule = format!("lie in {} to {}", allowed.start(), allowed.end());
    Err(OutOfRange::new(path, rule, value).into())
}

/// Refuses an empty list, a list of more than `most` values, and the first value that occurs twice.
pub(super) fn distinct<T: PartialEq + Debug>(
    path: &str,
    [one, several]: [&str; 2],
    most: usize,
    values: &[T],
    show: impl Fn(&T) -> String,
) -> Result<(), Conflict> {
    if values.is_empty() {
        return Err(OutOfRange::new(path, format!("list at least one {one}"), "none").into());
    }
    if values.len() > most {
        return Err(
            OutOfRange::new(path, format!("list at most {most} {several}"), values.len()).into(),
        );
    }
    let again = (1..values.len()).find(|&i| values[..i].contains(&values[i]));
    match again {
        Some(i) => {
            let got = format!("{} twice", show(&values[i]));
            Err(OutOfRange::new(format!("{path}[{i}]"), "differ from the others", got).into())
        }
        None => Ok(()),
    }
}

/// Refuses the first value that breaks a rule.
pub(super) fn each<T: Display>(
    path: &str,
    values: &[T],
    rule: &str,
    holds: impl Fn(&T) -> bool,
) -> Result<(), Conflict> {
    match values.iter().position(|value| !holds(value)) {
        Some(i) => Err(OutOfRange::new(format!("{path}[{i}]"), rule, &values[i]).into()),
        None => Ok(()),
    }
}
