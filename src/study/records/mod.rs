//! Shows hard records ([`crate::lift::Record`]) to the detector or to the monitor, class by class.
//!
//! | outcome of `detect` | of | is |
//! |---|---|---|
//! | `found` | trips | told in the right direction, start and stop within the tolerance |
//! | `undecided` | trips | not found, but within a stretch that is said to be undecided |
//! | `misplaced` | trips | told in the right direction, but start or stop are wrong |
//! | `missed_silently` | trips | none of these |
//! | `false_trips` | records | trips told where none went in that direction, per record |
//! | `false_records` | records | records with one |
//! | `found_between_rests` | trips between rests | found, of those whose start and stop the record shows, with a second of rest before and after |
//!
//! | outcome of `monitor` | of | is |
//! |---|---|---|
//! | `rest_in_motion` | records | `rest` is said for more than 1 s above 0.2 m/s |
//! | `rest_in_motion_ms` | records | for how long beyond 1 s, ms per record |
//! | `slack_missed` | turns of the drum | no `slack` within `longest_slack` and the tolerance, though the cage stands |
//! | `false_slack` | records | `slack` while the drum does not turn or the cage moves, per record |
//! | `false_rides` | hours | motions told while the cage stood, per hour for which it stood |
//! | `false_records` | records | records with one |
//! | `wrong_way` | records | a direction stands against that of a cage above 0.2 m/s, at whatever moment |
//! | `known` | hours | for which share of its rest it is told to rest |
//! | `directed`, `misdirected` | hours | for which share of its time above 0.2 m/s its direction stands, and for which the other one |
//! | `start_delay_…`, `stop_delay_…` | trips | quantiles of the time to when it is told, in tenths of a second |
//!
//! Trips of one record share their lift and their sensor, so intervals of shares of trips are somewhat too narrow;
//! those of shares of records are exact. Those of shares of the time are by the delta method, from record to record.

mod detect;
mod picture;
mod row;
mod sums;
mod table;
#[cfg(test)]
mod tests;
mod watched;

pub use row::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::lift::{Class, Record};
use crate::plot::Plot;
use crate::results::Quantity;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use detect::{Told, detect};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
pub(super) use table::Table;
use table::Watch;
use watched::Watched;

/// Which of two numbers.
type Pick = fn(f64, f64) -> f64;

/// The least and the largest of the classes, as parts of the names of quantities.
const EXTREMES: [(&str, Pick); 2] = [("least", f64::min), ("most", f64::max)];

impl Table {
    /// One record of a class.
    fn trial(&self, class: Class, seed: u64, trial: u64) -> Sums {
        let record = Record::new(class, seed, trial);
        let tolerance = self.tolerance.get();
        let design = self.design.as_ref().expect("a table is read with it");
        let Ok(design) = design.at(record.rate) else {
            unreachable!("rates lie in 5 to 500 Hz, which every block fits")
        };
        match self.watch {
            Watch::Detect => {
                let outcome = detect(&design, &record);
                let least_speed = self.settings.monitor.least_speed;
                Told::new(&record, &outcome, least_speed, tolerance).into()
            }
            Watch::Monitor => Watched::new(class, &record, &design, tolerance).into(),
        }
    }
}

impl Outcomes for Table {
    const NAME: &'static str = "records";
    /// A record takes tens of milliseconds.
    const BLOCK: u64 = 4;
    type Point = Class;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        let mut table: Self = experiment.read()?;
        (table.check()).map_err(|error| experiment.conflict(error.into()))?;
        let design = table.settings.nominal().map_err(|error| {
            experiment.refuse(error.called(|path| format!("records.settings.{path}")))
        })?;
        table.design = Some(design);
        Ok(table)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Self::json_schema(generator).to_value()
    }

    fn points(&self) -> Vec<Class> {
        self.class.clone()
    }

    fn identity(&self, class: &Class) -> Identity {
        self.parameters(*class)
    }

    fn shape(&self) -> Shape {
        self.watch.shape()
    }

    fn trials(&self, classes: &[&Class], seed: u64, trial: u64) -> Vec<Sums> {
        let each = classes.iter().map(|class| self.trial(**class, seed, trial));
        each.collect()
    }

    fn check(&self, _: &Class, sums: &Sums, _: u64) -> Result<(), OutOfRange> {
        self.watch.check(sums)
    }

    fn estimates(&self, _: &Class, sums: &Sums, records: u64, confidence: f64) -> Vec<Estimate> {
        self.watch.estimates(sums, records, confidence)
    }

    fn row(&self, class: &Class, estimate: Estimate, context: &Context) -> Row {
        Row::new(self, *class, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        row.class.to_string()
    }

    /// The least and the largest of each outcome, where it could happen.
    fn extremes(&self, rows: &[Row]) -> Vec<Quantity> {
        let mut quantities = Vec::new();
        let outcomes = rows.iter().filter(|row| row.class == rows[0].class);
        for outcome in outcomes.map(|row| &row.outcome) {
            let mut of: Vec<&Row> = rows.iter().filter(|row| row.outcome == *outcome).collect();
            // Before anything is counted, claims are checked for their names.
            if of.iter().any(|row| row.exposure > 0.0) {
                of.retain(|row| row.exposure > 0.0);
            }
            for (name, pick) in EXTREMES {
                // An end of the interval of the extreme is the extreme of the ends.
                let extreme =
                    |number: fn(&Row) -> f64| of.iter().map(|row| number(row)).reduce(pick);
                if let (Some(value), Some(low), Some(high)) = (
                    extreme(|row| row.estimate),
                    extreme(|row| row.low),
                    extreme(|row| row.high),
                ) {
                    let name = format!("{outcome}_{name}");
                    quantities.push(Quantity {
                        name,
                        value,
                        low,
                        high,
                    });
                }
            }
        }
        quantities
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, self.watch, seed)
    }
}
