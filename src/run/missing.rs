//! What is wanted and not counted, and the counting of it.

use super::{Group, Progress, Target, Trials};
use crate::counts::{Counts, Ranges};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;

/// Targets, by their places, and the trials that each has not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing(Vec<(usize, Ranges)>);

impl Missing {
    /// What of the trials `wanted` of the targets `needed` is not in `counts`.
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

    /// Whether nothing is.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The targets, by their places.
    pub fn targets(&self) -> Vec<usize> {
        self.0.iter().map(|(target, _)| *target).collect()
    }

    /// Trials, and the targets that all miss them: each set of targets once.
    fn alike(&self) -> BTreeMap<Vec<usize>, Ranges> {
        let ranges = self.0.iter().flat_map(|(_, trials)| trials.iter());
        let mut cuts: Vec<u64> = ranges.flat_map(|range| [range.start, range.end]).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let mut alike: BTreeMap<Vec<usize>, Ranges> = BTreeMap::new();
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

/// What is missing, in the order in which it is counted.
pub(super) struct Work<'a> {
    targets: &'a [Target],
    pub groups: Vec<Group<'a>>,
    stretches: Vec<Stretch>,
    block: u64,
}

/// Trials of one group that follow each other.
struct Stretch {
    group: usize,
    trials: Range<u64>,
    /// Blocks in all the stretches before this one.
    before: u64,
}

impl<'a> Work<'a> {
    /// Arranges what is missing so that targets that miss the same trials run together.
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

    /// What the progress of [`count`](Self::count) adds up to.
    pub fn size(&self) -> u64 {
        let work = |at: &Stretch| (at.trials.end - at.trials.start) * self.groups[at.group].work;
        self.stretches.iter().map(work).sum()
    }

    /// Pieces that threads take one by one.
    pub fn blocks(&self) -> u64 {
        let end = |at: &Stretch| at.before + blocks(&at.trials, self.block);
        self.stretches.last().map_or(0, end)
    }

    /// Adds to `counts` all that is missing, block by block on the current thread pool.
    pub fn count(&self, counts: &Mutex<Counts>, progress: &dyn Progress) {
        (0..self.blocks()).into_par_iter().for_each(|block| {
            if progress.is_stopped() {
                return;
            }
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

/// Pieces that a stretch is cut into at multiples of `block`.
fn blocks(trials: &Range<u64>, block: u64) -> u64 {
    if trials.is_empty() {
        0
    } else {
        trials.end.div_ceil(block) - trials.start / block
    }
}

/// Piece `index` of a stretch.
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
