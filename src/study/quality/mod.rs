//! The quality of simulated rides ([`crate::track::quality`]), against that of the same rides without a sensor.
//!
//! A trial is one ride of 20 m and its record along the vertical and in two directions across it. What shakes the car is the
//! same for all points with one index, and is scaled with the speed. The truth is what the figures are of the motion and the
//! vibration at 800 Hz, and the phases are told, so that only the sensor and its rate make errors.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `true_…` | trials | mean of the true figure |
//! | `bias_…`, `rms_…` | trials | mean and root mean square of the error |
//! | `noise_…` | trials | the share that is called noise |
//!
//! The figures have the names of [`Measure`].

mod picture;
mod row;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub use row::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::run::{Identity, StudyError};
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, Mean, share};
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use crate::track::quality::Measure;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::Point;
pub(super) use table::Table;

impl Outcomes for Table {
    const NAME: &'static str = "quality";
    /// One takes some tens of milliseconds.
    const BLOCK: u64 = 4;
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

    /// Points that are shaken alike have one truth.
    fn family(&self, point: &Point) -> Identity {
        Identity::new([("vibration", point.vibration.to_string())])
    }

    fn shape(&self) -> Shape {
        trial::shape()
    }

    fn trials(&self, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
        trial::run(points, seed, trial)
    }

    fn estimates(&self, _: &Point, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let each = Measure::ALL.into_iter().enumerate();
        let estimates = each.flat_map(|(place, measure)| {
            let name = |outcome: &str| format!("{outcome}_{}", measure.name());
            let mean = |at| Mean::new(sums, trial::PAIRS * place + at, trials, confidence);
            let hits = sums.counts[place];
            [
                mean(0).named(&name("true"), trials, "trials"),
                mean(1).named(&name("bias"), trials, "trials"),
                mean(2).root().named(&name("rms"), trials, "trials"),
                share(&name("noise"), Tally { hits, trials }, "trials", confidence),
            ]
        });
        estimates.collect()
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        let vibration = row.vibration.to_string().replace('.', "_");
        format!("{}_{vibration}", row.condition)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, &self.grid(), seed)
    }
}
