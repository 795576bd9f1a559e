//! One curve against another, value by value: above it, or equivalent to it?

use super::words::{at, count, curve as named, interval, ranges};
use super::{ClaimError, Judgement, Verdict};
use crate::config::{Axis, Claim};
use crate::results::Comparison;

/// What is sure of a difference.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Greater,
    Smaller,
    Equal,
    Open,
}

fn side(comparison: &Comparison, margin: f64) -> Side {
    let &Comparison { low, high, .. } = comparison;
    match () {
        () if low > margin => Side::Greater,
        () if high < -margin => Side::Smaller,
        () if low >= -margin && high <= margin => Side::Equal,
        () => Side::Open,
    }
}

pub(super) fn exceeds(
    claim: &Claim,
    curves: [&String; 2],
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
) -> Result<Judgement, ClaimError> {
    check(curves, comparisons)?;
    let margin = claim.margin;
    let any = |wanted| comparisons.iter().any(|c| side(c, margin) == wanted);
    let (greater, smaller) = (any(Side::Greater), any(Side::Smaller));
    let verdict = if greater && comparisons.iter().all(|c| c.low >= -margin) {
        Verdict::Holds
    } else if greater && smaller {
        Verdict::HoldsWhere(places(comparisons, margin, axis, Side::Greater))
    } else if smaller || comparisons.iter().all(|c| c.high <= margin) {
        Verdict::DoesNotHold
    } else {
        Verdict::Undecided
    };
    let rule = format!("nowhere below by more than {margin} and somewhere above by more");
    Ok(Judgement {
        verdict,
        evidence: extremes(comparisons, axis),
        how: how(claim, curves, comparisons.len(), &rule),
    })
}

pub(super) fn equals(
    claim: &Claim,
    curves: [&String; 2],
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
) -> Result<Judgement, ClaimError> {
    check(curves, comparisons)?;
    let margin = claim.margin;
    let sides: Vec<Side> = comparisons.iter().map(|c| side(c, margin)).collect();
    let is_outside = |side: &Side| matches!(side, Side::Greater | Side::Smaller);
    let verdict = if sides.iter().all(|side| *side == Side::Equal) {
        Verdict::Holds
    } else if !sides.iter().any(is_outside) {
        Verdict::Undecided
    } else if sides.contains(&Side::Equal) {
        Verdict::HoldsWhere(places(comparisons, margin, axis, Side::Equal))
    } else {
        Verdict::DoesNotHold
    };
    let rule = format!("equivalent within ± {margin} everywhere");
    Ok(Judgement {
        verdict,
        evidence: extremes(comparisons, axis),
        how: how(claim, curves, comparisons.len(), &rule),
    })
}

fn check(curves: [&String; 2], comparisons: &[&Comparison]) -> Result<(), ClaimError> {
    match comparisons.is_empty() {
        true => Err(ClaimError::NotCompared(curves[0].clone())),
        false => Ok(()),
    }
}

/// The values of the axis on one side.
fn places(comparisons: &[&Comparison], margin: f64, axis: Option<&Axis>, wanted: Side) -> String {
    let values = comparisons
        .iter()
        .map(|c| (c.first_value.as_str(), side(c, margin) == wanted));
    ranges(axis, &values.collect::<Vec<_>>())
}

/// The smallest and the largest difference.
fn extremes(comparisons: &[&Comparison], axis: Option<&Axis>) -> String {
    let order = |a: &&&Comparison, b: &&&Comparison| a.difference.total_cmp(&b.difference);
    let said = |c: &Comparison| {
        let number = interval(c.difference, c.low, c.high);
        format!("{number} at {}", at(axis, &c.first_value))
    };
    let ends = comparisons
        .iter()
        .min_by(order)
        .zip(comparisons.iter().max_by(order));
    match ends {
        Some((smallest, largest)) if comparisons.len() > 1 => {
            format!("differences from {} to {}", said(smallest), said(largest))
        }
        Some((only, _)) => format!("difference {}", said(only)),
        None => String::new(),
    }
}

fn how(claim: &Claim, [first, second]: [&String; 2], comparisons: usize, rule: &str) -> String {
    format!(
        "{} against {}: {rule}; {}, family-wise level {}",
        named(first),
        named(second),
        count(comparisons, "comparison"),
        claim.level,
    )
}
