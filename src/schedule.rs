//! Many trials of many points: families that share noise, run in parallel in blocks.
//!
//! A block is up to [`BLOCK`] consecutive trials of one family: the unit of scheduling, no more. A
//! trial's draws are addressed by its own index, and what a [`Gather`] gathers of them must add up to the
//! same in any order, so neither the blocks nor the number of threads leave a trace.

use crate::chain::{Family, Purpose, RecordTooLong, Scenario, Trial, View};
use rayon::prelude::*;

/// Trials in a block.
pub const BLOCK: u64 = 1024;

/// Scenarios arranged by the noise they share, and how many trials each gets.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The scenarios by the noise they share.
    pub families: Vec<Family>,
    /// Of every scenario.
    pub trials: u64,
}

/// What becomes of the trials.
pub trait Gather: View + Send {
    /// A trial is over: all places of its family have been shown.
    fn end_trial(&mut self) {}

    /// A block is over.
    fn end_block(&mut self) {}
}

impl Schedule {
    /// Arranges `scenarios`; the place of each is that in the list.
    ///
    /// # Errors
    /// As [`Family::arrange`].
    pub fn new<'a>(
        scenarios: impl IntoIterator<Item = &'a Scenario>,
        trials: u64,
        seed: u64,
        purpose: Purpose,
        common_random_numbers: bool,
    ) -> Result<Self, (usize, RecordTooLong)> {
        let families = Family::arrange(scenarios, seed, purpose, common_random_numbers)?;
        Ok(Self { families, trials })
    }

    /// Runs every trial of every family on the current thread pool; `add` adds what two have gathered.
    /// `progress` hears of every finished block: how many trials of how many points it brought.
    pub fn run<S: Gather>(
        &self,
        new: impl Fn() -> S + Sync + Send,
        add: impl Fn(S, S) -> S + Sync + Send,
        progress: impl Fn(u64) + Sync,
    ) -> S {
        let blocks = self.trials.div_ceil(BLOCK);
        (0..self.families.len() as u64 * blocks)
            .into_par_iter()
            .fold(&new, |mut sink, task| {
                let (block, index) = (task % blocks, (task / blocks) as usize);
                let first = block * BLOCK;
                let last = self.trials.min(first + BLOCK);
                self.run_block(index, first..last, &mut sink);
                progress((last - first) * self.families[index].points_per_trial() as u64);
                sink
            })
            .reduce(&new, add)
    }

    /// Shows `sink` consecutive trials of family `index`.
    pub fn run_block(&self, index: usize, trials: std::ops::Range<u64>, sink: &mut impl Gather) {
        let mut trial = Trial::new(&self.families[index]);
        for number in trials {
            trial.run(number, sink);
            sink.end_trial();
        }
        sink.end_block();
    }

    /// Of every scenario the family it belongs to: those of one family share their noise.
    pub fn family_of(&self) -> Vec<usize> {
        let families = self.families.iter().enumerate();
        let mut each: Vec<(usize, usize)> = families
            .flat_map(|(index, family)| family.places().map(move |place| (place, index)))
            .collect();
        each.sort_unstable();
        each.into_iter().map(|(_, family)| family).collect()
    }

    /// What [`Schedule::run`]'s progress adds up to.
    pub fn work(&self) -> u64 {
        let points: usize = self.families.iter().map(Family::points_per_trial).sum();
        self.trials * points as u64
    }
}
