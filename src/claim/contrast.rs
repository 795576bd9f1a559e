//! One curve against another, value by value: above it, or equivalent to it?

use super::words::{at, compared, curve as named, interval, ranges};
use super::{ClaimError, Judgement, Verdict};
use crate::experiment::{Axis, Claim, Contrast, Contrasts};
use crate::results::Comparison;

/// What is sure of a difference.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Greater,
    Smaller,
    Equal,
    Open,
}

/// Two curves, series or panels and what was counted of them.
pub(super) struct Compared<'a> {
    pub claim: &'a Claim,
    pub contrasts: &'a Contrasts,
    /// Of this claim.
    pub comparisons: &'a [&'a Comparison],
    pub axis: Option<&'a Axis>,
}

impl Compared<'_> {
    pub fn exceeds(&self) -> Result<Judgement, ClaimError> {
        let (margin, comparisons) = (self.claim.margin, self.comparisons);
        let any = |wanted| comparisons.iter().any(|c| self.side(c) == wanted);
        let (greater, smaller) = (any(Side::Greater), any(Side::Smaller));
        let verdict = if greater && comparisons.iter().all(|c| c.low >= -margin) {
            Verdict::Holds
        } else if greater && smaller {
            Verdict::HoldsWhere(self.places(|side, _| side == Side::Greater))
        } else if smaller || comparisons.iter().all(|c| c.high <= margin) {
            Verdict::DoesNotHold
        } else {
            Verdict::Undecided
        };
        let rule = format!("nowhere below by more than {margin} and somewhere above by more");
        self.judgement(verdict, &rule)
    }

    pub fn equals(&self) -> Result<Judgement, ClaimError> {
        let sides: Vec<Side> = self.comparisons.iter().map(|c| self.side(c)).collect();
        let is_outside = |side: &Side| matches!(side, Side::Greater | Side::Smaller);
        // Curves that cross are equal where they cross: a single value proves nothing.
        let is_equal = |side, has_neighbour| side == Side::Equal && has_neighbour;
        let verdict = if sides.iter().all(|side| *side == Side::Equal) {
            Verdict::Holds
        } else if !sides.iter().any(is_outside) {
            Verdict::Undecided
        } else {
            match self.places(is_equal) {
                nowhere if nowhere.is_empty() => Verdict::DoesNotHold,
                somewhere => Verdict::HoldsWhere(somewhere),
            }
        };
        let rule = format!("equivalent within ± {} everywhere", self.claim.margin);
        self.judgement(verdict, &rule)
    }

    fn side(&self, comparison: &Comparison) -> Side {
        let &Comparison { low, high, .. } = comparison;
        let margin = self.claim.margin;
        match () {
            () if low > margin => Side::Greater,
            () if high < -margin => Side::Smaller,
            () if low >= -margin && high <= margin => Side::Equal,
            () => Side::Open,
        }
    }

    /// A verdict with its numbers and its rule; none where nothing has been compared.
    fn judgement(&self, verdict: Verdict, rule: &str) -> Result<Judgement, ClaimError> {
        match self.comparisons.is_empty() {
            true => Err(ClaimError::NotCompared(self.contrasts.first.clone())),
            false => Ok(Judgement {
                verdict,
                evidence: self.extremes(),
                how: self.how(rule),
            }),
        }
    }

    /// The values of the axis that are `wanted`, by their side and whether a neighbour is on the same;
    /// a contrast that is wanted throughout by the name of its place.
    fn places(&self, wanted: impl Fn(Side, bool) -> bool) -> String {
        let place = |contrast: &Contrast| {
            let of_it = self.comparisons.iter().filter(|c| is_of(contrast, c));
            let sides: Vec<(&str, Side)> = of_it
                .map(|c| (c.first_value.as_str(), self.side(c)))
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
                ("", _) => Some(ranges(self.axis, &values)),
                (place, all) if all == values.len() => Some(place.to_owned()),
                (place, _) => Some(format!("{place}: {}", ranges(self.axis, &values))),
            }
        };
        let places = self.contrasts.each.iter().filter_map(place);
        places.collect::<Vec<_>>().join("; ")
    }

    /// The smallest and the largest difference.
    fn extremes(&self) -> String {
        let order = |a: &&&Comparison, b: &&&Comparison| a.difference.total_cmp(&b.difference);
        let said = |c: &Comparison| {
            let number = interval(c.difference, c.low, c.high);
            let value = at(self.axis, &c.first_value);
            let each = &self.contrasts.each;
            match each.iter().find(|contrast| is_of(contrast, c)) {
                Some(Contrast { place, .. }) if !place.is_empty() => {
                    format!("{number} at {value} ({place})")
                }
                _ => format!("{number} at {value}"),
            }
        };
        let comparisons = self.comparisons.iter();
        let ends = comparisons
            .clone()
            .min_by(order)
            .zip(comparisons.max_by(order));
        match ends {
            Some((smallest, largest)) if self.comparisons.len() > 1 => {
                format!("differences from {} to {}", said(smallest), said(largest))
            }
            Some((only, _)) => format!("difference {}", said(only)),
            None => String::new(),
        }
    }

    fn how(&self, rule: &str) -> String {
        format!(
            "{} against {}: {rule}; {}, family-wise level {}",
            named(&self.contrasts.first),
            named(&self.contrasts.second),
            compared(self.comparisons),
            self.claim.level,
        )
    }
}

fn is_of(contrast: &Contrast, comparison: &Comparison) -> bool {
    comparison.first_curve == contrast.first && comparison.second_curve == contrast.second
}
