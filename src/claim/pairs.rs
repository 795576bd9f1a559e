//! The pairs of points that claims compare.

use super::place::point_at;
use crate::experiment::{Claim, Config, Contrast, Test};
use crate::plan::Point;
use crate::results::{Comparison, Place};
use crate::stats::tally::Tally;

/// Two points to compare for a claim; the first is the one expected to be greater.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// Which claim of the config, from 0.
    pub claim: usize,
    /// Index of the first point in the plan.
    pub first: usize,
    /// Index of the second.
    pub second: usize,
    /// Where the two stand.
    pub places: [Place; 2],
}

/// Every pair that the claims of a config ask for, claim by claim.
///
/// For growth these are, curve by curve, each value of the axis against the one before and then the
/// last against the first (the same pair where there are but two values); for a contrast of curves,
/// both at each value of the axis.
pub fn pairs(config: &Config, points: &[Point]) -> Vec<Pair> {
    let last = config.axis.values.len() - 1;
    let mut pairs = Vec::new();
    for (claim, Claim { test, .. }) in config.narrative.claims.iter().enumerate() {
        let mut add = |first: (&str, usize), second: (&str, usize)| {
            pairs.extend(pair(config, points, claim, [first, second]));
        };
        match test {
            Test::Grows { curves } => {
                for curve in curves {
                    (1..=last).for_each(|value| add((curve, value), (curve, value - 1)));
                    if last > 1 {
                        add((curve, last), (curve, 0));
                    }
                }
            }
            Test::Exceeds(contrasts) | Test::Equals(contrasts) => {
                for Contrast { first, second, .. } in &contrasts.each {
                    (0..=last).for_each(|value| add((first, value), (second, value)));
                }
            }
            Test::AlphaHeld { .. } | Test::Quantity { .. } | Test::Gain { .. } => {}
        }
    }
    pairs
}

/// The pair of two curves, each at one value of the axis (from 0).
fn pair(
    config: &Config,
    points: &[Point],
    claim: usize,
    [first, second]: [(&str, usize); 2],
) -> Option<Pair> {
    let place = |(curve, value): (&str, usize)| Place {
        curve: curve.to_owned(),
        value: config.axis.values[value].to_string(),
    };
    Some(Pair {
        claim,
        first: point_at(config, points, first.0, first.1)?,
        second: point_at(config, points, second.0, second.1)?,
        places: [place(first), place(second)],
    })
}

/// Of each of `pairs` comparisons, so that all intervals cover with probability 1 − level at least.
pub fn confidence(claim: &Claim, pairs: usize) -> f64 {
    1.0 - claim.level / pairs as f64
}

/// The rows of `comparisons.csv`: one per pair. `discordant` has, for each pair that shares its noise,
/// the trials in which the first alone and the second alone decided for H₁.
pub fn comparisons(
    claims: &[Claim],
    pairs: &[Pair],
    tallies: &[Tally],
    discordant: &[Option<[u64; 2]>],
) -> Vec<Comparison> {
    let number = |claim: usize| pairs.iter().filter(|pair| pair.claim == claim).count();
    let numbers: Vec<usize> = (0..claims.len()).map(number).collect();
    let compare = |(pair, discordant): (&Pair, &Option<[u64; 2]>)| {
        let Pair { claim, places, .. } = pair;
        let compared = [tallies[pair.first], tallies[pair.second]];
        let confidence = confidence(&claims[*claim], numbers[*claim]);
        // Two curves may share a point, which never differs from itself.
        let itself = (pair.first == pair.second).then_some([0, 0]);
        let discordant = itself.or(*discordant);
        Comparison::new(claim + 1, places.clone(), compared, discordant, confidence)
    };
    pairs.iter().zip(discordant).map(compare).collect()
}
