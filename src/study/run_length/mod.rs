//! How often CUSUMs of sequential ranks ([`crate::detect::sequential`]) alarm at rest, by the noise, against what their law
//! promises.
//!
//! A trial is a record at rest of one noise, of which `blocks` monitored blocks count; the references before them and after
//! every alarm do not, nor does what is monitored before S has forgotten that it began at 0
//! ([`settled`](crate::detect::sequential::RunLength::settled)). Blocks of coloured noise, x ← φ x + e, are not exchangeable, so nothing is promised of them.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `false_alarms` | blocks | false alarms per monitored block |
//! | `over_promised` | blocks | that over the rate that was asked for |
//! | `over_law` | blocks | that over what the law of the run length says of the threshold: of up and down exact |
//!
//! # The test
//! A monitored block is a case, and an alarm a hit, as if every block alarmed with the promised probability independently of
//! all before; Garwood's interval of the rate is that of a Poisson count. At rest a block alarms with the probability of the law on average. Alarms come more
//! evenly than that: after one, S starts at 0, and the wait for the next is at least as long as it ever is. So both are on
//! the safe side.

mod delay;
mod picture;
mod table;
#[cfg(test)]
mod tests;
mod trial;

pub use delay::{Delay, delays};
pub use picture::delays as plot_delays;
pub use table::Row;

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::stats::tally::Tally;
use crate::study::curves::name_of;
use crate::study::estimate::{Estimate, rate};
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use table::{Blocks, Table, Watch};

/// The table with its chart and threshold.
#[derive(Debug)]
pub(super) struct RunLengths {
    table: Table,
    detector: Watch,
    /// False alarms per block: as promised, and by the law.
    promised: f64,
    exact: f64,
}

impl Outcomes for RunLengths {
    const NAME: &'static str = "run_length";
    /// One takes some milliseconds.
    const BLOCK: u64 = 8;
    type Point = Blocks;
    type Row = Row;

    fn read(experiment: &Experiment) -> Result<Self, StudyError> {
        let table: Table = experiment.read()?;
        let made = table.check().and_then(|()| table.detector());
        let refuse = |error: OutOfRange| experiment.conflict(error.under(Self::NAME).into());
        let (detector, [promised, exact]) = made.map_err(refuse)?;
        Ok(Self {
            table,
            detector,
            promised,
            exact,
        })
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Table::json_schema(generator).to_value()
    }

    fn points(&self) -> Vec<Blocks> {
        self.table.noise.clone()
    }

    fn identity(&self, noise: &Blocks) -> Identity {
        let detector = serde_json::to_value(&self.table).expect("a table is plain data");
        let keys = detector.as_object().into_iter().flatten();
        let keys = keys.filter(|(key, _)| *key != "noise");
        let keys = keys.map(|(key, value)| (key.clone(), value.to_string()));
        Identity::new(keys.chain([("noise".to_owned(), noise.subject())]))
    }

    fn shape(&self) -> Shape {
        Shape {
            most: vec![Some(self.table.blocks)],
            ..Shape::default()
        }
    }

    fn trials(&self, points: &[&Blocks], seed: u64, trial: u64) -> Vec<Sums> {
        let alarms = points
            .iter()
            .map(|noise| self.detector.false_alarms(noise, seed, trial));
        alarms.map(|alarms| Sums::of(&[alarms])).collect()
    }

    fn estimates(&self, _: &Blocks, sums: &Sums, trials: u64, confidence: f64) -> Vec<Estimate> {
        let blocks = (trials * self.table.blocks) as f64;
        let over = |name: &str, rate_of_one: f64| {
            rate(name, sums.counts[0], blocks * rate_of_one, "", confidence)
        };
        let named = [
            over("false_alarms", 1.0),
            over("over_promised", self.promised),
            over("over_law", self.exact),
        ];
        let counted = |estimate| Estimate {
            exposure: blocks,
            unit: "blocks",
            ..estimate
        };
        named.map(counted).to_vec()
    }

    fn row(&self, noise: &Blocks, estimate: Estimate, context: &Context) -> Row {
        Row::new(noise, &self.detector, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        name_of(&row.label)
    }

    /// Of all noise of which something is promised.
    fn false_alarms(&self, rows: &[Row]) -> Vec<Scenario> {
        let tested = |row: &&Row| row.outcome == "false_alarms" && row.promised;
        let scenario = |row: &Row| Scenario {
            name: row.label.clone(),
            cases: "blocks",
            nominal: self.promised,
            tally: Tally {
                hits: row.count,
                trials: row.exposure as u64,
            },
        };
        rows.iter().filter(tested).map(scenario).collect()
    }

    fn nothing_promised() -> Option<OutOfRange> {
        let noise = format!("{}.noise", Self::NAME);
        let error = OutOfRange::new(noise, "promise a rate", "promised = false in all");
        Some(error.explained(" (take one of them out)"))
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::rates(rows, &self.table, seed)
    }
}
