//! The pairs of points that claims compare.

use super::{Claim, Comparison, Place, Scope, Test};
use crate::stats::tally::Tally;

/// Two points to compare for a claim; the first is the one expected to be greater.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The index of the claim in the config, from 0.
    pub claim: usize,
    /// Index of the first point in the plan.
    pub first: usize,
    /// Index of the second.
    pub second: usize,
    /// The positions of both points.
    pub places: [Place; 2],
}

/// The pairs compared for all claims, claim by claim; `points` has, for each curve, the index of its point at
/// each value of the axis.
///
/// For growth the pairs are, curve by curve, each value of the axis against the one before and then the
/// last against the first (the same pair if there are only two values); for a contrast of curves, both at
/// each value of the axis.
pub fn pairs(claims: &[Claim], scope: &Scope, points: &[Vec<usize>]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (claim, Claim { test, .. }) in claims.iter().enumerate() {
        for [first, second] in compared(test, scope) {
            let point = |(curve, value): (usize, usize)| points[curve][value];
            let place = |(curve, value): (usize, usize)| Place {
                curve: scope.curves[curve].label.clone(),
                value: scope.axis.values[value].0.clone(),
            };
            pairs.push(Pair {
                claim,
                first: point(first),
                second: point(second),
                places: [place(first), place(second)],
            });
        }
    }
    pairs
}

/// An upper bound of the number of pairs.
pub fn number_of_pairs(claims: &[Claim], scope: &Scope) -> usize {
    claims
        .iter()
        .map(|claim| compared(&claim.test, scope).len())
        .sum()
}

/// The pairs of a test, each point as a curve and a value of the axis.
fn compared(test: &Test, scope: &Scope) -> Vec<[(usize, usize); 2]> {
    let values = scope.axis.values.len();
    match test {
        Test::Grows { curves } => (scope.named(curves.as_deref()).into_iter())
            .flat_map(|curve| {
                let steps = (1..values).map(move |value| [(curve, value), (curve, value - 1)]);
                let overall = (values > 2).then_some([(curve, values - 1), (curve, 0)]);
                steps.chain(overall)
            })
            .collect(),
        Test::Exceeds(contrasts) | Test::Equals(contrasts) => {
            let contrasts = scope.contrasts(contrasts).into_iter();
            contrasts
                .flat_map(|c| (0..values).map(move |value| [(c.first, value), (c.second, value)]))
                .collect()
        }
        Test::AlphaHeld { .. } | Test::Quantity { .. } | Test::Gain { .. } => Vec::new(),
    }
}

/// The confidence of each of `pairs` comparisons, so that all intervals cover with probability 1 − level at
/// least.
pub fn confidence(claim: &Claim, pairs: usize) -> f64 {
    1.0 - claim.level.get() / pairs as f64
}

/// The rows of `comparisons.csv`: one per pair. `discordant` has, for each pair that shares its noise,
/// the trials in which only the first and only the second decided H₁.
pub fn comparisons(
    claims: &[Claim],
    pairs: &[Pair],
    tallies: &[Tally],
    discordant: &[Option<[u64; 2]>],
) -> Vec<Comparison> {
    let mut numbers = vec![0; claims.len()];
    for pair in pairs {
        numbers[pair.claim] += 1;
    }
    let compared = pairs.iter().zip(discordant);
    compared
        .map(|(pair, discordant)| {
            let Pair {
                claim,
                first,
                second,
                places,
            } = pair;
            // Two curves may share a point, which does not differ from itself.
            let itself = (first == second).then_some([0, 0]);
            let confidence = confidence(&claims[*claim], numbers[*claim]);
            Comparison::new(
                claim + 1,
                places.clone(),
                [tallies[*first], tallies[*second]],
                itself.or(*discordant),
                confidence,
            )
        })
        .collect()
}
