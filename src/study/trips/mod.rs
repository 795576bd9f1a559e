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
mod recorded;
mod row;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub(super) use condition::{Condition, Grid, Numbers};
pub(super) use recorded::{Recorded, tracked};
pub use row::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::rule::{OutOfRange, Rule};
use crate::run::{Identity, StudyError};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::Point;
pub(super) use table::Table;

impl Outcomes for Table {
    const NAME: &'static str = "trips";
    /// One takes some milliseconds.
    const BLOCK: u64 = 16;
    type Point = Point;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        checked(experiment, Self::check)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Self::json_schema(generator).to_value()
    }

    fn points(&self) -> Vec<Point> {
        self.grid()
    }

    fn identity(&self, point: &Point) -> Identity {
        point.identity()
    }

    fn shape(&self) -> Shape {
        trial::shape()
    }

    fn trials(&self, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
        let each = points.iter().map(|point| trial::run(point, seed, trial));
        each.collect()
    }

    fn check(&self, _: &Point, sums: &Sums, _: u64) -> Result<(), OutOfRange> {
        for told in sums.counts.chunks(trial::COUNTS) {
            Rule::Within(0.0, told[0] as f64, "").check("within", &(told[1] as f64))?;
        }
        Ok(())
    }

    fn estimates(&self, _: &Point, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        estimate::of(sums, trials, confidence)
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        let distance = row.distance.to_string().replace('.', "_");
        format!("{}_{distance}_m", row.condition)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, &self.condition, seed)
    }
}
