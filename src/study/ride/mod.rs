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
//! | `false_motions` | hours | motions told while the cage stood, of a time when it stood, per hour for which it stood |
//! | `hours_between` | hours | the mean time between them |
//! | `disturbed` | trials | rests with a false motion |
//! | `alarmed` | trials | jams with an alarm that is told after them, of no later time than the stand |
//! | `alarm_delay_…` | jams | the time from a jam to its alarm |
//! | `rule_alarms` | hours | how often the rule decided for motion at rest, per hour; decisions that share blocks count as one |
//! | `rule_delay_…` | trips | the time from a start to the rule's first decision for motion |
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

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::study::curves::{self, Point};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use point::RidePoint;
use schemars::SchemaGenerator;
use serde_json::Value;
use sums::RideSums;
pub(super) use table::Table;

impl Outcomes for Table {
    const NAME: &'static str = "ride";
    /// A trial takes milliseconds.
    const BLOCK: u64 = 4;
    type Point = Point<RidePoint>;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        Ok(Self::parse(experiment)?)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        curves::schema::<RidePoint>(generator)
    }

    fn points(&self) -> Vec<Point<RidePoint>> {
        self.points.clone()
    }

    fn identity(&self, point: &Point<RidePoint>) -> Identity {
        point.of.identity()
    }

    fn shape(&self) -> Shape {
        RideSums::shape(self)
    }

    fn trials(&self, points: &[&Point<RidePoint>], seed: u64, trial: u64) -> Vec<Sums> {
        let each = points.iter().map(|point| {
            let mut sums = RideSums::default();
            sums.add(&point.of.trial(seed, trial));
            sums.into()
        });
        each.collect()
    }

    fn check(&self, point: &Point<RidePoint>, sums: &Sums, trials: u64) -> Result<(), OutOfRange> {
        RideSums::from(sums.clone()).check(&point.of, trials)
    }

    fn estimates(
        &self,
        _: &Point<RidePoint>,
        sums: &Sums,
        trials: u64,
        confidence: f64,
    ) -> Vec<Estimate> {
        estimate::of(self.measure, &sums.clone().into(), trials, confidence)
    }

    fn row(&self, point: &Point<RidePoint>, estimate: Estimate, context: &Context) -> Row {
        Row::new(self, point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        self.name_at(row.curve, row.x)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, self, seed)
    }
}
