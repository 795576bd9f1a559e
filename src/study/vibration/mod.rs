//! Horizontal vibration of simulated lifts beside a [baseline](crate::track::vibration): when learning stops, what the guard
//! line does to ordinary trips, and whether a knock is found, and where.
//!
//! A trial is one lift (`car`): its trips between random floors are learnt until a rule stops; then 100 others are set
//! beside the guard line, or one with a knock at a joint of the rails is, as `liftsim track` finds and measures it. All
//! points that shake alike share the lift and its trips.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `stopped` | lifts | learning stopped within 500 trips, or after the trips that were asked for |
//! | `early` | lifts that did | the mean is off by more than a tenth |
//! | `off` | lifts | RMS of the relative error of the mean |
//! | `trips`, `windows` | lifts | mean number of what was learnt |
//! | `guarded` | lifts | there is a guard line: the order statistic needs windows enough |
//! | `line` | lifts | the guard line over the true mean; 0 where there is none |
//! | `false_windows`, `false_trips` | lifts | the mean share of ordinary windows above the line, and of trips with one |
//! | `rides` | lifts | the ride with the knock is found, alone |
//! | `found` | of these | an alarm holds the knock |
//! | `elsewhere` | of these | another does not |
//! | `located` | knocks found | RMS error of the position, m |

mod car;
mod estimate;
mod keys;
mod measure;
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
use crate::rule::{OutOfRange, Rule};
use crate::run::{Identity, StudyError};
use crate::study::curves::{self, Point};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use keys::Keys;
use schemars::SchemaGenerator;
use serde_json::Value;
pub(super) use table::Table;

impl Outcomes for Table {
    const NAME: &'static str = "vibration";
    /// One takes about twenty milliseconds.
    const BLOCK: u64 = 4;
    type Point = Point<Keys>;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        Ok(Self::parse(experiment)?)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        curves::schema::<Keys>(generator)
    }

    fn points(&self) -> Vec<Point<Keys>> {
        self.points.clone()
    }

    fn identity(&self, point: &Point<Keys>) -> Identity {
        point.identity(self.measure)
    }

    fn shape(&self) -> Shape {
        trial::shape(self.measure)
    }

    fn trials(&self, points: &[&Point<Keys>], seed: u64, trial: u64) -> Vec<Sums> {
        trial::run(self.measure, points, seed, trial)
    }

    /// A lift.
    fn family(&self, point: &Point<Keys>) -> Identity {
        point.lift(self.measure)
    }

    /// What is counted of some lifts is no more than these.
    fn check(&self, _: &Point<Keys>, sums: &Sums, trials: u64) -> Result<(), OutOfRange> {
        for (place, (name, among)) in estimate::shares(self.measure).into_iter().enumerate() {
            let most = among.map_or(trials, |among| sums.counts[among]);
            Rule::Within(0.0, most as f64, "").check(name, &(sums.counts[place] as f64))?;
        }
        Ok(())
    }

    fn estimates(
        &self,
        _: &Point<Keys>,
        sums: &Sums,
        trials: u64,
        confidence: f64,
    ) -> Vec<Estimate> {
        estimate::of(self.measure, sums, trials, confidence)
    }

    fn row(&self, point: &Point<Keys>, estimate: Estimate, context: &Context) -> Row {
        Row::new(self, point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        self.name_at(row.curve, row.x)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, self, seed)
    }
}
