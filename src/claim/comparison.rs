//! `comparisons.csv`: the comparisons of a config's claims, one row per pair of points.
//!
//! If both points share their noise, the row keeps the discordant counts: the numbers of trials in which only
//! one or only the other decided H₁. The difference of the rates depends on these counts alone, which makes a
//! paired interval narrow.

use crate::format::eight_digits;
use crate::stats::tally::{Tally, difference_interval};
use serde::{Deserialize, Serialize};

/// One row of `comparisons.csv`: the rate at the first point minus that at the second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The number of the claim in the config, from 1.
    pub claim: usize,
    /// Label of the first point's curve.
    pub first_curve: String,
    /// Its value on the axis.
    pub first_value: String,
    /// Label of the second point's curve.
    pub second_curve: String,
    /// Its value on the axis.
    pub second_value: String,
    /// Trials of either point.
    pub trials: u64,
    /// Detections at the first point.
    pub first: u64,
    /// Detections at the second.
    pub second: u64,
    /// Trials in which only the first decided H₁; `None` if the points do not share their noise.
    pub first_only: Option<u64>,
    /// Trials in which only the second decided H₁.
    pub second_only: Option<u64>,
    /// The difference of the rates.
    pub difference: f64,
    /// Its interval.
    pub low: f64,
    /// Its interval.
    pub high: f64,
    /// The confidence of the interval, from the claim's level shared by all its comparisons.
    pub confidence: f64,
}

/// The position of a compared point: its curve's label and its value on the axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The curve's label.
    pub curve: String,
    /// The value on the axis.
    pub value: String,
}

impl Comparison {
    /// The row of a claim (from 1) for two points and their counts. If they share their noise, `discordant`
    /// has the trials in which only the first and only the second decided H₁.
    pub fn new(
        claim: usize,
        places: [Place; 2],
        tallies: [Tally; 2],
        discordant: Option<[u64; 2]>,
        confidence: f64,
    ) -> Self {
        let [first, second] = tallies;
        let trials = first.trials;
        let alone = |hits| Tally { hits, trials };
        let compared = discordant.map_or(tallies, |[a, b]| [alone(a), alone(b)]);
        let (low, high) = difference_interval(compared[0], compared[1], confidence);
        let [from, to] = places;
        Self {
            claim,
            first_curve: from.curve,
            first_value: from.value,
            second_curve: to.curve,
            second_value: to.value,
            trials,
            first: first.hits,
            second: second.hits,
            first_only: discordant.map(|[a, _]| a),
            second_only: discordant.map(|[_, b]| b),
            difference: eight_digits(first.rate() - second.rate()),
            low: eight_digits(low),
            high: eight_digits(high),
            confidence,
        }
    }
}
