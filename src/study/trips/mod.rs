//! Distances of simulated trips, by every way to measure them ([`crate::track`]), against the truth.
//!
//! A trial is one trip and its accelerometer record. Every way sees the same record, and the trips of all points with one
//! index begin with the same draws.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `bound` | | the deviation of the moment formula on the known phases, m |
//! | `told_…` | trials | the trip is found, from rest to rest, and as one |
//! | `bias_…`, `rms_…` | trips told | mean and root mean square of the error, m |
//! | `over_bound_…` | trips told | the latter over the bound |
//! | `over_drift_removed_track` | trips told | that of `track` over that of `drift_removed` |
//! | `error_95_…` | trips told | the error that 95 % stay within, m |
//! | `nees_…` | trips told | mean of the square of the error over its stated variance |
//! | `within_…` | trips told | the share within 1.96 stated deviations |
//!
//! The ways: `track`, as `liftsim track` does it; `live`, the same filter sample by sample; `words`, the patent by its words;
//! `drift_removed` and `integrated`, told when the trip begins and ends to 0.3 s; `moments`, the bound itself.

mod condition;
mod estimate;
mod picture;
mod row;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub use row::Row;

use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::rule::Rule;
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::study::kind::{Context, Counters, Study, counted};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::{Point, Table};

/// Trips in a block. One takes some milliseconds.
const BLOCK: u64 = 16;

/// Trips of several lengths under several conditions.
pub(super) struct Trips {
    context: Context,
    table: Table,
    points: Vec<Point>,
    counters: Counters,
}

impl Study for Trips {
    const NAME: &'static str = "trips";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let table: Table = experiment.read()?;
        table.check().map_err(|error| experiment.refuse(error))?;
        let mut trips = Self {
            context,
            points: table.points().collect(),
            table,
            counters: Counters::default(),
        };
        trips.counters = Counters::new(&trips, context.seed, &trial::shape());
        Ok(trips)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Table::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        self.points.iter().map(Point::identity).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    /// All outcomes of each point in turn.
    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let shape = trial::shape();
        let mut rows = Vec::new();
        for (point, key) in self.points.iter().zip(&self.counters.keys) {
            let (trials, sums) = counted(counts, key, &shape);
            let estimates = estimate::of(&sums, trials, self.context.confidence).into_iter();
            rows.extend(estimates.map(|of| Row::new(*point, of, &self.context)));
        }
        rows
    }

    /// Each outcome by its name and those of its condition and length.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &Row| {
            let point = Point {
                condition: row.condition,
                distance: row.distance,
            };
            Quantity {
                name: format!("{}_{}", row.outcome, point.name()),
                value: row.estimate,
                low: row.low,
                high: row.high,
            }
        };
        Ok(rows.iter().map(quantity).collect())
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, &self.table.condition, seed))
    }
}

impl Trials for &Trips {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        for key in &self.counters.keys {
            let counter = counts.get(key).into_iter();
            for told in counter.flat_map(|it| it.sums.counts.chunks(trial::COUNTS)) {
                let checked =
                    Rule::Within(0.0, told[0] as f64, "").check("within", &(told[1] as f64));
                checked.map_err(|error| format!("counter {key}: {error}"))?;
            }
        }
        Ok(())
    }

    /// Each point forms a group of its own.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        self.counters.apart(targets, |at| {
            let (point, seed) = (self.points[at], self.context.seed);
            move |number| trial::run(&point, seed, number)
        })
    }
}
