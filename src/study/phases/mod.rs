//! The phases, the direction and the distance of simulated trips by the published filter and its rules
//! ([`crate::track::VerticalFilter`]), beside `liftsim track`, against the truth.
//!
//! A trial is one trip, up or down, and its accelerometer record. All thresholds see the same record.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `told_…` | trials | one trip is found, from rest to rest |
//! | `direction_…` | trials | it is, and its direction is right |
//! | `phases_…` | trials | it is, and it speeds up, moves uniformly and brakes once each, each from and to within 0.5 s |
//! | `time_wrong_…` | trials | mean share of the time whose phase is wrong |
//! | `bias_…`, `error_…` | trips told | mean error of the distance, longer positive, and mean of its size, m |
//! | `error_95_…` | trips told | the error that 95 % stay within, m |
//!
//! The ways: `printed`; `mended`, where no speed is slow for ever; and `track`.

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
use crate::study::estimate::{Estimate, Mean, quantile, share};
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::Point;
pub(super) use table::Table;
use trial::Way;

impl Outcomes for Table {
    const NAME: &'static str = "phases";
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

    /// Thresholds see one record.
    fn family(&self, point: &Point) -> Identity {
        point.recorded()
    }

    fn shape(&self) -> Shape {
        trial::shape()
    }

    fn trials(&self, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
        trial::run(points, seed, trial)
    }

    fn estimates(&self, _: &Point, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let each = Way::ALL.into_iter().enumerate();
        let estimates = each.flat_map(|(place, way)| {
            let name = |outcome: &str| format!("{outcome}_{}", way.name());
            let counts = &sums.counts[trial::COUNTS * place..];
            let share = |outcome: &str, at: usize| {
                let hits = counts[at];
                share(&name(outcome), Tally { hits, trials }, "trials", confidence)
            };
            let mean = |at, cases| Mean::new(sums, trial::PAIRS * place + at, cases, confidence);
            let of_told = |outcome: &str, at| match counts[0] {
                // Of no trip nothing is known.
                0 => Estimate {
                    value: f64::INFINITY,
                    low: f64::NEG_INFINITY,
                    high: f64::INFINITY,
                    ..mean(at, 0).named(&name(outcome), 0, "trips")
                },
                told => mean(at, told).named(&name(outcome), told, "trips"),
            };
            [
                share("told", 0),
                share("direction", 1),
                share("phases", 2),
                mean(0, trials).named(&name("time_wrong"), trials, "trials"),
                of_told("bias", 1),
                of_told("error", 2),
                quantile(&name("error_95"), &sums.values[place], 0.95, confidence),
            ]
        });
        estimates.collect()
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        let number = |number: f64| number.to_string().replace('.', "_");
        let [vibration, threshold] = [row.vibration, row.threshold].map(number);
        format!("{}_{vibration}_{threshold}", row.condition)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, self, seed)
    }
}
