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

use crate::counts::{Shape, Sums};
use crate::experiment::Experiment;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::rule::{OutOfRange, Rule};
use crate::run::{Identity, StudyError};
use crate::stats::tally::Tally;
use crate::study::curves::{self, Point};
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::study::outcomes::Outcomes;
use keys::Keys;
use measure::Measure;
use schemars::SchemaGenerator;
use serde_json::Value;
use std::collections::BTreeSet;
pub(super) use table::Table;

impl Outcomes for Table {
    const NAME: &'static str = "floors";
    /// One of 1000 trips takes about ten milliseconds.
    const BLOCK: u64 = 8;
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
        trial::shape(self.measure, &self.points)
    }

    fn trials(&self, points: &[&Point<Keys>], seed: u64, trial: u64) -> Vec<Sums> {
        trial::run(self.measure, points, seed, trial)
    }

    /// A building.
    fn family(&self, point: &Point<Keys>) -> Identity {
        point.building(self.measure)
    }

    /// As many stops as trips, and no more alarms than stops.
    fn check(&self, point: &Point<Keys>, sums: &Sums, trials: u64) -> Result<(), OutOfRange> {
        let counts = &sums.counts;
        let (stops, events) = match self.measure {
            Measure::Alarm => (counts[2], &counts[3..]),
            Measure::Stops => (counts[0], &counts[1..]),
            Measure::Position | Measure::Healing => return Ok(()),
        };
        let all = trials.saturating_mul(point.of.trips as u64) as f64;
        Rule::Within(all, all, "").check("stops", &(stops as f64))?;
        let most = events.iter().copied().max().unwrap_or_default();
        Rule::Within(0.0, stops as f64, "").check("alarms", &(most as f64))
    }

    fn estimates(
        &self,
        point: &Point<Keys>,
        sums: &Sums,
        trials: u64,
        confidence: f64,
    ) -> Vec<Estimate> {
        estimate::of(self.measure, &point.of, sums, trials, confidence)
    }

    fn row(&self, point: &Point<Keys>, estimate: Estimate, context: &Context) -> Row {
        Row::new(self, point, estimate, context)
    }

    fn name(&self, row: &Row) -> String {
        self.name_at(row.curve, row.x)
    }

    /// Ordinary stops of each building, which several points may share.
    fn false_alarms(&self, rows: &[Row]) -> Vec<Scenario> {
        let mut known = BTreeSet::new();
        let mut scenarios = Vec::new();
        for point in &self.points {
            if known.insert(point.building(self.measure)) {
                let here = |row: &&Row| row.curve == point.curve + 1 && row.x == point.x;
                let is_counted =
                    |row: &&Row| row.outcome.starts_with("false_") && row.exposure > 0.0;
                scenarios.extend(rows.iter().filter(here).filter(is_counted).map(scenario));
            }
        }
        scenarios
    }

    fn nothing_promised() -> Option<OutOfRange> {
        let remedy = " (set trips, and measure = \"alarm\" or \"stops\")";
        Some(OutOfRange::new("floors", "count ordinary stops", "none").explained(remedy))
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Plot {
        picture::plot(rows, self, seed)
    }
}

/// The false alarms per stop that a map promises.
const PROMISED: f64 = 1e-3;

fn scenario(row: &Row) -> Scenario {
    Scenario {
        name: format!("{}, {}, noise {}", row.label, row.outcome, row.noise),
        cases: "stops",
        nominal: PROMISED,
        tally: Tally {
            hits: row.count,
            trials: row.exposure as u64,
        },
    }
}
