//! An experiment as it is worked off: what its directory holds of it, what is missing, and what it comes to
//! in the end.
//!
//! What a directory holds, a finished result or the counts of a run that was stopped, is read as one
//! [`Ledger`]; what the plan wants and the ledger lacks is simulated. So to resume a run, to raise its
//! trials, to add a curve or a claim and to find everything done are the same operation.

mod counts;
mod held;
mod merge;
mod status;

pub use counts::Counts;
pub use merge::{Joined, MergeError, Missing, join};
pub use status::{State, Status};

use crate::chain::Decision;
use crate::claim::{self, Pair};
use crate::config::Config;
use crate::ledger::{Key, Ledger};
use crate::plan::Plan;
use crate::results::{Checkpoint, Directory, Lock, Manifest, Origin, ResultsError, Row, Shard};
use crate::run::{Lack, Lacks, Subject, Watch};
use crate::tally::Tally;
use held::Held;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

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

/// The counters of a plan.
#[derive(Clone, Debug)]
struct Wanted {
    /// Of every point.
    points: Vec<Key>,
    /// Of every pair.
    pairs: Vec<Compared>,
}

/// How two points are compared.
#[derive(Clone, Debug)]
enum Compared {
    /// They are the same and never differ.
    Itself,
    /// By the trials of the noise they share.
    Paired(Key, [usize; 2]),
    /// By their rates alone.
    Apart,
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
        let pairs = claim::pairs(config, &plan.points);
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

impl Wanted {
    fn new(plan: &Plan, pairs: &[Pair]) -> Self {
        let key = |row: &Row| row.key(plan.seed, plan.common_random_numbers);
        let rows = plan.points.iter().map(|p| Row::new(p, None, NOTHING, 0.5));
        let points: Vec<Key> = rows.map(|row| key(&row)).collect();
        let family_of = plan.families();
        let compared = |pair: &Pair| {
            let places = [pair.first, pair.second];
            let keys = places.map(|place| &points[place]);
            let [first, second] = places.map(|place| family_of[place]);
            match (keys[0] == keys[1], first == second) {
                (true, _) => Compared::Itself,
                (_, true) => Compared::Paired(Key::pair(keys), places),
                _ => Compared::Apart,
            }
        };
        Self {
            pairs: pairs.iter().map(compared).collect(),
            points,
        }
    }

    /// Every counter once, and what it counts.
    fn subjects(&self) -> BTreeMap<&Key, Subject> {
        let points = self.points.iter().enumerate();
        let points = points.map(|(place, key)| (key, Subject::Point(place)));
        let pairs = self.pairs.iter().filter_map(|pair| match pair {
            Compared::Paired(key, places) => Some((key, Subject::Pair(*places))),
            Compared::Itself | Compared::Apart => None,
        });
        points.chain(pairs).collect()
    }

    /// What is not counted yet.
    fn lacks(&self, state: &Checkpoint) -> Vec<Lack> {
        let lack = |(key, subject): (&Key, Subject)| Lack {
            trials: state.counters.missing(key, state.wanted()),
            key: key.clone(),
            subject,
        };
        let lacks = self.subjects().into_iter().map(lack);
        lacks.filter(|lack| !lack.trials.is_empty()).collect()
    }

    /// Enters every counter, so that a ledger tells how much there is to do.
    fn expect_in(&self, ledger: &mut Ledger) {
        for (key, subject) in self.subjects() {
            ledger.expect(key, subject.counts());
        }
    }
}

const NOTHING: Tally = Tally { hits: 0, trials: 1 };
const NO_PANIC: &str = "nobody panics with the lock";

/// Saves a run while it goes on.
struct Saver<'a, W> {
    directory: &'a Directory,
    /// All but the counters.
    state: &'a Checkpoint,
    start: Instant,
    period: Duration,
    last: Mutex<Instant>,
    failed: AtomicBool,
    error: Mutex<Option<ResultsError>>,
    witness: &'a W,
}

impl<W: Witness> Watch for Saver<'_, W> {
    fn counted(&self, work: u64, ledger: &Mutex<Ledger>) {
        self.witness.counted(work);
        // Whoever finds another at it goes on simulating.
        let Ok(mut last) = self.last.try_lock() else {
            return;
        };
        if last.elapsed() < self.period || self.failed.load(Ordering::Relaxed) {
            return;
        }
        let counters = ledger.lock().expect(NO_PANIC).clone();
        let saved = self.directory.save(&Checkpoint {
            counters,
            seconds: self.state.seconds + self.start.elapsed().as_secs_f64(),
            ..self.state.clone()
        });
        *last = Instant::now();
        match saved {
            Ok(()) => self.witness.saved(),
            Err(error) => {
                *self.error.lock().expect(NO_PANIC) = Some(error);
                self.failed.store(true, Ordering::Relaxed);
            }
        }
    }

    fn is_stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.witness.is_stopped()
    }
}
