//! The results that claims are judged by.

use super::comparison::Comparison;
use super::quantity::Quantity;
use super::scope::Scope;
use crate::stats::tally::Tally;

/// The results that claims are judged by.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// The curves and axis, if the experiment is a sweep.
    pub scope: Scope,
    /// The rows of `points.csv`.
    pub outcomes: Vec<Outcome>,
    /// The rows of `comparisons.csv`, claim by claim.
    pub comparisons: Vec<Comparison>,
    /// The rows of `quantities.csv`.
    pub quantities: Vec<Quantity>,
}

/// A rate, its position, and the exact size of its rule.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the columns of points.csv")]
pub struct Outcome {
    pub label: String,
    /// Its value on the axis, as the axis prints it.
    pub value: String,
    pub is_at_rest: bool,
    pub tally: Tally,
    pub low: f64,
    pub high: f64,
    pub alpha: f64,
    pub size: Option<f64>,
    pub reachable: Option<f64>,
}

impl Evidence {
    /// The outcomes of a curve, in motion or at rest, each with its value on the axis.
    ///
    /// A curve with an outcome for each value of the axis takes the values in order. At rest equal points are
    /// simulated once, so there may be fewer outcomes, and the values are those of their rows.
    pub fn along(&self, label: &str, is_at_rest: bool) -> Vec<(&str, &Outcome)> {
        let outcomes: Vec<&Outcome> = (self.outcomes.iter())
            .filter(|outcome| outcome.label == label && outcome.is_at_rest == is_at_rest)
            .collect();
        let values = &self.scope.axis.values;
        let has_all = outcomes.len() == values.len();
        let value = |index: usize, own| if has_all { &values[index].0 } else { own };
        (outcomes.into_iter().enumerate())
            .map(|(index, outcome)| (value(index, &outcome.value).as_str(), outcome))
            .collect()
    }

    /// The comparisons of a claim, from 1.
    pub(super) fn compared(&self, claim: usize) -> &[Comparison] {
        let of_claim = self.comparisons.chunk_by(|a, b| a.claim == b.claim);
        let mut of_claim = of_claim.filter(|chunk| chunk[0].claim == claim);
        of_claim.next().unwrap_or_default()
    }
}
