//! Counts what a ledger lacks, and nothing else.

use super::{Counts, Decisions, Families};
use crate::chain::Decision;
use crate::ensemble::BLOCK;
use crate::ledger::{Key, Ledger, Ranges};
use crate::plan::Plan;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;

/// What a counter counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// How often a point of the plan decides for H₁.
    Point(usize),
    /// Of two points that share their noise, how often only the first, only the second does.
    Pair([usize; 2]),
}

impl Subject {
    /// How many counts it takes.
    pub fn counts(self) -> usize {
        match self {
            Self::Point(_) => 1,
            Self::Pair(_) => 2,
        }
    }
}

/// A counter, and the trials it lacks.
#[derive(Clone, Debug)]
pub struct Lack {
    /// The counter.
    pub key: Key,
    /// What it counts.
    pub subject: Subject,
    /// The trials.
    pub trials: Ranges,
}

/// Who follows a run.
pub trait Watch: Sync {
    /// A block is in the ledger that brought `work` trials of single points.
    fn counted(&self, work: u64, ledger: &Mutex<Ledger>);

    /// Whether no further block is to be begun.
    fn is_stopped(&self) -> bool;
}

/// What some counters lack, in the order in which it is counted.
#[derive(Debug)]
pub struct Lacks {
    jobs: Vec<Job>,
    stretches: Vec<Stretch>,
}

/// Counters that lack the same trials, and the points that run for them.
#[derive(Debug)]
struct Job {
    plan: Plan,
    /// The place in the whole plan of every point here.
    places: Vec<usize>,
    /// The counter of every point here, if it lacks anything.
    keys: Vec<Option<Key>>,
    pair_keys: Vec<Key>,
    families: Families,
}

/// Trials of one family that follow each other.
#[derive(Debug)]
struct Stretch {
    job: usize,
    family: usize,
    trials: Range<u64>,
    /// Blocks in all the stretches before this one.
    before: u64,
}

impl Lacks {
    /// Arranges what is missing so that points that lack the same trials run together.
    pub fn new(plan: &Plan, lacks: &[Lack]) -> Self {
        let mut jobs = Vec::new();
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut before = 0;
        for (members, trials) in alike(lacks) {
            let job = Job::new(plan, members.iter().map(|&index| &lacks[index]));
            for family in 0..job.plan.ensemble.families.len() {
                for trials in trials.iter() {
                    let blocks = blocks(&trials);
                    stretches.push(Stretch {
                        job: jobs.len(),
                        family,
                        trials,
                        before,
                    });
                    before += blocks;
                }
            }
            jobs.push(job);
        }
        Self { jobs, stretches }
    }

    /// What [`Watch::counted`] adds up to.
    pub fn work(&self) -> u64 {
        let work = |stretch: &Stretch| {
            let points = self.jobs[stretch.job].points_per_trial(stretch.family);
            (stretch.trials.end - stretch.trials.start) * points
        };
        self.stretches.iter().map(work).sum()
    }

    /// Adds to `ledger` all that is missing, block by block on the current thread pool, each point of the
    /// plan deciding by its place in `decisions`.
    pub fn count(&self, decisions: &[Decision], ledger: &Mutex<Ledger>, watch: &impl Watch) {
        let of_job = |job: &Job| Decisions::new(job.places.iter().map(|&at| decisions[at].clone()));
        let of_jobs: Vec<Decisions> = self.jobs.iter().map(of_job).collect();
        let end = |stretch: &Stretch| stretch.before + blocks(&stretch.trials);
        let all = self.stretches.last().map_or(0, end);
        (0..all).into_par_iter().for_each(|block| {
            if watch.is_stopped() {
                return;
            }
            let at = self.stretches.partition_point(|s| s.before <= block) - 1;
            let stretch = &self.stretches[at];
            let job = &self.jobs[stretch.job];
            let trials = block_of(&stretch.trials, block - stretch.before);
            let mut counts = Counts::new(&of_jobs[stretch.job], &job.families);
            let ensemble = &job.plan.ensemble;
            ensemble.run_block(stretch.family, trials.clone(), &mut counts);
            job.enter(stretch.family, &trials, &counts, ledger);
            let points = job.points_per_trial(stretch.family);
            watch.counted((trials.end - trials.start) * points, ledger);
        });
    }
}

impl Job {
    fn new<'a>(plan: &Plan, lacks: impl Iterator<Item = &'a Lack> + Clone) -> Self {
        let mut key_of: BTreeMap<usize, Option<Key>> = BTreeMap::new();
        for Lack { key, subject, .. } in lacks.clone() {
            match subject {
                Subject::Point(place) => {
                    key_of.insert(*place, Some(key.clone()));
                }
                Subject::Pair(places) => places.iter().for_each(|&place| {
                    key_of.entry(place).or_insert(None);
                }),
            }
        }
        let (places, keys): (Vec<usize>, Vec<_>) = key_of.into_iter().unzip();
        let here = |place: usize| places.binary_search(&place).expect("it is among them");
        let pairs = lacks.filter_map(|lack| match lack.subject {
            Subject::Pair(places) => Some((places.map(here), lack.key.clone())),
            Subject::Point(_) => None,
        });
        let (pairs, pair_keys): (Vec<_>, Vec<_>) = pairs.unzip();
        let plan = plan.subset(&places);
        Self {
            families: Families::new(&plan, pairs),
            plan,
            places,
            keys,
            pair_keys,
        }
    }

    fn points_per_trial(&self, family: usize) -> u64 {
        self.plan.ensemble.families[family].points_per_trial() as u64
    }

    fn enter(&self, family: usize, trials: &Range<u64>, counts: &Counts, ledger: &Mutex<Ledger>) {
        let mut ledger = ledger.lock().expect("nobody panics with the ledger");
        let mut add = |key: &Key, counts: &[u64]| {
            let added = ledger.add(key, trials.clone(), counts);
            added.expect("only what is missing is counted");
        };
        for &place in &self.families.places_of[family] {
            if let Some(key) = &self.keys[place] {
                add(key, &counts.hits[place..=place]);
            }
        }
        for &pair in &self.families.pairs_of[family] {
            add(&self.pair_keys[pair], &counts.discordant[pair]);
        }
    }
}

/// Trials, and the lacks that all lack them: each set of lacks once.
fn alike(lacks: &[Lack]) -> BTreeMap<Vec<usize>, Ranges> {
    let ranges = || lacks.iter().flat_map(|lack| lack.trials.iter());
    let mut cuts: Vec<u64> = ranges().flat_map(|r| [r.start, r.end]).collect();
    cuts.sort_unstable();
    cuts.dedup();
    let mut alike: BTreeMap<Vec<usize>, Ranges> = BTreeMap::new();
    for ends in cuts.windows(2) {
        let segment = ends[0]..ends[1];
        let lack = |index: &usize| lacks[*index].trials.overlap(&segment).is_some();
        let members: Vec<usize> = (0..lacks.len()).filter(lack).collect();
        if !members.is_empty() {
            let added = alike.entry(members).or_default().add(segment);
            added.expect("segments do not overlap");
        }
    }
    alike
}

/// Pieces that a stretch is cut into at multiples of [`BLOCK`].
fn blocks(trials: &Range<u64>) -> u64 {
    match trials.is_empty() {
        true => 0,
        false => trials.end.div_ceil(BLOCK) - trials.start / BLOCK,
    }
}

/// Piece `index` of a stretch.
fn block_of(trials: &Range<u64>, index: u64) -> Range<u64> {
    let first = (trials.start / BLOCK + index) * BLOCK;
    trials.start.max(first)..trials.end.min(first + BLOCK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_are_cut_at_multiples_of_the_block() {
        let stretch = 1000..3 * BLOCK + 1;
        let pieces: Vec<_> = (0..blocks(&stretch))
            .map(|i| block_of(&stretch, i))
            .collect();
        let (first, last) = (1000..BLOCK, 3 * BLOCK..3 * BLOCK + 1);
        assert_eq!(
            pieces,
            [first, BLOCK..2 * BLOCK, 2 * BLOCK..3 * BLOCK, last]
        );
        assert_eq!(blocks(&(5..5)), 0, "no trials have no block");
    }
}
