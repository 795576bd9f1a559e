//! Detectors of a start ([`crate::detect::running`]) side by side, at one measured rate of false alarms.
//!
//! A record has 100 samples a second, in deviations of its noise; it begins with 15 s of rest, from which a detector learns.
//! All detectors see the same record as it is, without a filter.
//!
//! | trial | then | outcomes |
//! |---|---|---|
//! | at rest | 120 s more of rest, `records` times | `over_promised`, false alarms per time over what is promised |
//! | of a start | a pulse of acceleration of height Δ, 6 s to look at | `within`, the share that alarms within 3 s; `delay_50`, the median delay, s |
//!
//! # The thresholds
//! They keep the rate on white normal noise: the smallest score that no larger share of `pilot` records of 120 s reaches than
//! 1 − exp(−120 s · rate). The records of this pilot have draws of their own, from the seed. So the thresholds are a
//! function of the config, the same after a break and in every shard, and the rates at rest are counted with other draws,
//! of white noise too. The clairvoyant has one for each start.
//!
//! # Assumed
//! A record at rest counts up to its first alarm, and the wait is exponential: the rate is alarms over time. All points of
//! one noise share its draws, so their outcomes are not independent; their intervals are each by itself. Δ/σ for a
//! probability of 0.9 is interpolated between points: probits along the logarithm of Δ, for the rate and for both ends of its
//! interval. The interval of a ratio is that of the extreme quotients.

mod compare;
mod findings;
mod noise;
mod picture;
mod pilot;
mod start;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub use table::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::run::{self, Identity, Progress, StudyError};
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, quantile, rate, share};
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use pilot::Pilot;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use start::{REST, SECOND, Start};
use std::sync::OnceLock;
use table::{Point, Table};

/// The table, and the thresholds once they are measured.
#[derive(Debug)]
pub(super) struct Detectors {
    table: Table,
    pilot: OnceLock<Pilot>,
    /// Those of a run that only measures time.
    rough: OnceLock<Pilot>,
}

impl Outcomes for Detectors {
    const NAME: &'static str = "detectors";
    /// One takes some tens of milliseconds.
    const BLOCK: u64 = 8;
    type Point = Point;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        Ok(Self {
            table: checked(experiment, Table::check)?,
            pilot: OnceLock::new(),
            rough: OnceLock::new(),
        })
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Table::json_schema(generator).to_value()
    }

    fn points(&self) -> Vec<Point> {
        self.table.points()
    }

    fn identity(&self, point: &Point) -> Identity {
        let mut identity = self.family(point);
        let start = point.start.as_ref().map(Start::subject);
        identity.parameters.extend([
            ("detector".to_owned(), point.detector.to_string()),
            ("start".to_owned(), start.unwrap_or_default()),
        ]);
        identity
            .with("delta", point.delta)
            .with("per_hour", self.table.per_hour)
            .with("pilot", self.table.pilot as f64)
    }

    /// All records at rest of one noise are one, and all records of starts.
    fn family(&self, point: &Point) -> Identity {
        let records = if point.rests() { self.table.records } else { 0 };
        let noise = Identity::new([("noise", point.noise.subject())]);
        noise.with("records", records as f64)
    }

    fn shape(&self) -> Shape {
        let most = self.table.records.max(1) as u64;
        Shape {
            most: vec![Some(most), Some(most * REST as u64)],
            values: vec![1],
            ..Shape::default()
        }
    }

    fn prepare(&self, seed: u64, progress: &dyn Progress) {
        self.pilot
            .get_or_init(|| Pilot::run(&self.table, seed, progress));
    }

    /// The fewest records are enough to measure time.
    fn pretend(&self, seed: u64) -> u64 {
        let rough = Table {
            pilot: self.table.fewest(),
            ..self.table.clone()
        };
        self.rough.get_or_init(|| Pilot::run(&rough, seed, &()));
        (self.table.pilot * self.table.detector.len()) as u64
    }

    fn trials(&self, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
        let pilot = self.pilot.get().or_else(|| self.rough.get());
        let pilot = pilot.expect("thresholds are measured before the first trial");
        if points[0].rests() {
            trial::at_rest(pilot, points, self.table.records, seed, trial)
        } else {
            trial::of_starts(pilot, points, seed, trial)
        }
    }

    fn estimates(&self, point: &Point, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let count = sums.counts[0];
        if point.rests() {
            let promised = sums.counts[1] as f64 / (3600 * SECOND) as f64 * self.table.per_hour;
            return vec![rate(
                "over_promised",
                count,
                promised,
                "promised",
                confidence,
            )];
        }
        let tally = Tally {
            hits: count,
            trials,
        };
        let median = quantile("delay_50", &sums.values[0], 0.5, confidence);
        vec![
            share("within", tally, "trials", confidence),
            Estimate {
                unit: "trials",
                ..median
            },
        ]
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        compare::name(row)
    }

    fn extremes(&self, rows: &[Row]) -> Vec<Quantity> {
        compare::quantities(rows, &self.table)
    }

    fn findings(&self, rows: &[Row]) -> Option<run::Table> {
        Some(findings::of(rows, &self.table, &self.extremes(rows)))
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, &self.table, seed)
    }
}
