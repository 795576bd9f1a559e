//! Finds the trials that are wanted and not yet counted, and counts them.

use super::{Group, Progress, Target, Trials};
use crate::counts::{Counts, Ranges};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;

/// Targets, by their indices, and the trials that each target lacks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing(Vec<(usize, Ranges)>);

impl Missing {
    /// For each target in `needed`, the trials in `wanted` that `counts` does not contain.
    pub fn new(
        trials: &dyn Trials,
        needed: &[usize],
        counts: &Counts,
        wanted: &Range<u64>,
    ) -> Self {
        let targets = trials.targets();
        let missing = |&at: &usize| (at, counts.missing(&targets[at].key, wanted.clone()));
        let each = needed.iter().map(missing);
        Self(each.filter(|(_, trials)| !trials.is_empty()).collect())
    }

    /// Whether no trial is missing.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The targets that lack trials, by their indices.
    pub fn targets(&self) -> Vec<usize> {
        self.0.iter().map(|(target, _)| *target).collect()
    }

    /// Groups the missing trials by the set of targets that lack them. Each set of targets appears once.
    fn alike(&self) -> BTreeMap<Vec<usize>, Ranges> {
        let ranges = self.0.iter().flat_map(|(_, trials)| trials.iter());
        let mut cuts: Vec<u64> = ranges.flat_map(|range| [range.start, range.end]).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let mut alike: BTreeMap<Vec<usize>, Ranges> = BTreeMap::new();
        // Between two neighbouring cuts a target lacks either every trial or no trial.
        for ends in cuts.windows(2) {
            let segment = ends[0]..ends[1];
            let misses = |(_, trials): &&(usize, Ranges)| trials.overlap(&segment).is_some();
            let targets: Vec<usize> = self.0.iter().filter(misses).map(|(at, _)| *at).collect();
            if !targets.is_empty() {
                let added = alike.entry(targets).or_default().add(segment);
                added.expect("segments do not overlap");
            }
        }
        alike
    }
}

/// The missing trials, in the order in which they are counted.
pub(super) struct Work<'a> {
    targets: &'a [Target],
    pub groups: Vec<Group<'a>>,
    stretches: Vec<Stretch>,
    block: u64,
}

/// Consecutive trials of one group.
struct Stretch {
    group: usize,
    trials: Range<u64>,
    /// Blocks in all the stretches before this one.
    before: u64,
}

impl<'a> Work<'a> {
    /// Arranges the missing trials so that targets that lack the same trials run together.
    pub fn new(trials: &'a dyn Trials, missing: &Missing) -> Self {
        let block = trials.block();
        let (mut groups, mut stretches, mut before) = (Vec::new(), Vec::new(), 0);
        for (targets, missing) in missing.alike() {
            for group in trials.groups(&targets) {
                for trials in missing.iter() {
                    let blocks = blocks(&trials, block);
                    stretches.push(Stretch {
                        group: groups.len(),
                        trials,
                        before,
                    });
                    before += blocks;
                }
                groups.push(group);
            }
        }
        Self {
            targets: trials.targets(),
            groups,
            stretches,
            block,
        }
    }

    /// The total work that [`count`](Self::count) reports as progress.
    pub fn size(&self) -> u64 {
        let work = |at: &Stretch| (at.trials.end - at.trials.start) * self.groups[at.group].work;
        self.stretches.iter().map(work).sum()
    }

    /// The number of blocks. Threads take the blocks one by one.
    pub fn blocks(&self) -> u64 {
        let end = |at: &Stretch| at.before + blocks(&at.trials, self.block);
        self.stretches.last().map_or(0, end)
    }

    /// Simulates the missing trials block by block on the current thread pool, and adds them to `counts`.
    pub fn count(&self, counts: &Mutex<Counts>, progress: &dyn Progress) {
        (0..self.blocks()).into_par_iter().for_each(|block| {
            if progress.is_stopped() {
                return;
            }
            // The last stretch that starts at or before this block contains it.
            let at = self.stretches.partition_point(|at| at.before <= block) - 1;
            let stretch = &self.stretches[at];
            let trials = block_of(&stretch.trials, block - stretch.before, self.block);
            let group = &self.groups[stretch.group];
            let sums = (group.run)(trials.clone());
            {
                let mut counts = counts.lock().expect("nobody panics with the counts");
                for (&counter, sums) in group.counters.iter().zip(&sums) {
                    let added = counts.add(&self.targets[counter].key, trials.clone(), sums);
                    added.expect("only what is missing is counted");
                }
            }
            progress.done((trials.end - trials.start) * group.work);
        });
    }
}

/// The number of pieces of a stretch that is cut at multiples of `block`.
fn blocks(trials: &Range<u64>, block: u64) -> u64 {
    if trials.is_empty() {
        0
    } else {
        trials.end.div_ceil(block) - trials.start / block
    }
}

/// The trials of piece `index` of a stretch.
fn block_of(trials: &Range<u64>, index: u64, block: u64) -> Range<u64> {
    let first = (trials.start / block + index) * block;
    trials.start.max(first)..trials.end.min(first + block)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_are_cut_at_multiples_of_the_block() {
        let block = 1024;
        let stretch = 1000..3 * block + 1;
        let pieces = 0..blocks(&stretch, block);
        let pieces: Vec<_> = pieces.map(|i| block_of(&stretch, i, block)).collect();
        let (first, last) = (1000..block, 3 * block..3 * block + 1);
        assert_eq!(
            pieces,
            [first, block..2 * block, 2 * block..3 * block, last]
        );
        assert_eq!(blocks(&(5..5), block), 0, "no trials have no block");
    }
}
