//! The operating point: the Δ/σ_ξ at which the power reaches a wanted value, for samples of several
//! sizes, by a search with an interval.
//!
//! All trials run on the same noise at every Δ of a grid. They run again on a grid thirty-two times finer
//! around each crossing. The operating point is the Δ at which the rate first reaches the wanted power.
//! Its interval inverts the exact intervals of the rates: it runs from the last Δ before the upper limit
//! first reaches the power to the first Δ after the lower limit was last below it. If the power grows with
//! Δ, an end misses only if the interval at one of the two neighbours of the true point misses, so the
//! interval covers that point with the stated confidence. The search says nothing beyond its ends. If the
//! upper limit reaches the power at the start of the search, the interval is open below. If the lower limit
//! has not reached it at the end, the interval is open above.

mod grids;
pub(super) mod picture;
mod row;
mod search;
mod trials;

pub use grids::OperatingPoint;
pub use row::Row;

use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::run::{Identity, StudyError, Trials};
use crate::study::kind::{Context, Study};
use grids::{Grids, NAME};
use schemars::{JsonSchema, SchemaGenerator};
use search::{DeltaRange, STEPS, Search};
use serde_json::Value;

impl Study for OperatingPoint {
    const NAME: &'static str = NAME;
    const USES: &'static [&'static str] = &[
        "sensor",
        "noise",
        "rest",
        "motion.delta_at",
        "motion.profile",
        "motion.offset",
        "impulses",
        "whitening",
        "samples.gap",
        "samples.decimation",
        "detector.alpha",
        "detector.rule",
        "detector.exceedances",
        "detector.alternative",
        "detector.ties",
    ];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let search: Search = experiment.read()?;
        (search.check()).map_err(|conflict| experiment.conflict(conflict))?;
        let study = Self::new(context, &experiment.scenario()?, search);
        Ok(study.map_err(|problem| experiment.refuse(problem))?)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Search::json_schema(generator).to_value()
    }

    /// The wanted powers are left out, because they change no count.
    fn identities(&self) -> Vec<Identity> {
        let DeltaRange { from, to } = self.search.delta;
        let sized = self.sized.iter();
        sized
            .map(|sized| sized.identity(from).with("to", to))
            .collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(self))
    }

    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let sizes = (0..self.sized.len()).map(|size| Grids::new(self, counts, size));
        sizes
            .flat_map(|mut grids| {
                let powers = self.search.power.iter();
                powers.map(|&power| grids.row(power)).collect::<Vec<_>>()
            })
            .collect()
    }

    /// Δ/σ_ξ of each row by name. If the power is not reached, this is the end of the search, a bound.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let quantity = |row: &Row| {
            let power = row.power.to_string().replace('.', "_");
            Quantity {
                name: format!("delta_for_{power}_at_{}", row.all_samples),
                value: row.delta.unwrap_or(self.search.delta.to),
                low: row.low.unwrap_or(f64::NEG_INFINITY),
                high: row.high.unwrap_or(f64::INFINITY),
            }
        };
        Ok(rows.iter().map(quantity).collect())
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, &self.scenario, seed))
    }

    fn points(&self) -> String {
        let (sizes, steps) = (self.sized.len(), self.sized[0].coarse.len());
        format!(
            "{steps} coarse for each of {sizes} sizes, and {STEPS} fine wherever something happens"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::tally::Tally;
    use crate::study::Sweep;
    use crate::study::tests::{read, rows};

    const SEARCH: &str = "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n\
        [operating_point]\nsizes = [9, 12]\npower = [0.5, 0.9]\ndelta = { from = 0.0, to = 3.2 }\n";

    /// The study of a config's search, and its rows.
    fn searched(text: &str) -> (OperatingPoint, Vec<Row>) {
        let study: OperatingPoint = read(text);
        let rows = rows(&study, study.context.trials);
        (study, rows)
    }

    /// Compares the search with brute force: a sweep over every Δ of the finest grid on the same draws. The
    /// three crossings are read off its rates and limits.
    #[test]
    fn finds_what_a_grid_of_every_point_shows() {
        let (_, rows) = searched(SEARCH);
        assert_eq!(rows.len(), 4);
        for row in rows {
            let size = row.all_samples;
            let text = format!(
                "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n[samples]\n\
                 reference = {size}\nshift = {size}\nscale = {size}\n\
                 [axis]\ndelta = {{ from = 0.0, to = 3.2, step = 0.003125 }}\n"
            );
            let sweep: Sweep = read(&text);
            let points = sweep.rows(&sweep.counts(&()).unwrap());
            let tallies = points.into_iter().map(|row| row.tally);
            let along: Vec<(f64, Tally)> = (sweep.plan.points.iter().zip(tallies))
                .filter(|(point, _)| point.scenario.moves())
                .map(|(point, tally)| (point.scenario.motion.delta, tally))
                .collect();
            assert_eq!(along.len(), 1025);
            let first = |level: &dyn Fn(Tally) -> f64| {
                let at = along
                    .iter()
                    .position(|(_, tally)| level(*tally) >= row.power);
                at.map(|index| [along[index - 1].0, along[index].0])
                    .unwrap()
            };
            let last_below = |level: &dyn Fn(Tally) -> f64| {
                let at = along
                    .iter()
                    .rposition(|(_, tally)| level(*tally) < row.power);
                along[at.unwrap() + 1].0
            };
            let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-9;
            assert!(close(row.delta, first(&|tally| tally.rate())[1]), "{row:?}");
            assert!(
                close(row.low, first(&|tally| tally.interval(0.95).1)[0]),
                "{row:?}"
            );
            assert!(
                close(row.high, last_below(&|tally| tally.interval(0.95).0)),
                "{row:?}"
            );
        }
    }

    /// A power beyond the range is not reached, and the row shows it.
    #[test]
    fn what_is_not_reached_is_left_out() {
        let text = SEARCH.replace("3.2", "0.05").replace("0.9]", "0.999]");
        let (study, rows) = searched(&text);
        assert!(rows.iter().all(|row| row.delta.is_none()));
        let bound = |q: &Quantity| (q.value, q.low, q.high) == (0.05, 0.05, f64::INFINITY);
        let quantities = study.quantities(&rows).unwrap();
        assert!(quantities.iter().all(bound), "{quantities:?}");
    }

    /// Compares searches that have the point inside, before, beyond or at either end with one that has it
    /// well inside. Each interval contains the point and is open where the search ends too early.
    #[test]
    fn a_search_that_ends_too_early_is_open() {
        let searched = |from: f64, to: f64| {
            let range = format!("from = {from:?}, to = {to:?}");
            let text = SEARCH
                .replace("[9, 12]", "[9]")
                .replace("[0.5, 0.9]", "[0.9]")
                .replace("from = 0.0, to = 3.2", &range);
            let (study, rows) = searched(&text);
            study.quantities(&rows).unwrap().remove(0)
        };
        let point = searched(0.0, 3.2).value;
        for (from, to) in [
            (0.0, 3.2),
            (0.0, 0.2),
            (0.0, point),
            (point, 3.2),
            (point + 1.0, 5.0),
        ] {
            let Quantity {
                low, value, high, ..
            } = searched(from, to);
            assert!(
                low <= point && point <= high && low < high,
                "{from} {to}: {low} {high}"
            );
            assert!((from..=to).contains(&value), "{from} {to}: {value}");
            assert_eq!(low == f64::NEG_INFINITY, from > 0.0, "{from} {to}: {low}");
            assert_eq!(high == f64::INFINITY, to < 3.2, "{from} {to}: {high}");
        }
    }
}
