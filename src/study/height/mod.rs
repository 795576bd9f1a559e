//! Where the car is by accelerometer and barometer ([`crate::track::fusion`]) in every way there is, against the truth, as the
//! weather changes.
//!
//! A trial is a lift of ten floors, 4 m apart, that goes from floor to floor and rests 15 to 45 s at each, recorded by an
//! MPU-6050 at 200 Hz and a BMP180 at 39.2 Hz (0.25 m a reading). The weather moves the barometer's height steadily, up in
//! half of the trials. All points of one index are one lift.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `error_…` | trials | mean size of the error of the height over time, m |
//! | `rms_…` | trials | root of its mean square, m |
//! | `error_10_…` to `error_99_…` | moments | the error that it stays within in so many % of the time, m |
//!
//! The ways: `ukf`, the published filter alone; `calibrated`, with the barometer calibrated at each rest; `map`, which knows the
//! floors too; `map_printed_q` and `map_mended_q`, which adapt Q; `trips`, the distances of `liftsim track`; `slow`, with the
//! barometer as a slow height; `slow_map`, which knows the floors too.

mod picture;
mod row;
mod table;
#[cfg(test)]
mod tests;
mod trial;
mod watched;
mod way;

pub use row::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::run::{Identity, StudyError};
use crate::study::estimate::{Estimate, Mean, quantile};
use crate::study::kind::Context;
use crate::study::outcomes::{Outcomes, checked};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::Point;
pub(super) use table::Table;
pub(super) use watched::Watched;
use way::{SHARES, Way};

impl Outcomes for Table {
    const NAME: &'static str = "height";
    /// One takes a second.
    const BLOCK: u64 = 1;
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

    /// The weather changes nothing but the barometer.
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
            let mean = |at| Mean::new(sums, 2 * place + at, trials, confidence);
            let within = SHARES.map(|share| {
                let outcome = name(&format!("error_{share}"));
                let p = f64::from(share) / 100.0;
                let within = quantile(&outcome, &sums.values[place], p, confidence);
                // Moments of one lift tell nothing of others, so there is no interval.
                Estimate {
                    unit: "moments",
                    low: within.value,
                    high: within.value,
                    ..within
                }
            });
            let error = mean(0).named(&name("error"), trials, "trials");
            let rms = mean(1).root().named(&name("rms"), trials, "trials");
            [error, rms].into_iter().chain(within)
        });
        estimates.collect()
    }

    fn row(&self, point: &Point, estimate: Estimate, context: &Context) -> Row {
        Row::new(point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        row.drift.to_string().replace('.', "_")
    }

    /// The drift from which on calibration helps, between those of two points; the first if it does there, infinite if it never does.
    fn extremes(&self, rows: &[Row]) -> Vec<Quantity> {
        let of = |way: Way| {
            let outcome = format!("error_{}", way.name());
            let rows = rows.iter().filter(move |row| row.outcome == outcome);
            rows.map(|row| (row.drift, row.estimate))
        };
        let gains: Vec<(f64, f64)> = of(Way::Ukf)
            .zip(of(Way::Calibrated))
            .map(|((drift, alone), (_, calibrated))| (drift, alone - calibrated))
            .collect();
        let crossing = gains.windows(2).find_map(|pair| {
            let [(low, loss), (high, gain)] = [pair[0], pair[1]];
            let value = low + (high - low) * loss / (loss - gain);
            (loss < 0.0 && gain >= 0.0).then_some([value, low, high])
        });
        let always = gains.first().filter(|it| it.1 >= 0.0).map(|it| [it.0; 3]);
        let [value, low, high] = always.or(crossing).unwrap_or([f64::INFINITY; 3]);
        vec![Quantity {
            name: "break_even".to_owned(),
            value,
            low,
            high,
        }]
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, seed)
    }
}
