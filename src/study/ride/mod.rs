//! Shows whole rides to the monitor. Is every trip found, and how late? How often does rest look like
//! motion? Does a jam raise an alarm? What does a monitor say that is switched on in motion?
//!
//! A trial is one ride, one rest, or both. It is simulated, watched by the monitor, and compared with the
//! truth. All points use the same draws in a trial, so points that differ only in strength or in the
//! monitor's settings are compared on the same noise.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `found` | trials | rides of which every trip is found: start and stop told within the tolerance of the truth, in the right direction |
//! | `start_delay_05`, `_50`, `_95` | trips | quantiles of the time from a start to when it is told |
//! | `stop_delay_…` | trips | the same for stops |
//! | `false_motions` | hours | starts told while the cage stood, of a time when it stood, per hour for which it stood |
//! | `hours_between` | hours | the mean time between them |
//! | `disturbed` | trials | rests with a false motion |
//! | `alarmed` | trials | jams with an alarm that is told after them, of no later time than the stand |
//! | `alarm_delay_…` | jams | the time from a jam to its alarm |
//! | `false_alarms` | trials | jam alarms without a jam, per trial |
//! | `misled` | trials | switched on in motion, the monitor said `rest` before the cage stood |
//! | `knew_soon`, `knew` | trials | it said `rest` when the next trip began, and when the record ended |
//!
//! An event that was never reported has an infinite delay. A quantile above the reported share is infinite.

pub(super) mod account;
mod estimate;
mod keys;
mod measure;
pub(super) mod picture;
mod point;
mod problem;
mod row;
mod sums;
mod table;
#[cfg(test)]
mod table_tests;
#[cfg(test)]
mod tests;
mod watch;

pub use row::Row;

use crate::counts::{Counter, Counts};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::study::kind::{Context, Counters, Study, counted};
use point::RidePoint;
use schemars::SchemaGenerator;
use serde_json::Value;
use sums::RideSums;
use table::RideTable;
use watch::Watch;

/// Trials in a block. A trial takes milliseconds.
const BLOCK: u64 = 4;

/// Rides along an axis.
pub(super) struct Rides {
    context: Context,
    table: RideTable,
    counters: Counters,
}

impl Rides {
    /// Each point with the index of its curve and its value on the axis.
    fn points(&self) -> impl Iterator<Item = (usize, f64, &RidePoint)> {
        let curves = self.table.curves.iter().enumerate();
        curves.flat_map(|(curve, of)| of.points.iter().map(move |(x, point)| (curve, *x, point)))
    }
}

impl Study for Rides {
    const NAME: &'static str = "ride";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let table = RideTable::read(experiment)?;
        let shape = RideSums::shape(&table);
        let mut rides = Self {
            context,
            table,
            counters: Counters::default(),
        };
        rides.counters = Counters::new(&rides, context.seed, &shape);
        Ok(rides)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        table::schema(generator)
    }

    fn identities(&self) -> Vec<Identity> {
        self.points().map(|(.., point)| point.identity()).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    /// All outcomes of all points, in the order of curves and values.
    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let Self { context, table, .. } = self;
        let shape = RideSums::shape(table);
        let mut rows = Vec::new();
        for ((curve, x, point), key) in self.points().zip(&self.counters.keys) {
            let (trials, sums) = counted(counts, key, &shape);
            let size = Watch::new(point, context.seed).size();
            let estimates = estimate::of(table.measure, &sums.into(), trials, context.confidence);
            for estimate in estimates {
                rows.push(Row::new(table, curve, x, point, size, estimate, context));
            }
        }
        rows
    }

    /// Each outcome by name. The name joins those of the outcome, its curve and its place on the axis.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &Row| {
            let curve = self.table.curves[row.curve - 1].name();
            let x = row.x.to_string().replace('.', "_");
            Quantity {
                name: format!("{}_{curve}_at_{x}", row.outcome),
                value: row.estimate,
                low: row.low,
                high: row.high,
            }
        };
        Ok(rows.iter().map(quantity).collect())
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        let curves = self.table.curves.iter();
        let labels: Vec<String> = curves.map(|curve| curve.label.clone()).collect();
        let rides = picture::Rides {
            measure: self.table.measure,
            axis: &self.table.axis,
            labels: &labels,
            seed,
        };
        Ok(picture::plot(rows, &rides))
    }
}

impl Trials for &Rides {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        for ((.., point), key) in (*self).points().zip(&self.counters.keys) {
            if let Some(Counter { trials, sums }) = counts.get(key) {
                let checked = RideSums::from(sums.clone()).check(point, trials.len());
                checked.map_err(|error| format!("counter {key}: {error}"))?;
            }
        }
        Ok(())
    }

    /// Each point forms a group of its own.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let points: Vec<&RidePoint> = (*self).points().map(|(.., point)| point).collect();
        let group = |&at: &usize| {
            let watch = Watch::new(points[self.counters.points[at]], self.context.seed);
            Group::new(vec![at], move |trials| {
                let mut sums = RideSums::default();
                trials.for_each(|trial| sums.add(&watch.trial(trial)));
                vec![sums.into()]
            })
        };
        targets.iter().map(group).collect()
    }
}
