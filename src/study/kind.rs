//! What a study is: its table, its trials, its rows, its picture.

use crate::claim::{Outcome, Scope};
use crate::counts::{Counts, Key, Shape, Sums};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::results::{Comparison, Quantity};
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError, Table, Target, Trials};
use schemars::SchemaGenerator;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeSet;

/// What a config's table describes.
pub trait Study: Send + Sync + Sized + 'static {
    /// The name of its table.
    const NAME: &'static str;

    /// The sections, or keys of sections (`noise.law`), that affect it. Any other is refused.
    const USES: &'static [&'static str];

    /// Whether it counts trials.
    const COUNTS_TRIALS: bool;

    /// A row of `points.csv`.
    type Row: Serialize + DeserializeOwned;

    /// Reads its table.
    ///
    /// # Errors
    /// If the table is invalid, or no region or record can be made for it.
    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError>;

    /// The JSON Schema of its table.
    fn schema(generator: &mut SchemaGenerator) -> Value;

    /// The identity of each point: every parameter that changes its results.
    fn identities(&self) -> Vec<Identity>;

    /// What it counts; none if everything is computed. A study that runs no pilots is itself its trials.
    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        None
    }

    /// The rows that follow from the counts. A missing counter counts as one trial without events.
    fn rows(&self, counts: &Counts) -> Vec<Self::Row>;

    /// Comparisons of pairs of points.
    fn comparisons(&self, _rows: &[Self::Row], _counts: &Counts) -> Vec<Comparison> {
        Vec::new()
    }

    /// Single numbers, for `quantities.csv`.
    ///
    /// # Errors
    /// If the rows do not give a number that is asked for.
    fn quantities(&self, _rows: &[Self::Row]) -> Result<Vec<Quantity>, StudyError> {
        Ok(Vec::new())
    }

    /// The counts behind its rows, if the rows determine them.
    fn recall(&self, _rows: &[Self::Row], _comparisons: &[Comparison]) -> Option<Counts> {
        None
    }

    /// The false alarms that `check` tests, and the rate that each scenario promises.
    fn false_alarms(&self, _rows: &[Self::Row]) -> Vec<Scenario> {
        Vec::new()
    }

    /// What is wrong with a config of which [`false_alarms`](Self::false_alarms) are none; none if the study promises no
    /// rate at all.
    fn nothing_promised() -> Option<OutOfRange> {
        None
    }

    /// Draws the rows.
    ///
    /// # Errors
    /// If there are no rows to draw, or drawing fails.
    fn plot(&self, rows: &[Self::Row], seed: u64) -> Result<Plot, FigureError>;

    /// The table to print when the rows are written.
    fn findings(&self, _rows: &[Self::Row]) -> Option<Table> {
        None
    }

    /// The number of points, in words, for a plan.
    fn points(&self) -> String {
        let points = self.trials().map_or(1, |trials| trials.points());
        format!("{points} of [{}]", Self::NAME)
    }

    /// What claims about curves may refer to.
    fn scope(&self) -> Scope {
        Scope::default()
    }

    /// The rates that claims about curves are judged by.
    fn outcomes(&self, _rows: &[Self::Row]) -> Vec<Outcome> {
        Vec::new()
    }
}

/// A study asks for too many of something.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: must be at most {most}, got {got} ({remedy})")]
pub struct TooMany {
    /// What there are too many of.
    what: &'static str,
    most: usize,
    got: usize,
    remedy: &'static str,
}

impl TooMany {
    /// Refuses more than `most`.
    ///
    /// # Errors
    /// If there are more.
    pub fn check(
        what: &'static str,
        got: usize,
        most: usize,
        remedy: &'static str,
    ) -> Result<(), Self> {
        if got <= most {
            return Ok(());
        }
        Err(Self {
            what,
            most,
            got,
            remedy,
        })
    }
}

/// What the studies of one config share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Context {
    /// The seed of all draws.
    pub seed: u64,
    /// Trials per point; 1 if the study counts no trials.
    pub trials: u64,
    /// Confidence of the intervals.
    pub confidence: f64,
}

impl Context {
    /// The numbers of a config, for a study that counts trials or for one that does not.
    pub fn of(experiment: &Experiment, counts_trials: bool) -> Self {
        let header = &experiment.header;
        Self {
            seed: header.seed,
            trials: if counts_trials { header.trials() } else { 1 },
            confidence: header.confidence.get(),
        }
    }
}

/// The counters of the points of a study.
#[derive(Debug, Default)]
pub struct Counters {
    /// The counter of each point.
    pub keys: Vec<Key>,
    /// Each distinct counter.
    pub targets: Vec<Target>,
    /// The first point of each target.
    pub points: Vec<usize>,
}

impl Counters {
    /// A counter of this shape for each distinct point.
    pub fn new<S: Study>(study: &S, seed: u64, shape: &Shape) -> Self {
        let mut counters = Self::default();
        let mut known = BTreeSet::new();
        for (point, identity) in study.identities().iter().enumerate() {
            let key = identity.key(S::NAME, seed, true);
            if known.insert(key) {
                let shape = shape.clone();
                counters.targets.push(Target { key, shape });
                counters.points.push(point);
            }
            counters.keys.push(key);
        }
        counters
    }
}

/// The trials and sums of a target. An uncounted target has one trial without events.
pub fn counted(counts: &Counts, key: &Key, shape: &Shape) -> (u64, Sums) {
    match counts.get(key) {
        Some(counter) if !counter.trials.is_empty() => (counter.trials.len(), counter.sums.clone()),
        _ => (1, shape.empty().sums),
    }
}
