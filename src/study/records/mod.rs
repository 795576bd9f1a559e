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
//! | `false_rides` | hours | starts told while the cage stood, per hour for which it stood |
//! | `false_records` | records | records with one |
//! | `known` | hours | for which share of its rest it is told to rest |
//! | `start_delay_…`, `stop_delay_…` | trips | quantiles of the time to when it is told, in tenths of a second |
//!
//! Trips of one record share their lift and their sensor, so intervals of shares of trips are somewhat too narrow;
//! those of shares of records are exact.

mod detect;
mod picture;
mod row;
mod sums;
mod table;
#[cfg(test)]
mod tests;
mod watched;

pub use row::Row;

use crate::counts::{Counts, Sums};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::lift::{Class, Record};
use crate::plot::Plot;
use crate::results::Quantity;
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::study::kind::{Context, Counters, Study, counted};
use detect::{Told, detect};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::{Table, Watch};
use watched::Watched;

/// Records in a block. A record takes tens of milliseconds.
const BLOCK: u64 = 4;

/// Which of two numbers.
type Pick = fn(f64, f64) -> f64;

/// The least and the largest of the classes, as parts of the names of quantities.
const EXTREMES: [(&str, Pick); 2] = [("least", f64::min), ("most", f64::max)];

/// Records of several classes.
pub(super) struct Records {
    context: Context,
    table: Table,
    counters: Counters,
}

impl Records {
    /// One record of a class.
    fn trial(&self, class: Class, trial: u64) -> Sums {
        let record = Record::new(class, self.context.seed, trial);
        let (table, tolerance) = (&self.table, self.table.tolerance.get());
        let Ok(design) = table.settings.at(record.rate) else {
            unreachable!("rates lie in 5 to 500 Hz, which every block fits")
        };
        match table.watch {
            Watch::Detect => {
                let outcome = detect(&design, &record);
                let least_speed = table.settings.monitor.least_speed;
                Told::new(&record, &outcome, least_speed, tolerance).into()
            }
            Watch::Monitor => Watched::new(class, &record, &design, tolerance).into(),
        }
    }
}

impl Study for Records {
    const NAME: &'static str = "records";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let table: Table = experiment.read()?;
        table.check().map_err(|error| experiment.refuse(error))?;
        let settings = table.settings.check();
        settings.map_err(|error| {
            experiment.refuse(error.called(|path| format!("records.settings.{path}")))
        })?;
        let shape = table.watch.shape();
        let mut records = Self {
            context,
            table,
            counters: Counters::default(),
        };
        records.counters = Counters::new(&records, context.seed, &shape);
        Ok(records)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Table::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let classes = self.table.class.iter();
        classes.map(|class| self.table.identity(*class)).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    /// All outcomes of each class in turn.
    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let Self { context, table, .. } = self;
        let shape = table.watch.shape();
        let mut rows = Vec::new();
        for (class, key) in table.class.iter().zip(&self.counters.keys) {
            let (trials, sums) = counted(counts, key, &shape);
            let estimates = table.watch.estimates(&sums, trials, context.confidence);
            let estimates = estimates.into_iter();
            rows.extend(estimates.map(|of| Row::new(*class, of, table, context)));
        }
        rows
    }

    /// Each outcome by its name and that of its class; and its least and largest, where it could happen.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &Row| Quantity {
            name: format!("{}_{}", row.outcome, row.class),
            value: row.estimate,
            low: row.low,
            high: row.high,
        };
        let mut quantities: Vec<Quantity> = rows.iter().map(quantity).collect();
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
        Ok(quantities)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, self.table.watch, seed))
    }
}

impl Trials for &Records {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        for key in &self.counters.keys {
            if let Some(counter) = counts.get(key) {
                let checked = self.table.watch.check(&counter.sums);
                checked.map_err(|error| format!("counter {key}: {error}"))?;
            }
        }
        Ok(())
    }

    /// Each class forms a group of its own.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        self.counters.apart(targets, |at| {
            let class = self.table.class[at];
            move |number| self.trial(class, number)
        })
    }
}
