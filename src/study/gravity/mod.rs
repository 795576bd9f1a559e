//! Gravity from a window of two seconds at rest ([`crate::track::gravity`]), by every estimator, against the truth.
//!
//! A trial is one window: a random pose and the readings of three axes. All estimators see the same readings, and the
//! windows of all conditions with one index begin with the same draws.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `error_…` | trials | root mean square of the vector's error, mm/s² |
//! | `over_mean_…` | trials | that over the error of the mean, window by window |
//!
//! The estimators: `mean`; `trimmed`, the mean without outliers of the length; `median`, the geometric median; `printed`,
//! the geometric median without outliers; `calibration`, which is `printed`, or `trimmed` where the steps are coarse.

mod condition;
mod picture;
mod row;
#[cfg(test)]
mod tests;

pub use row::Row;

use crate::counts::{Fixed, Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::study::estimate::{Estimate, Mean};
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use crate::track::gravity::Estimator;
use crate::vector::{dot, mix};
use condition::{Condition, Window};
use schemars::{JsonSchema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Windows at rest under several conditions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Windows {
    /// Under which conditions.
    condition: Vec<Condition>,
}

/// For each estimator the sum of the square of its error and of that squared, mm²/s⁴; then the sum of its product with the
/// square of the mean's error.
const LENGTHS: usize = 2;

impl Outcomes for Windows {
    const NAME: &'static str = "gravity";
    /// A window takes a tenth of a millisecond.
    const BLOCK: u64 = 256;
    type Point = Condition;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        let table: Self = experiment.read()?;
        let conditions = &table.condition;
        let is_twice = |it: &Condition| conditions.iter().filter(|other| *other == it).count() > 1;
        let got = match conditions.iter().find(|it| is_twice(it)) {
            _ if conditions.is_empty() => "none".to_owned(),
            Some(twice) => format!("{twice} twice"),
            None => return Ok(table),
        };
        let refused = OutOfRange::new("gravity.condition", "name each condition once", got);
        Err(experiment.refuse(refused).into())
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Self::json_schema(generator).to_value()
    }

    fn points(&self) -> Vec<Condition> {
        self.condition.clone()
    }

    fn identity(&self, condition: &Condition) -> Identity {
        Identity::new([("condition", condition.to_string())])
    }

    fn shape(&self) -> Shape {
        Shape {
            lengths: (LENGTHS + 1) * Estimator::ALL.len(),
            ..Shape::default()
        }
    }

    fn trials(&self, conditions: &[&Condition], seed: u64, trial: u64) -> Vec<Sums> {
        let each = conditions.iter().map(|condition| {
            let Window {
                gravity,
                readings,
                step,
            } = Window::new(**condition, seed, trial);
            let squares = Estimator::ALL.map(|estimator| {
                let found = estimator.gravity(&readings, step);
                let found = found.expect("a window has readings");
                let error = mix([(1000.0, found), (-1000.0, gravity)]);
                dot(error, error)
            });
            let pairs = squares.iter().flat_map(|it| [*it, it * it]);
            let products = squares.iter().map(|it| it * squares[0]);
            Sums {
                lengths: pairs.chain(products).map(Fixed::new).collect(),
                ..Sums::default()
            }
        });
        each.collect()
    }

    fn check(&self, _: &Condition, _: &Sums, _: u64) -> Result<(), OutOfRange> {
        Ok(())
    }

    fn estimates(&self, _: &Condition, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let mean = |place| Mean::new(sums, place, trials, confidence);
        let products = &sums.lengths[LENGTHS * Estimator::ALL.len()..];
        let all = Estimator::ALL.iter().zip(products).enumerate();
        let estimates = all.flat_map(|(place, (estimator, product))| {
            let product = product.value() / trials as f64;
            let over_mean = mean(place).ratio(mean(0), product, trials, confidence);
            [("error", mean(place)), ("over_mean", over_mean)].map(|(outcome, square)| {
                let name = format!("{outcome}_{}", estimator.name());
                square.root().named(&name, trials, "trials")
            })
        });
        estimates.collect()
    }

    fn row(&self, condition: &Condition, estimate: Estimate, context: &Context) -> Row {
        Row::new(*condition, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        row.condition.to_string()
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, &self.condition, seed)
    }
}
