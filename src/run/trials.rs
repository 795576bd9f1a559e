//! What a study gives to be counted.

use crate::counts::{Counts, DecisionSummary, Key, Shape, Sums};
use crate::schedule::BLOCK;
use std::collections::BTreeMap;
use std::ops::Range;

/// Why a study cannot be run.
pub type StudyError = Box<dyn std::error::Error + Send + Sync>;

/// A counter that is wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// What identifies it.
    pub key: Key,
    /// What it adds up.
    pub shape: Shape,
}

/// Counters that share one realisation.
pub struct Group<'a> {
    /// The targets, by their places.
    pub counters: Vec<usize>,
    /// What a trial costs, in trials of a single point.
    pub work: u64,
    /// Memory of a trial, in GB.
    pub gigabytes: f64,
    /// Runs some trials; returns the sums of each counter.
    pub run: Box<dyn Fn(Range<u64>) -> Vec<Sums> + Sync + 'a>,
}

impl<'a> Group<'a> {
    /// Of points that cost as much each as one by itself, and hardly any memory.
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
    /// Every counter that may be wanted, each once.
    fn targets(&self) -> &[Target];

    /// How many points these are of, pairs of points apart.
    fn points(&self) -> usize {
        self.targets().len()
    }

    /// Trials that are run together. Shards are whole blocks.
    fn block(&self) -> u64 {
        BLOCK
    }

    /// The targets that a whole run counts, by their places, so far as `counts` tell: in the end all that are not
    /// there for shards alone.
    fn needed(&self, _counts: &Counts) -> Vec<usize> {
        (0..self.targets().len()).collect()
    }

    /// Whether counts that go together can be what they say.
    ///
    /// # Errors
    /// Where two contradict each other.
    fn check(&self, _counts: &Counts) -> Result<(), StudyError> {
        Ok(())
    }

    /// Runs what must come before the trials of these targets: pilots. Returns how each point decides.
    ///
    /// # Errors
    /// Where a pilot shows no decision.
    fn prepare(
        &mut self,
        _targets: &[usize],
        _progress: &dyn Progress,
    ) -> Result<BTreeMap<Key, DecisionSummary>, StudyError> {
        Ok(BTreeMap::new())
    }

    /// Prepares for a run that only takes the time of a real one, and says how much work
    /// [`prepare`](Self::prepare) takes.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare), so far as it is known beforehand.
    fn pretend(&mut self) -> Result<u64, StudyError> {
        Ok(0)
    }

    /// What simulates these targets and no others, each in one group.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>>;
}

/// Nothing is counted.
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

/// Who is told how a run gets on, and may stop it.
pub trait Progress: Sync {
    /// A part of the run begins: `work` trials of single points, `trials` of each on average.
    fn begin(&self, _stage: &'static str, _work: u64, _trials: u64) {}

    /// Further trials of single points are done.
    fn done(&self, _work: u64) {}

    /// The part is over.
    fn end(&self) {}

    /// The counts so far are safe.
    fn saved(&self) {}

    /// Whether to stop after the blocks that are running.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Nobody is told.
impl Progress for () {}
