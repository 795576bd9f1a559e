//! What a plan came to.

use crate::claim::{self, Pair};
use crate::config::Config;
use crate::plan::Plan;
use crate::results::{Comparison, Row};
use crate::stats::tally::Tally;

/// The counts of every point and of every pair that claims compare.
#[derive(Clone, Debug)]
pub struct Counts {
    /// One per point.
    pub rows: Vec<Row>,
    /// Pairs of points that claims compare.
    pub pairs: Vec<Pair>,
    /// One per pair: trials in which the first alone and the second alone decided for H₁, where the two
    /// share their noise.
    pub discordant: Vec<Option<[u64; 2]>>,
    /// Wall clock of the simulation.
    pub seconds: f64,
}

impl Counts {
    /// What would be counted in one trial in which nothing happens.
    pub fn empty(config: &Config, plan: &Plan) -> Self {
        let pairs = plan.pairs(config);
        let row = |point| Row::new(point, None, super::NOTHING, config.confidence);
        Self {
            rows: plan.points.iter().map(row).collect(),
            discordant: vec![None; pairs.len()],
            pairs,
            seconds: 0.0,
        }
    }

    /// The rows of `comparisons.csv`.
    pub fn comparisons(&self, config: &Config) -> Vec<Comparison> {
        let tallies: Vec<Tally> = self.rows.iter().map(Row::tally).collect();
        let claims = &config.narrative.claims;
        claim::comparisons(claims, &self.pairs, &tallies, &self.discordant)
    }
}
