//! How high a barometer says that a car went ([`crate::track::Climbs`]), by the air of the building, against the truth.
//!
//! A trial is a lift of [`super::height`] in steady weather, whose accelerometer has an error of its gain of 1 %. Its
//! barometer reads the pressure of air of one temperature, to 3 Pa a reading. All points of one index are one lift.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `scale_…` | trials | the heights of the trips over what they are, by least squares |
//! | `error_…`, `rms_…` | trials | mean and root mean square of the size of a trip's error, m |
//! | `within_…` | trials | the share of trips within 1.96 stated deviations |
//! | `celsius` | trials | RMS error of the learnt temperature, K |
//!
//! The ways: `printed`, by the standard atmosphere, eq. (5); `usual`, air of 20 °C, whatever it is; `learnt`, with the
//! temperature that the accelerometer's trips give; `given`, with the right one.

mod picture;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub use table::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::run::{Identity, StudyError};
use crate::study::estimate::{Estimate, Mean};
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::Point;
pub(super) use table::Table;
use trial::Way;

impl Outcomes for Table {
    const NAME: &'static str = "air";
    /// One takes a tenth of a second.
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
        let air = self.family(point).with("temperature", point.temperature);
        air.with("pressure", point.pressure)
    }

    /// The air changes nothing but the barometer.
    fn family(&self, _: &Point) -> Identity {
        Identity::new([("trips", self.trips.to_string())])
    }

    fn shape(&self) -> Shape {
        trial::shape()
    }

    fn trials(&self, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
        trial::run(self.trips, points, seed, trial)
    }

    fn estimates(&self, _: &Point, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let mean = |place| Mean::new(sums, place, trials, confidence);
        let each = Way::ALL.into_iter().enumerate();
        let estimates = each.flat_map(|(place, way)| {
            let name = |outcome: &str| format!("{outcome}_{}", way.name());
            let mean = |at| mean(trial::PAIRS * place + at);
            let estimates = [
                mean(0).named(&name("scale"), trials, "trials"),
                mean(1).named(&name("error"), trials, "trials"),
                mean(2).root().named(&name("rms"), trials, "trials"),
                mean(3).named(&name("within"), trials, "trials"),
            ];
            // Eq. (5) states no deviation.
            let stated = if way == Way::Printed { 3 } else { 4 };
            estimates.into_iter().take(stated)
        });
        let celsius = mean(trial::PAIRS * Way::ALL.len()).root();
        estimates
            .chain([celsius.named("celsius", trials, "trials")])
            .collect()
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        format!("{}_{}", row.temperature, row.pressure).replace(['.', '-'], "_")
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, &self.grid(), seed)
    }
}
