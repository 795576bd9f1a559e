//! The trials that a study gives a run to count.

use crate::counts::{Counts, DecisionSummary, Key, Shape, Sums};
use crate::schedule::BLOCK;
use std::collections::BTreeMap;
use std::ops::Range;

/// Why a study cannot be run.
pub type StudyError = Box<dyn std::error::Error + Send + Sync>;

/// A counter that is wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The key that identifies the counter.
    pub key: Key,
    /// The shape of the sums that the counter adds up.
    pub shape: Shape,
}

/// Counters that share one realisation.
pub struct Group<'a> {
    /// The targets of the group, by their indices.
    pub counters: Vec<usize>,
    /// The cost of a trial, in trials of a single point.
    pub work: u64,
    /// Memory of a trial, in GB.
    pub gigabytes: f64,
    /// Runs the given trials and returns the sums of each counter.
    pub run: Box<dyn Fn(Range<u64>) -> Vec<Sums> + Sync + 'a>,
}

impl<'a> Group<'a> {
    /// A group in which every point costs as much as it would by itself, and in which memory is negligible.
    pub fn new(counters: Vec<usize>, run: impl Fn(Range<u64>) -> Vec<Sums> + Sync + 'a) -> Self {
        Self {
            work: counters.len() as u64,
            gigabytes: 0.0,
            run: Box::new(run),
            counters,
        }
    }
}

/// Trials that may run in any order on any machine.
pub trait Trials: Sync {
    /// Every counter that may be wanted. Each counter appears once.
    fn targets(&self) -> &[Target];

    /// The number of points that the targets belong to. Pairs of points are not included.
    fn points(&self) -> usize {
        self.targets().len()
    }

    /// The number of trials that run together as one block. A shard consists of whole blocks.
    fn block(&self) -> u64 {
        BLOCK
    }

    /// The targets that a whole run counts, by their indices, as far as `counts` determines them. In the end
    /// these are all targets except those that only shards count.
    fn needed(&self, _counts: &Counts) -> Vec<usize> {
        (0..self.targets().len()).collect()
    }

    /// Checks that counts that belong together do not contradict each other.
    ///
    /// # Errors
    /// If two counts contradict each other.
    fn check(&self, _counts: &Counts) -> Result<(), StudyError> {
        Ok(())
    }

    /// Runs the pilots that these targets need before their trials. Returns the decision of each point.
    ///
    /// # Errors
    /// If a pilot shows no decision.
    fn prepare(
        &mut self,
        _targets: &[usize],
        _progress: &dyn Progress,
    ) -> Result<BTreeMap<Key, DecisionSummary>, StudyError> {
        Ok(BTreeMap::new())
    }

    /// Prepares for a run that only measures time, and returns the amount of work that
    /// [`prepare`](Self::prepare) would do.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare), if the error is known before the run.
    fn pretend(&mut self) -> Result<u64, StudyError> {
        Ok(0)
    }

    /// The groups that simulate exactly these targets. Each target is in one group.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>>;
}

/// No trials: for a study that counts nothing.
impl Trials for () {
    fn targets(&self) -> &[Target] {
        &[]
    }

    fn block(&self) -> u64 {
        1
    }

    fn groups(&self, _targets: &[usize]) -> Vec<Group<'_>> {
        Vec::new()
    }
}

/// An observer that receives the progress of a run and may stop it.
pub trait Progress: Sync {
    /// A part of the run begins. It has `work` trials of single points, on average `trials` per point.
    fn begin(&self, _stage: &'static str, _work: u64, _trials: u64) {}

    /// The run has finished `work` more trials of single points.
    fn done(&self, _work: u64) {}

    /// The part of the run has ended.
    fn end(&self) {}

    /// The counts so far are saved.
    fn saved(&self) {}

    /// Whether the run should stop after the blocks that are now running.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// An observer that ignores the progress and never stops the run.
impl Progress for () {}
