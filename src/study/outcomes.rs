//! Studies that count trials point by point and estimate several outcomes of each.
//!
//! A study says what its points are, what a trial is, and what follows from the sums of its trials. A row of its
//! `points.csv` is one outcome of one point, with its interval; its quantities are the rows by name.

use super::estimate::Estimate;
use super::kind::{Context, Counters, Study, counted};
use crate::counts::{Counts, DecisionSummary, Key, Shape, Sums};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::format::thousands;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::rule::{OutOfRange, Rule};
use crate::run::{Group, Identity, Progress, StudyError, Table, Target, Trials};
use schemars::SchemaGenerator;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeMap;

/// What such a study is.
pub trait Outcomes: Send + Sync + Sized + 'static {
    /// The name of its table.
    const NAME: &'static str;
    /// Trials in a block.
    const BLOCK: u64;
    type Point: Send + Sync;
    type Row: OutcomeRow;

    /// Reads its table.
    ///
    /// # Errors
    /// If the table is invalid.
    fn read(experiment: &Experiment) -> Result<Self, StudyError>;

    /// The JSON Schema of its table.
    fn schema(generator: &mut SchemaGenerator) -> Value;

    /// In the order of the rows.
    fn points(&self) -> Vec<Self::Point>;

    /// Every parameter of a point.
    fn identity(&self, point: &Self::Point) -> Identity;

    /// The shape of the sums of a trial.
    fn shape(&self) -> Shape;

    /// Measures what all trials need, before the first.
    fn prepare(&self, _seed: u64, _progress: &dyn Progress) {}

    /// Does so as far as a run needs it that only measures time; how much work it is, in trials of single points.
    fn pretend(&self, _seed: u64) -> u64 {
        0
    }

    /// The sums of one trial of each of these points, which are of one [family](Self::family).
    fn trials(&self, points: &[&Self::Point], seed: u64, trial: u64) -> Vec<Sums>;

    /// What points share that are simulated together; by default none does.
    fn family(&self, point: &Self::Point) -> Identity {
        self.identity(point)
    }

    /// Checks that so many trials of a point can give these sums.
    ///
    /// # Errors
    /// If they cannot.
    fn check(&self, _: &Self::Point, _: &Sums, _trials: u64) -> Result<(), OutOfRange> {
        Ok(())
    }

    /// The outcomes of so many trials of a point.
    fn estimates(
        &self,
        point: &Self::Point,
        sums: &Sums,
        trials: u64,
        confidence: f64,
    ) -> Vec<Estimate>;

    /// An outcome of a point, as it is written.
    fn row(&self, point: &Self::Point, estimate: Estimate, context: &Context) -> Self::Row;

    /// The point of a row, as a part of the name of a quantity.
    fn name(&self, row: &Self::Row) -> String;

    /// Quantities that follow from several rows.
    fn extremes(&self, _rows: &[Self::Row]) -> Vec<Quantity> {
        Vec::new()
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

    /// The table to print when the rows are written.
    fn findings(&self, _rows: &[Self::Row]) -> Option<Table> {
        None
    }

    /// Draws the rows.
    fn plot(&self, rows: &[Self::Row], seed: u64) -> Plot;
}

/// Reads a table and checks it.
///
/// # Errors
/// If it is invalid.
pub fn checked<T: DeserializeOwned>(
    experiment: &Experiment,
    check: impl Fn(&T) -> Result<(), OutOfRange>,
) -> Result<T, StudyError> {
    let table = experiment.read()?;
    check(&table).map_err(|error| experiment.conflict(error.into()))?;
    Ok(table)
}

/// Checks the values of a key: that there are some, within this rule, each larger than that before it.
///
/// # Errors
/// If they are not.
pub fn ascending(key: &str, values: &str, rule: Rule, of: &[f64]) -> Result<(), OutOfRange> {
    let refuse = |got: String| {
        let rule = format!("name {values} in ascending order");
        Err(OutOfRange::new(key, rule, got))
    };
    if of.is_empty() {
        return refuse("none".to_owned());
    }
    for value in of {
        rule.check(key, value)?;
    }
    match of.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => refuse(format!("{} before {}", pair[0], pair[1])),
        None => Ok(()),
    }
}

/// A row of such a study.
pub trait OutcomeRow: Serialize + DeserializeOwned {
    /// The name of the outcome.
    fn outcome(&self) -> &str;
    /// The estimate, and the ends of its interval.
    fn value(&self) -> [f64; 3];
    /// The number of trials, and the confidence of the interval.
    fn counted(&self) -> (u64, f64);
}

/// The end of a caption: how many trials of this kind there are to a point, the seed, and what shows the intervals.
pub fn facts(rows: &[impl OutcomeRow], trials: &str, seed: u64, shown: &str) -> [String; 3] {
    let (count, confidence) = rows[0].counted();
    [
        format!("{} {trials} a point", thousands(count)),
        format!("seed {seed}"),
        format!("{shown}: {} % intervals", 100.0 * confidence),
    ]
}

/// Such a study, with its counters.
pub struct Of<T: Outcomes> {
    study: T,
    points: Vec<T::Point>,
    context: Context,
    counters: Counters,
}

impl<T: Outcomes> Study for Of<T> {
    const NAME: &'static str = T::NAME;
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = T::Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let study = T::read(experiment)?;
        let shape = study.shape();
        let mut of = Self {
            points: study.points(),
            study,
            context,
            counters: Counters::default(),
        };
        of.counters = Counters::new(&of, context.seed, &shape);
        Ok(of)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        T::schema(generator)
    }

    fn identities(&self) -> Vec<Identity> {
        let points = self.points.iter();
        points.map(|point| self.study.identity(point)).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    /// All outcomes of each point in turn.
    fn rows(&self, counts: &Counts) -> Vec<T::Row> {
        let Self { study, context, .. } = self;
        let shape = study.shape();
        let points = self.points.iter().zip(&self.counters.keys);
        let rows = points.flat_map(|(point, key)| {
            let (trials, sums) = counted(counts, key, &shape);
            let estimates = study.estimates(point, &sums, trials, context.confidence);
            let rows = estimates.into_iter();
            rows.map(|estimate| study.row(point, estimate.rounded(), context))
        });
        rows.collect()
    }

    fn quantities(&self, rows: &[T::Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &T::Row| {
            let [value, low, high] = row.value();
            Quantity {
                name: format!("{}_{}", row.outcome(), self.study.name(row)),
                value,
                low,
                high,
            }
        };
        let mut quantities: Vec<Quantity> = rows.iter().map(quantity).collect();
        quantities.extend(self.study.extremes(rows));
        Ok(quantities)
    }

    fn false_alarms(&self, rows: &[T::Row]) -> Vec<Scenario> {
        self.study.false_alarms(rows)
    }

    fn nothing_promised() -> Option<OutOfRange> {
        T::nothing_promised()
    }

    fn findings(&self, rows: &[T::Row]) -> Option<Table> {
        self.study.findings(rows)
    }

    fn plot(&self, rows: &[T::Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(self.study.plot(rows, seed))
    }
}

impl<T: Outcomes> Trials for &Of<T> {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        T::BLOCK
    }

    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        for (point, key) in self.points.iter().zip(&self.counters.keys) {
            if let Some(counter) = counts.get(key) {
                let checked = self.study.check(point, &counter.sums, counter.trials.len());
                checked.map_err(|error| format!("counter {key}: {error}"))?;
            }
        }
        Ok(())
    }

    fn prepare(
        &mut self,
        targets: &[usize],
        progress: &dyn Progress,
    ) -> Result<BTreeMap<Key, DecisionSummary>, StudyError> {
        if !targets.is_empty() {
            self.study.prepare(self.context.seed, progress);
        }
        Ok(BTreeMap::new())
    }

    fn pretend(&mut self) -> Result<u64, StudyError> {
        Ok(self.study.pretend(self.context.seed))
    }

    /// Points of one family form a group.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let (study, seed) = (&self.study, self.context.seed);
        let point = |target: usize| &self.points[self.counters.points[target]];
        let mut families: BTreeMap<Identity, Vec<usize>> = BTreeMap::new();
        for target in targets {
            let family = families.entry(study.family(point(*target)));
            family.or_default().push(*target);
        }
        let group = |targets: Vec<usize>| {
            let points: Vec<&T::Point> = targets.iter().map(|at| point(*at)).collect();
            Group::new(targets, move |trials| {
                let mut sums = vec![study.shape().empty().sums; points.len()];
                for trial in trials {
                    let more = study.trials(&points, seed, trial);
                    let each = sums.iter_mut().zip(&more);
                    each.for_each(|(sum, more)| sum.add(more));
                }
                sums
            })
        };
        families.into_values().map(group).collect()
    }
}

/// Declares the row of a study of outcomes: from what it is made, the columns of the point with their types and values,
/// and `..` where those of the estimate stand.
macro_rules! outcome_row {
    (
        |$($from:ident: $of:ty),*|
        $($(#[$first:meta])* $before:ident: $b:ty = $one:expr;)*
        ..
        $($(#[$later:meta])* $after:ident: $a:ty = $other:expr;)*
    ) => {
        /// One row of `points.csv`: an outcome of a point.
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[allow(missing_docs, reason = "the columns are the config's own words")]
        pub struct Row {
            $($(#[$first])* pub $before: $b,)*
            pub outcome: String,
            /// How often the event happened.
            pub count: u64,
            /// The number of cases, or the time, in which it could happen.
            pub exposure: f64,
            /// Unit of the exposure.
            pub unit: String,
            /// The rate of the event, the mean, or the quantile.
            pub estimate: f64,
            pub low: f64,
            pub high: f64,
            pub trials: u64,
            pub confidence: f64,
            $($(#[$later])* pub $after: $a,)*
        }

        impl Row {
            /// An outcome of a point.
            pub(super) fn new(
                $($from: $of,)*
                estimate: $crate::study::estimate::Estimate,
                context: &$crate::study::kind::Context,
            ) -> Self {
                Self {
                    $($before: $one,)*
                    outcome: estimate.outcome,
                    count: estimate.count,
                    exposure: estimate.exposure,
                    unit: estimate.unit.to_owned(),
                    estimate: estimate.value,
                    low: estimate.low,
                    high: estimate.high,
                    trials: context.trials,
                    confidence: context.confidence,
                    $($after: $other,)*
                }
            }
        }

        impl $crate::study::outcomes::OutcomeRow for Row {
            fn outcome(&self) -> &str {
                &self.outcome
            }

            fn value(&self) -> [f64; 3] {
                [self.estimate, self.low, self.high]
            }

            fn counted(&self) -> (u64, f64) {
                (self.trials, self.confidence)
            }
        }
    };
}
pub(super) use outcome_row;
