//! Runs many trials of many points. Families of points that share noise run in parallel, in blocks.
//!
//! A block is up to [`BLOCK`] consecutive trials of one family. It is only the unit of scheduling. The draws
//! of a trial are addressed by the trial's index, and the sums of a [`Gather`] must be the same in any order,
//! so neither the blocks nor the number of threads affect the results.

use crate::chain::{Family, Purpose, RecordTooLong, Scenario, Trial, View};
use rayon::prelude::*;

/// Trials in a block.
pub const BLOCK: u64 = 1024;

/// Scenarios arranged by the noise they share, and how many trials each gets.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The scenarios by the noise they share.
    pub families: Vec<Family>,
    /// The number of trials of every scenario.
    pub trials: u64,
}

/// A view that gathers the outcomes of trials.
pub trait Gather: View + Send {
    /// A trial has ended, and all places of its family have been shown.
    fn end_trial(&mut self) {}

    /// A block has ended.
    fn end_block(&mut self) {}
}

impl Schedule {
    /// Arranges `scenarios`. The place of a scenario is its index in the list.
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

    /// Runs every trial of every family on the current thread pool. `add` combines two sinks into one.
    /// `progress` is called after every block with its number of trials times its number of points.
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

    /// The family of every scenario. Scenarios of one family share their noise.
    pub fn family_of(&self) -> Vec<usize> {
        let families = self.families.iter().enumerate();
        let mut each: Vec<(usize, usize)> = families
            .flat_map(|(index, family)| family.places().map(move |place| (place, index)))
            .collect();
        each.sort_unstable();
        each.into_iter().map(|(_, family)| family).collect()
    }

    /// The total that [`Schedule::run`] reports as progress.
    pub fn work(&self) -> u64 {
        let points: usize = self.families.iter().map(Family::points_per_trial).sum();
        self.trials * points as u64
    }
}
