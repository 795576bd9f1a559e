//! The tests `exceeds` and `equals`: one curve against another, value by value.

use super::scope::Contrast;
use super::words::{compared, counter_examples, curve as named, interval};
use super::{Claim, ClaimError, Comparison, Contrasts, Evidence, Judgement, Verdict};

/// What an interval shows about a difference.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Greater,
    Smaller,
    Equal,
    Open,
}

/// Two curves, series or panels, and their comparisons for a claim.
struct Compared<'a> {
    claim: &'a Claim,
    names: &'a Contrasts,
    contrasts: Vec<Contrast<'a>>,
    /// The claim's comparisons, at least one.
    comparisons: &'a [Comparison],
    evidence: &'a Evidence,
}

pub(super) fn exceeds(
    claim: &Claim,
    number: usize,
    names: &Contrasts,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let compared = Compared::new(claim, number, names, evidence)?;
    let margin = claim.margin.get();
    let smaller = compared.on(&[Side::Smaller]);
    let is_below_nowhere = compared.comparisons.iter().all(|c| c.low >= -margin);
    let is_above_nowhere = compared.comparisons.iter().all(|c| c.high <= margin);
    let verdict = if !smaller.is_empty() {
        compared.where_on(Side::Greater)
    } else if is_above_nowhere {
        Verdict::DoesNotHold
    } else if is_below_nowhere && !compared.on(&[Side::Greater]).is_empty() {
        Verdict::Holds
    } else {
        Verdict::Undecided
    };
    let rule = format!("nowhere below by more than {margin} and somewhere above by more");
    Ok(compared.judgement(verdict, &smaller, &rule))
}

pub(super) fn equals(
    claim: &Claim,
    number: usize,
    names: &Contrasts,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let compared = Compared::new(claim, number, names, evidence)?;
    let outside = compared.on(&[Side::Greater, Side::Smaller]);
    let verdict = if !outside.is_empty() {
        compared.where_on(Side::Equal)
    } else if !compared.on(&[Side::Open]).is_empty() {
        Verdict::Undecided
    } else {
        Verdict::Holds
    };
    let rule = format!("equivalent within ± {} everywhere", claim.margin.get());
    Ok(compared.judgement(verdict, &outside, &rule))
}

impl<'a> Compared<'a> {
    fn new(
        claim: &'a Claim,
        number: usize,
        names: &'a Contrasts,
        evidence: &'a Evidence,
    ) -> Result<Self, ClaimError> {
        let comparisons = evidence.compared(number);
        if comparisons.is_empty() {
            return Err(ClaimError::NotCompared(names.first.clone()));
        }
        let contrasts = evidence.scope.contrasts(names);
        Ok(Self {
            claim,
            names,
            contrasts,
            comparisons,
            evidence,
        })
    }

    fn side(&self, comparison: &Comparison) -> Side {
        let &Comparison { low, high, .. } = comparison;
        let margin = self.claim.margin.get();
        if low > margin {
            Side::Greater
        } else if high < -margin {
            Side::Smaller
        } else if low >= -margin && high <= margin {
            Side::Equal
        } else {
            Side::Open
        }
    }

    /// The comparisons on one of these sides.
    fn on(&self, sides: &[Side]) -> Vec<&'a Comparison> {
        (self.comparisons.iter())
            .filter(|comparison| sides.contains(&self.side(comparison)))
            .collect()
    }

    fn is_of(&self, contrast: &Contrast, comparison: &Comparison) -> bool {
        let label = |index: usize| &self.evidence.scope.curves[index].label;
        comparison.first_curve == *label(contrast.first)
            && comparison.second_curve == *label(contrast.second)
    }

    /// The verdict on a claim that is refuted somewhere, and shown where the difference is on this side.
    fn where_on(&self, side: Side) -> Verdict {
        Verdict::where_shown(self.contrasts.iter().map(|contrast| {
            let of_it = self.comparisons.iter().filter(|c| self.is_of(contrast, c));
            let values: Vec<(&str, bool)> = of_it
                .map(|c| (c.first_value.as_str(), self.side(c) == side))
                .collect();
            self.evidence.scope.axis.shown(contrast.place, &values)
        }))
    }

    fn judgement(&self, verdict: Verdict, refuting: &[&Comparison], rule: &str) -> Judgement {
        let all = self.comparisons.len();
        let size = |it: &&&Comparison| it.difference.abs();
        let worst = (refuting.iter()).max_by(|a, b| size(a).total_cmp(&size(b)));
        let worst = worst.map(|worst| self.place(worst));
        Judgement {
            verdict,
            evidence: self.extremes() + &counter_examples(refuting.len(), all, "comparison", worst),
            how: format!(
                "{} against {}: {rule}; {}, family-wise level {}",
                named(&self.names.first),
                named(&self.names.second),
                compared(self.comparisons),
                self.claim.level.get(),
            ),
        }
    }

    /// The smallest and the largest difference.
    fn extremes(&self) -> String {
        let mut ascending: Vec<&Comparison> = self.comparisons.iter().collect();
        ascending.sort_by(|a, b| a.difference.total_cmp(&b.difference));
        let smallest = self.difference(ascending[0]);
        if ascending.len() == 1 {
            return format!("difference {smallest}");
        }
        let largest = self.difference(ascending[ascending.len() - 1]);
        format!("differences from {smallest} to {largest}")
    }

    fn difference(&self, comparison: &Comparison) -> String {
        let number = interval(comparison.difference, comparison.low, comparison.high);
        format!("{number} at {}", self.place(comparison))
    }

    /// `Δ/σ_ξ = 0.6 (impulses in Y_2 alone)`.
    fn place(&self, comparison: &Comparison) -> String {
        let value = self.evidence.scope.axis.at(&comparison.first_value);
        let contrast = self
            .contrasts
            .iter()
            .find(|contrast| self.is_of(contrast, comparison));
        match contrast.map(|contrast| contrast.place) {
            None | Some("") => value,
            Some(place) => format!("{value} ({place})"),
        }
    }
}
