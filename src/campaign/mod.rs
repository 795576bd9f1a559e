//! An experiment as it is worked off: what its directory holds of it, what is missing, and what it comes to
//! in the end.
//!
//! What a directory holds, a finished result or the counts of a run that was stopped, is read as one
//! [`Ledger`]; what the plan wants and the ledger lacks is simulated. So to resume a run, to raise its
//! trials, to add a curve or a claim and to find everything done are the same operation.

mod counts;
mod held;
mod merge;
mod saver;
mod status;
mod wanted;

pub use counts::Counts;
pub use merge::{Joined, MergeError, Missing, join};
pub use status::{State, Status};

use crate::chain::Decision;
use crate::claim::Pair;
use crate::config::Config;
use crate::ledger::{Key, Ledger};
use crate::plan::Plan;
use crate::results::{Checkpoint, Directory, Lock, Manifest, Origin, ResultsError, Row, Shard};
use crate::run::{Lacks, Subject};
use crate::stats::tally::Tally;
use held::Held;
use saver::Saver;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use wanted::{Compared, Wanted};

/// What becomes of what a directory holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Terms {
    /// It is gone on with; what is of another experiment is refused.
    Continue,
    /// Of it is kept what is wanted here: the directory belongs to the experiment by its name.
    Adopt,
    /// It is replaced.
    Fresh,
}

/// An experiment in its directory, which nobody else writes into as long as this lives.
#[derive(Debug)]
pub struct Campaign {
    plan: Plan,
    directory: Directory,
    pairs: Vec<Pair>,
    confidence: f64,
    wanted: Wanted,
    /// What is saved, and how far it is.
    state: Checkpoint,
    /// What made the results that all counts come from, as long as nothing is added to them.
    made_by: Option<Manifest>,
    lock: Lock,
}

/// What is still to be simulated.
#[derive(Debug)]
pub struct Rest {
    /// The points that run, and no others.
    pub plan: Plan,
    lacks: Lacks,
    /// The counter of each of its points.
    keys: Vec<Key>,
}

/// Who hears how a campaign gets on, and may stop it.
pub trait Witness: Sync {
    /// Further trials of single points are counted.
    fn counted(&self, work: u64);

    /// The counts so far are safe.
    fn saved(&self);

    /// Whether to stop after the blocks that are running.
    fn is_stopped(&self) -> bool;
}

impl Campaign {
    /// Locks the directory and finds out what of the plan, or of one share of it, is done there.
    ///
    /// # Errors
    /// Where the directory is in use, cannot be written, or holds what these terms do not replace.
    pub fn open(
        config: &Config,
        plan: Plan,
        directory: Directory,
        shard: Option<Shard>,
        terms: Terms,
    ) -> Result<Self, ResultsError> {
        let lock = directory.lock()?;
        directory.check_writable()?;
        let pairs = plan.pairs(config);
        let wanted = Wanted::new(&plan, &pairs);
        let mut state = Checkpoint {
            origin: Origin::from(config),
            shard,
            seconds: 0.0,
            told: BTreeMap::new(),
            counters: Ledger::default(),
        };
        let mut made_by = None;
        if let Some(mut held) = Held::read(&directory, terms)? {
            held.admit(&directory, &state, &plan, &wanted, terms)?;
            held.keep(&wanted);
            state.counters = held.state.counters;
            state.told = held.state.told;
            state.seconds = held.state.seconds;
            made_by = held.made_by;
        }
        wanted.expect_in(&mut state.counters);
        Ok(Self {
            confidence: config.confidence,
            plan,
            directory,
            pairs,
            wanted,
            state,
            made_by,
            lock,
        })
    }

    /// The plan, whole.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Where it lives.
    pub fn directory(&self) -> &Directory {
        &self.directory
    }

    /// Trials of every point that are wanted here.
    pub fn trials(&self) -> u64 {
        let wanted = self.state.wanted();
        wanted.end - wanted.start
    }

    /// What made the results that all counts come from; none where anything was simulated since.
    pub fn made_by(&self) -> Option<&Manifest> {
        self.made_by.as_ref()
    }

    /// What is wanted and not counted; none where all is done.
    pub fn rest(&self) -> Option<Rest> {
        let mut lacks = self.wanted.lacks(&self.state);
        if lacks.is_empty() {
            return None;
        }
        let places = |subject: &Subject| match *subject {
            Subject::Point(place) => vec![place],
            Subject::Pair(places) => places.to_vec(),
        };
        let needed: BTreeSet<usize> = lacks.iter().flat_map(|l| places(&l.subject)).collect();
        let needed: Vec<usize> = needed.into_iter().collect();
        let here = |place: usize| needed.binary_search(&place).expect("it is needed");
        for lack in &mut lacks {
            lack.subject = match lack.subject {
                Subject::Point(place) => Subject::Point(here(place)),
                Subject::Pair(places) => Subject::Pair(places.map(here)),
            };
        }
        let plan = self.plan.subset(&needed);
        Some(Rest {
            lacks: Lacks::new(&plan, &lacks),
            keys: (needed
                .iter()
                .map(|&place| self.wanted.points[place].clone()))
            .collect(),
            plan,
        })
    }

    /// Simulates the rest, each of its points deciding by its place in `decisions`, and saves the counts
    /// every `period`, before and after. Says whether all is done.
    ///
    /// # Errors
    /// Where the counts cannot be saved; what was saved before is left.
    pub fn count(
        &mut self,
        rest: &Rest,
        decisions: &[Decision],
        period: Duration,
        witness: &impl Witness,
    ) -> Result<bool, ResultsError> {
        let start = Instant::now();
        self.made_by = None;
        for ((key, point), decision) in rest.keys.iter().zip(&rest.plan.points).zip(decisions) {
            let row = Row::new(point, Some(decision), NOTHING, self.confidence);
            self.state.told.insert(key.clone(), row.told());
        }
        // A place that cannot be written is found out before it costs anything.
        self.directory.save(&self.state)?;
        let ledger = Mutex::new(std::mem::take(&mut self.state.counters));
        let saver = Saver {
            directory: &self.directory,
            state: &self.state,
            start,
            period,
            last: Mutex::new(start),
            failed: AtomicBool::new(false),
            error: Mutex::new(None),
            witness,
        };
        rest.lacks.count(decisions, &ledger, &saver);
        let error = saver.error.into_inner().expect(NO_PANIC);
        self.state.counters = ledger.into_inner().expect(NO_PANIC);
        self.state.seconds += start.elapsed().as_secs_f64();
        if let Some(error) = error {
            return Err(error);
        }
        self.directory.save(&self.state)?;
        witness.saved();
        Ok(self.wanted.lacks(&self.state).is_empty())
    }

    /// Saves the counts, be they none.
    ///
    /// # Errors
    /// Where they cannot be written.
    pub fn save(&self) -> Result<(), ResultsError> {
        self.directory.save(&self.state)
    }

    /// What it all came to, and the lock under which it can be written.
    ///
    /// # Panics
    /// Where anything is missing.
    pub fn counts(self) -> (Counts, Lock) {
        let trials = self.trials();
        let of = |key: &Key| {
            let counter = self.state.counters.get(key).expect("all is counted");
            &counter.counts
        };
        let rows = (self.plan.points.iter().zip(&self.wanted.points)).map(|(point, key)| {
            let hits = of(key)[0];
            let told = &self.state.told[key];
            Row::retold(point, told, Tally { hits, trials }, self.confidence)
        });
        let discordant = self.wanted.pairs.iter().map(|pair| match pair {
            Compared::Itself => Some([0, 0]),
            Compared::Paired(key, _) => Some([of(key)[0], of(key)[1]]),
            Compared::Apart => None,
        });
        let counts = Counts {
            rows: rows.collect(),
            discordant: discordant.collect(),
            seconds: self.state.seconds,
            pairs: self.pairs,
        };
        (counts, self.lock)
    }
}

impl Rest {
    /// What [`Witness::counted`] adds up to.
    pub fn work(&self) -> u64 {
        self.lacks.work()
    }
}

const NOTHING: Tally = Tally { hits: 0, trials: 1 };
const NO_PANIC: &str = "nobody panics with the lock";
