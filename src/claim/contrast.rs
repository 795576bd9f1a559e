//! One curve against another, value by value: above it, or equivalent to it?

use super::words::{at, compared, curve as named, interval, ranges};
use super::{ClaimError, Judgement, Verdict};
use crate::config::{Axis, Claim, Contrast, Contrasts};
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
    contrasts: &Contrasts,
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
) -> Result<Judgement, ClaimError> {
    let margin = claim.margin;
    let any = |wanted| comparisons.iter().any(|c| side(c, margin) == wanted);
    let (greater, smaller) = (any(Side::Greater), any(Side::Smaller));
    let verdict = if greater && comparisons.iter().all(|c| c.low >= -margin) {
        Verdict::Holds
    } else if greater && smaller {
        let is_greater = |side: Side, _: bool| side == Side::Greater;
        Verdict::HoldsWhere(places(contrasts, comparisons, margin, axis, is_greater))
    } else if smaller || comparisons.iter().all(|c| c.high <= margin) {
        Verdict::DoesNotHold
    } else {
        Verdict::Undecided
    };
    let rule = format!("nowhere below by more than {margin} and somewhere above by more");
    judgement(claim, contrasts, comparisons, axis, verdict, &rule)
}

pub(super) fn equals(
    claim: &Claim,
    contrasts: &Contrasts,
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
) -> Result<Judgement, ClaimError> {
    let margin = claim.margin;
    let sides: Vec<Side> = comparisons.iter().map(|c| side(c, margin)).collect();
    let is_outside = |side: &Side| matches!(side, Side::Greater | Side::Smaller);
    // Curves that cross are equal where they cross: a single value proves nothing.
    let is_equal = |side: Side, has_neighbour: bool| side == Side::Equal && has_neighbour;
    let verdict = if sides.iter().all(|side| *side == Side::Equal) {
        Verdict::Holds
    } else if !sides.iter().any(is_outside) {
        Verdict::Undecided
    } else {
        match places(contrasts, comparisons, margin, axis, is_equal) {
            nowhere if nowhere.is_empty() => Verdict::DoesNotHold,
            somewhere => Verdict::HoldsWhere(somewhere),
        }
    };
    let rule = format!("equivalent within ± {margin} everywhere");
    judgement(claim, contrasts, comparisons, axis, verdict, &rule)
}

/// A verdict with its numbers and its rule; none where nothing has been compared.
fn judgement(
    claim: &Claim,
    contrasts: &Contrasts,
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
    verdict: Verdict,
    rule: &str,
) -> Result<Judgement, ClaimError> {
    match comparisons.is_empty() {
        true => Err(ClaimError::NotCompared(contrasts.first.clone())),
        false => Ok(Judgement {
            verdict,
            evidence: extremes(contrasts, comparisons, axis),
            how: how(claim, contrasts, comparisons, rule),
        }),
    }
}

fn is_of(contrast: &Contrast, comparison: &Comparison) -> bool {
    comparison.first_curve == contrast.first && comparison.second_curve == contrast.second
}

/// The values of the axis that are `wanted`, by their side and whether a neighbour is on the same;
/// a contrast that is wanted throughout by the name of its place.
fn places(
    contrasts: &Contrasts,
    comparisons: &[&Comparison],
    margin: f64,
    axis: Option<&Axis>,
    wanted: impl Fn(Side, bool) -> bool,
) -> String {
    let place = |contrast: &Contrast| {
        let of_it = comparisons.iter().filter(|c| is_of(contrast, c));
        let sides: Vec<(&str, Side)> = of_it
            .map(|c| (c.first_value.as_str(), side(c, margin)))
            .collect();
        let is_wanted = |index: usize| {
            let own = sides[index].1;
            let is_same =
                |other: Option<&(&str, Side)>| other.is_some_and(|(_, side)| *side == own);
            let before = index.checked_sub(1).and_then(|before| sides.get(before));
            wanted(own, is_same(before) || is_same(sides.get(index + 1)))
        };
        let values: Vec<(&str, bool)> = (0..sides.len())
            .map(|index| (sides[index].0, is_wanted(index)))
            .collect();
        let chosen = values.iter().filter(|(_, is_wanted)| *is_wanted).count();
        match (contrast.place.as_str(), chosen) {
            (_, 0) => None,
            ("", _) => Some(ranges(axis, &values)),
            (place, all) if all == values.len() => Some(place.to_owned()),
            (place, _) => Some(format!("{place}: {}", ranges(axis, &values))),
        }
    };
    let places = contrasts.each.iter().filter_map(place);
    places.collect::<Vec<_>>().join("; ")
}

/// The smallest and the largest difference.
fn extremes(contrasts: &Contrasts, comparisons: &[&Comparison], axis: Option<&Axis>) -> String {
    let order = |a: &&&Comparison, b: &&&Comparison| a.difference.total_cmp(&b.difference);
    let said = |c: &Comparison| {
        let number = interval(c.difference, c.low, c.high);
        let value = at(axis, &c.first_value);
        match contrasts.each.iter().find(|contrast| is_of(contrast, c)) {
            Some(Contrast { place, .. }) if !place.is_empty() => {
                format!("{number} at {value} ({place})")
            }
            _ => format!("{number} at {value}"),
        }
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

fn how(claim: &Claim, contrasts: &Contrasts, comparisons: &[&Comparison], rule: &str) -> String {
    format!(
        "{} against {}: {rule}; {}, family-wise level {}",
        named(&contrasts.first),
        named(&contrasts.second),
        compared(comparisons),
        claim.level,
    )
}
