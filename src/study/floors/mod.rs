//! Floor maps of simulated buildings: alarms beside floors, false alarms, position, missed trips.
//!
//! A trial is one building: a sweep of all floors, its trips, and what is measured after them. Trips are drawn from
//! the stated law of their errors (`building`); no accelerometer record is simulated and no trip filter runs. All
//! points use the same draws in a trial.
//!
//! | outcome | of | is |
//! |---|---|---|
//! | `alarmed` | trials | the stop beside its floor alarms at once |
//! | `alarmed_again` | trials | it does, judged again after the next trip |
//! | `bound`, `bound_again` | | the same if the map were exact and the start known to σ_s, computed |
//! | `false_alarms` | stops | ordinary stops that alarm at once |
//! | `false_again` | stops | that alarm when judged again |
//! | `false_any` | stops | that do either |
//! | `wrong_floors` | stops | that are taken for another floor |
//! | `position`, `reckoned` | trials | RMS of the position's error by the map, and by the sum of all trips, m |
//! | `map` | trials | RMS of the floors' errors above the lowest, m |
//! | `nees` | trials | mean of eᵀ P⁻¹ e per floor |
//! | `healed` | trials | the floor is right, so many trips after a missed one |

pub(crate) mod building;
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

use crate::counts::{Counter, Counts};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::rule::{OutOfRange, Rule};
use crate::run::{Group, Identity, StudyError, Target, Trials};
use crate::stats::tally::Tally;
use crate::study::kind::{Context, Counters, Study, counted};
use measure::Measure;
use schemars::SchemaGenerator;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use table::{Point, Table};

/// Buildings in a block. One of 1000 trips takes about ten milliseconds.
const BLOCK: u64 = 8;

/// Buildings along an axis.
pub(super) struct Buildings {
    context: Context,
    table: Table,
    counters: Counters,
}

impl Study for Buildings {
    const NAME: &'static str = "floors";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let table = Table::read(experiment)?;
        let shape = trial::shape(table.measure, &table.points);
        let mut buildings = Self {
            context,
            table,
            counters: Counters::default(),
        };
        buildings.counters = Counters::new(&buildings, context.seed, &shape);
        Ok(buildings)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        table::schema(generator)
    }

    fn identities(&self) -> Vec<Identity> {
        let points = self.table.points.iter();
        points
            .map(|point| point.identity(self.table.measure))
            .collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    /// All outcomes of all points, in the order of curves and values.
    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let Self { context, table, .. } = self;
        let shape = trial::shape(table.measure, &table.points);
        let mut rows = Vec::new();
        for (point, key) in table.points.iter().zip(&self.counters.keys) {
            let (trials, sums) = counted(counts, key, &shape);
            let estimates = estimate::of(
                table.measure,
                &point.keys,
                &sums,
                trials,
                context.confidence,
            );
            let estimates = estimates.into_iter();
            rows.extend(estimates.map(|of| Row::new(table, point, of, context)));
        }
        rows
    }

    /// Each outcome by name. The name joins those of the outcome, its curve and its place on the axis.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &Row| {
            let curve = self.table.name(row.curve - 1);
            let x = row.x.to_string().replace('.', "_");
            Quantity {
                name: format!("{}_{curve}_at_{x}", row.outcome),
                value: row.estimate,
                low: row.low,
                high: row.high,
            }
        };
        Ok(rows.iter().map(quantity).collect())
    }

    /// Ordinary stops of each building, which several points may share.
    fn false_alarms(&self, rows: &[Row]) -> Vec<Scenario> {
        let mut known = BTreeSet::new();
        let mut scenarios = Vec::new();
        for point in &self.table.points {
            if known.insert(point.building(self.table.measure)) {
                let here = |row: &&Row| row.curve == point.curve + 1 && row.x == point.x;
                let is_counted =
                    |row: &&Row| row.outcome.starts_with("false_") && row.exposure > 0.0;
                scenarios.extend(rows.iter().filter(here).filter(is_counted).map(scenario));
            }
        }
        scenarios
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, &self.table, seed))
    }
}

impl Trials for &Buildings {
    fn targets(&self) -> &[Target] {
        &self.counters.targets
    }

    fn block(&self) -> u64 {
        BLOCK
    }

    fn check(&self, counts: &Counts) -> Result<(), StudyError> {
        let measure = self.table.measure;
        for (point, key) in self.table.points.iter().zip(&self.counters.keys) {
            if let Some(Counter { trials, sums }) = counts.get(key) {
                let checked = check_stops(measure, point, &sums.counts, trials.len());
                checked.map_err(|error| format!("counter {key}: {error}"))?;
            }
        }
        Ok(())
    }

    /// Points that share a building form a group.
    fn groups(&self, targets: &[usize]) -> Vec<Group<'_>> {
        let (measure, seed) = (self.table.measure, self.context.seed);
        let mut shared: BTreeMap<Identity, Vec<usize>> = BTreeMap::new();
        for &target in targets {
            let point = &self.table.points[self.counters.points[target]];
            shared
                .entry(point.building(measure))
                .or_default()
                .push(target);
        }
        let group = |targets: Vec<usize>| {
            let points = targets
                .iter()
                .map(|at| &self.table.points[self.counters.points[*at]]);
            let points: Vec<&Point> = points.collect();
            Group::new(targets, move |trials| {
                let shape = trial::shape(measure, &self.table.points);
                let mut sums = vec![shape.empty().sums; points.len()];
                for trial in trials {
                    let more = trial::run(measure, &points, seed, trial);
                    sums.iter_mut()
                        .zip(&more)
                        .for_each(|(sum, more)| sum.add(more));
                }
                sums
            })
        };
        shared.into_values().map(group).collect()
    }
}

/// The false alarms per stop that a map promises.
const PROMISED: f64 = 1e-3;

fn scenario(row: &Row) -> Scenario {
    Scenario {
        name: format!("{}, {}, noise {}", row.label, row.outcome, row.noise),
        nominal: PROMISED,
        tally: Tally {
            hits: row.count,
            trials: row.exposure as u64,
        },
    }
}

/// Checks that so many trials can give these counts: as many stops as trips, and no more alarms than stops.
fn check_stops(
    measure: Measure,
    point: &Point,
    counts: &[u64],
    trials: u64,
) -> Result<(), OutOfRange> {
    let (stops, events) = match measure {
        Measure::Alarm => (counts[2], &counts[3..]),
        Measure::Stops => (counts[0], &counts[1..]),
        Measure::Position | Measure::Healing => return Ok(()),
    };
    let all = trials.saturating_mul(point.keys.trips as u64) as f64;
    Rule::Within(all, all, "").check("stops", &(stops as f64))?;
    let most = events.iter().copied().max().unwrap_or_default();
    Rule::Within(0.0, stops as f64, "").check("alarms", &(most as f64))
}
