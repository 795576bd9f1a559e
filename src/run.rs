//! Runs a plan: blocks of trials in parallel, counts that add.
//!
//! A block is up to [`BLOCK`] consecutive trials of one family: the unit of scheduling, no more. A
//! trial's draws are addressed by its own index and integers add up to the same sum in any order, so
//! neither the blocks nor the number of threads leave a trace.

use crate::plan::Plan;
use crate::tally::Tally;
use rayon::prelude::*;

/// Trials in a block.
pub const BLOCK: u64 = 1024;

/// Runs every trial of every family on the current thread pool and returns each point's tally.
/// `progress` hears of every finished block: how many trials of how many points it brought.
pub fn run(plan: &Plan, progress: impl Fn(u64) + Sync) -> Vec<Tally> {
    let blocks = plan.trials.div_ceil(BLOCK);
    let none = || vec![0; plan.points.len()];
    let hits = (0..plan.families.len() as u64 * blocks)
        .into_par_iter()
        .fold(none, |mut hits, task| {
            let (block, family) = (task % blocks, &plan.families[(task / blocks) as usize]);
            let first = block * BLOCK;
            let last = plan.trials.min(first + BLOCK);
            family.run(first..last, &mut hits);
            progress((last - first) * family.points_per_trial() as u64);
            hits
        })
        .reduce(none, |mut sum, hits| {
            for (sum, hits) in sum.iter_mut().zip(hits) {
                *sum += hits;
            }
            sum
        });
    let trials = plan.trials;
    hits.into_iter()
        .map(|hits| Tally { hits, trials })
        .collect()
}

/// What [`run`]'s progress adds up to.
pub fn total_work(plan: &Plan) -> u64 {
    let points: usize = plan
        .families
        .iter()
        .map(|family| family.points_per_trial())
        .sum();
    plan.trials * points as u64
}
