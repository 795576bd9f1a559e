//! The operating point: the Δ/σ_ξ at which the power reaches a wanted value, for samples of several
//! sizes, by a search with an interval.
//!
//! At every Δ of a grid all trials are run on the same noise, then again on a grid thirty-two times
//! finer wherever something happens. The operating point is where the rate first reaches the wanted power.
//! Its interval inverts the exact intervals of the rates: from the last Δ before the upper limit first
//! reaches the power, to the first Δ after the lower limit was last below it. Where the power grows with
//! Δ, either end is missed only if the interval at one of the two neighbours of the true point misses,
//! so it covers that point with the stated confidence. Outside the search nothing is known: where the upper
//! limit reaches the power at its start the interval is open below, where the lower limit has not reached it
//! at its end it is open above.

use crate::chain::{Observation, Purpose, RecordTooLong, Scenario, View};
use crate::config::{ExhibitConfig, Problem, Search};
use crate::detect::{Method, NullLaws, Region, RegionError, Samples, Ties};
use crate::ensemble::{Ensemble, Sink};
use crate::results::{Quantity, eight_digits};
use crate::signal::Motion;
use crate::stats::tally::Tally;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// One row of `points.csv`: the operating point of one size and power.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// N = M₁ = M₂.
    pub all_samples: usize,
    /// α.
    pub alpha: f64,
    /// Of the region.
    pub size: f64,
    /// The wanted power.
    pub power: f64,
    /// Δ/σ_ξ, or the start of the search where the power is reached already; none where it never is.
    pub delta: Option<f64>,
    /// Of its interval; none where that is open below.
    pub low: Option<f64>,
    /// Of its interval; none where that is open above.
    pub high: Option<f64>,
    /// At every Δ.
    pub trials: u64,
    /// Of the interval.
    pub confidence: f64,
}

/// Steps of each grid.
const STEPS: usize = 32;

/// The operating points of the config's scenario at every size, in the order of sizes and powers.
///
/// # Errors
/// Where a size has no region, a motion that does not fit, or a record that does not fit in memory;
/// before the first trial.
pub fn rows(config: &ExhibitConfig, search: &Search) -> Result<Vec<Row>, Problem> {
    let [from, to] = search.delta;
    let sized = search.sizes.iter().map(|&size| Sized::new(config, size));
    let sized: Vec<Sized> = sized.collect::<Result<_, _>>()?;
    for point in &sized {
        point.ensemble(from, to)?;
    }
    let mut rows = Vec::new();
    for point in sized {
        let mut grids = Grids::new(&point, from, to)?;
        for &power in &search.power {
            rows.push(grids.row(power)?);
        }
    }
    Ok(rows)
}

/// Δ/σ_ξ of every row by name; the end of the search, a bound, where the power is not reached.
pub fn quantities(rows: &[Row], search: &Search) -> Vec<Quantity> {
    let quantity = |row: &Row| {
        let power = row.power.to_string().replace('.', "_");
        Quantity {
            name: format!("delta_for_{power}_at_{}", row.all_samples),
            value: row.delta.unwrap_or(search.delta[1]),
            low: row.low.unwrap_or(f64::NEG_INFINITY),
            high: row.high.unwrap_or(f64::INFINITY),
        }
    };
    rows.iter().map(quantity).collect()
}

/// A scenario at one size.
struct Sized {
    scenario: Scenario,
    region: Region,
    trials: u64,
    seed: u64,
    confidence: f64,
}

/// A rate and its interval at one Δ.
#[derive(Clone, Copy)]
struct Level {
    delta: f64,
    rate: f64,
    low: f64,
    high: f64,
}

impl Sized {
    fn new(config: &ExhibitConfig, size: usize) -> Result<Self, Problem> {
        let scenario = &config.scenario;
        let (gap, decimation) = (scenario.samples.gap(), scenario.samples.decimation());
        let samples = Samples::new(size, size, size, gap, decimation).map_err(Problem::Samples)?;
        let detector = &scenario.detector;
        let Method::Rule(rule) = &detector.method else {
            let name = detector.method.name();
            return Err(Problem::NoExactRegion(name));
        };
        let laws = NullLaws::new(detector.alternative, &samples).map_err(RegionError::from)?;
        let region = laws.region(rule, detector.alpha)?;
        // As long as Y₁ lasts, wherever it starts: the duration follows the size.
        let motion = Motion {
            duration: samples
                .acceleration()
                .saturating_sub(scenario.motion.offset),
            ..scenario.motion
        };
        let motion = motion.checked().map_err(Problem::Motion)?;
        Ok(Self {
            scenario: Scenario {
                samples,
                motion,
                ..scenario.clone()
            },
            region,
            trials: config.trials,
            seed: config.seed,
            confidence: config.confidence,
        })
    }

    /// The same scenario at `from`, `to` and the steps between them, all on the same noise.
    fn ensemble(&self, from: f64, to: f64) -> Result<Ensemble, RecordTooLong> {
        let at = |step| {
            let mut scenario = self.scenario.clone();
            scenario.motion.delta = delta(from, to, step);
            scenario
        };
        let scenarios: Vec<Scenario> = (0..=STEPS).map(at).collect();
        let ensemble = Ensemble::new(&scenarios, self.trials, self.seed, Purpose::Results, true);
        ensemble.map_err(|(_, refusal)| refusal)
    }

    /// The power there.
    fn curve(&self, from: f64, to: f64) -> Result<Vec<Level>, RecordTooLong> {
        let ties = self.scenario.detector.ties;
        let new = || Counts::new(&self.region, ties, STEPS + 1);
        let counts = self.ensemble(from, to)?.run(new, |_| {});
        let level = |(step, &hits): (usize, &u64)| {
            let trials = self.trials;
            let tally = Tally { hits, trials };
            let (low, high) = tally.interval(self.confidence);
            Level {
                delta: delta(from, to, step),
                rate: tally.rate(),
                low,
                high,
            }
        };
        Ok(counts.hits.iter().enumerate().map(level).collect())
    }
}

fn delta(from: f64, to: f64, step: usize) -> f64 {
    from + (to - from) * step as f64 / STEPS as f64
}

/// The coarse grid of one size, and the fine grids that have been asked for, by the coarse step they
/// divide.
struct Grids<'a> {
    point: &'a Sized,
    coarse: Vec<Level>,
    fine: BTreeMap<usize, Vec<Level>>,
}

impl<'a> Grids<'a> {
    fn new(point: &'a Sized, from: f64, to: f64) -> Result<Self, RecordTooLong> {
        Ok(Self {
            point,
            coarse: point.curve(from, to)?,
            fine: BTreeMap::new(),
        })
    }

    /// The fine grid from coarse step `above` − 1 to `above`.
    fn fine(&mut self, above: usize) -> Result<&[Level], RecordTooLong> {
        let ends = [self.coarse[above - 1].delta, self.coarse[above].delta];
        Ok(match self.fine.entry(above) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(self.point.curve(ends[0], ends[1])?),
        })
    }

    /// The neighbours on the fine grid between which `is_reached` first holds; twice the start of the
    /// grid where it holds there, none where it never does.
    fn first(
        &mut self,
        is_reached: impl Fn(&Level) -> bool,
    ) -> Result<Option<[f64; 2]>, RecordTooLong> {
        let Some(above) = self.coarse.iter().position(&is_reached) else {
            return Ok(None);
        };
        if above == 0 {
            return Ok(Some([self.coarse[0].delta; 2]));
        }
        let fine = self.fine(above)?;
        let above = fine.iter().position(is_reached).unwrap_or(STEPS).max(1);
        Ok(Some([fine[above - 1].delta, fine[above].delta]))
    }

    /// The same for the place after which `is_reached` holds to the end.
    fn last(
        &mut self,
        is_reached: impl Fn(&Level) -> bool,
    ) -> Result<Option<[f64; 2]>, RecordTooLong> {
        let fails = |at: &Level| !is_reached(at);
        let Some(below) = self.coarse.iter().rposition(fails) else {
            return Ok(Some([self.coarse[0].delta; 2]));
        };
        if below == STEPS {
            return Ok(None);
        }
        let fine = self.fine(below + 1)?;
        let below = fine.iter().rposition(fails).unwrap_or(0).min(STEPS - 1);
        Ok(Some([fine[below].delta, fine[below + 1].delta]))
    }

    fn row(&mut self, power: f64) -> Result<Row, RecordTooLong> {
        let delta = self.first(|level| level.rate >= power)?;
        let low = self.first(|level| level.high >= power)?;
        let high = self.last(|level| level.low >= power)?;
        let point = self.point;
        let low = match low {
            Some([start, above]) if start == above => None,
            Some([below, _]) => Some(below),
            None => Some(self.coarse[STEPS].delta),
        };
        Ok(Row {
            all_samples: point.scenario.samples.shift(),
            alpha: point.scenario.detector.alpha,
            size: point.region.size(),
            power,
            delta: delta.map(|[_, above]| eight_digits(above)),
            low: low.map(eight_digits),
            high: high.map(|[_, above]| eight_digits(above)),
            trials: point.trials,
            confidence: point.confidence,
        })
    }
}

/// Detections at each Δ.
struct Counts<'a> {
    region: &'a Region,
    ties: Ties,
    hits: Vec<u64>,
}

impl<'a> Counts<'a> {
    fn new(region: &'a Region, ties: Ties, places: usize) -> Self {
        Self {
            region,
            ties,
            hits: vec![0; places],
        }
    }
}

impl View for Counts<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        let is_h1 = self.region.contains(observation.statistics(self.ties));
        self.hits[place] += u64::from(is_h1);
    }
}

impl Sink for Counts<'_> {
    fn merge(&mut self, other: Self) {
        for (sum, more) in self.hits.iter_mut().zip(other.hits) {
            *sum += more;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, ExhibitKind, Experiment};
    use crate::pilot::Pilots;
    use crate::plan::Plan;
    use crate::run;

    const SEARCH: &str = "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n\
        [operating_point]\nsizes = [9, 12]\npower = [0.5, 0.9]\ndelta = { from = 0.0, to = 3.2 }\n";

    /// The rows of a config's search, and its quantities.
    fn searched(text: &str) -> (Vec<Row>, Vec<Quantity>) {
        let Ok(Experiment::Exhibit(config)) = Experiment::parse("test", text) else {
            panic!("no exhibit");
        };
        let ExhibitKind::OperatingPoint(search) = &config.kind else {
            panic!("no search");
        };
        let rows = rows(&config, search).unwrap();
        let quantities = quantities(&rows, search);
        (rows, quantities)
    }

    /// Against brute force: a sweep over every Δ of the finest grid on the same draws, and the three
    /// crossings read off its rates and limits.
    #[test]
    fn finds_what_a_grid_of_every_point_shows() {
        let (rows, _) = searched(SEARCH);
        assert_eq!(rows.len(), 4);
        for row in rows {
            let size = row.all_samples;
            let text = format!(
                "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n[samples]\n\
                 reference = {size}\nshift = {size}\nscale = {size}\n\
                 [axis]\ndelta = {{ from = 0.0, to = 3.2, step = 0.003125 }}\n"
            );
            let plan = Plan::new(&Config::parse("test", &text).unwrap()).unwrap();
            let decisions = Pilots::new(&plan).unwrap().decide(|_| {}).unwrap();
            let tallies = run::run(&plan, &decisions, &[], |_| {}).tallies;
            let along: Vec<(f64, Tally)> = (plan.points.iter().zip(tallies))
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

    /// A power beyond the range is not reached, and says so.
    #[test]
    fn what_is_not_reached_is_left_out() {
        let text = SEARCH.replace("3.2", "0.05").replace("0.9]", "0.999]");
        let (rows, quantities) = searched(&text);
        assert!(rows.iter().all(|row| row.delta.is_none()));
        let bound = |q: &Quantity| (q.value, q.low, q.high) == (0.05, 0.05, f64::INFINITY);
        assert!(quantities.iter().all(bound), "{quantities:?}");
    }

    /// Searches that have the point within, before or beyond them or at either end, against one that has it
    /// well within: each interval has the point in it and is open where the search ends too early.
    #[test]
    fn a_search_that_ends_too_early_is_open() {
        let searched = |from: f64, to: f64| {
            let range = format!("from = {from:?}, to = {to:?}");
            let text = SEARCH
                .replace("[9, 12]", "[9]")
                .replace("[0.5, 0.9]", "[0.9]")
                .replace("from = 0.0, to = 3.2", &range);
            searched(&text).1.remove(0)
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
