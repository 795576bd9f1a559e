//! The operating point: the Δ/σ_ξ at which the power reaches a wanted value, for samples of several
//! sizes, by a search with an interval.
//!
//! At every Δ of a grid all trials are run on the same noise, then again on a grid thirty-two times
//! finer around the crossing. The interval inverts the exact intervals of the rates: it ends where the
//! upper limit first reaches the wanted power and where the lower limit does, rounded outwards to the
//! grid. Where the power grows with Δ it covers the true point with at least the stated confidence; where
//! it does not, everything here speaks of the first crossing.

use crate::chain::{Observation, Purpose, RecordTooLong, Scenario};
use crate::config::{ExhibitConfig, Problem, Search};
use crate::detect::{Method, NullLaws, Region, RegionError, Samples, Ties};
use crate::ensemble::{Ensemble, Sink};
use crate::results::{Quantity, eight_digits};
use crate::signal::Motion;
use crate::tally::Tally;
use serde::{Deserialize, Serialize};

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
    /// Δ/σ_ξ; none where it is never reached.
    pub delta: Option<f64>,
    /// Its interval.
    pub low: Option<f64>,
    /// Its interval; none where the lower limit never gets there.
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
/// Where a size has no region, or a record that does not fit in memory.
pub fn rows(config: &ExhibitConfig, search: &Search) -> Result<Vec<Row>, Problem> {
    let mut rows = Vec::new();
    for &size in &search.sizes {
        let point = Sized::new(config, size)?;
        let [from, to] = search.delta;
        let coarse = point.curve(from, to)?;
        for &power in &search.power {
            rows.push(point.row(&coarse, power)?);
        }
    }
    Ok(rows)
}

/// Δ/σ_ξ of every row that reaches its power, by name.
pub fn quantities(rows: &[Row]) -> Vec<Quantity> {
    let reached = rows.iter().filter_map(|row| {
        let power = row.power.to_string().replace('.', "_");
        Some(Quantity {
            name: format!("delta_for_{power}_at_{}", row.all_samples),
            value: row.delta?,
            low: row.low?,
            high: row.high?,
        })
    });
    reached.collect()
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
        let duration = samples.acceleration();
        let motion = Motion {
            duration,
            ..scenario.motion
        };
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

    /// The power at `from`, `to` and the steps between them, all on the same noise.
    fn curve(&self, from: f64, to: f64) -> Result<Vec<Level>, RecordTooLong> {
        let delta = |step: usize| from + (to - from) * step as f64 / STEPS as f64;
        let scenarios: Vec<Scenario> = (0..=STEPS)
            .map(|step| {
                let mut scenario = self.scenario.clone();
                scenario.motion.delta = delta(step);
                scenario
            })
            .collect();
        let ensemble = Ensemble::new(&scenarios, self.trials, self.seed, Purpose::Results, true);
        let ensemble = ensemble.map_err(|(_, refusal)| refusal)?;
        let ties = self.scenario.detector.ties;
        let counts = ensemble.run(|| Counts::new(&self.region, ties, STEPS + 1), |_| {});
        let level = |(step, &hits): (usize, &u64)| {
            let trials = self.trials;
            let tally = Tally { hits, trials };
            let (low, high) = tally.interval(self.confidence);
            Level {
                delta: delta(step),
                rate: tally.rate(),
                low,
                high,
            }
        };
        Ok(counts.hits.iter().enumerate().map(level).collect())
    }

    fn row(&self, coarse: &[Level], power: f64) -> Result<Row, RecordTooLong> {
        let crossing = |level: &dyn Fn(&Level) -> f64| -> Result<Option<[f64; 2]>, RecordTooLong> {
            let Some(bracket) = bracket(coarse, power, level) else {
                return Ok(None);
            };
            let fine = self.curve(bracket[0], bracket[1])?;
            Ok(self::bracket(&fine, power, level))
        };
        let delta = crossing(&|level| level.rate)?;
        let low = crossing(&|level| level.high)?;
        let high = crossing(&|level| level.low)?;
        Ok(Row {
            all_samples: self.scenario.samples.shift(),
            alpha: self.scenario.detector.alpha,
            size: self.region.size(),
            power,
            delta: delta.map(|[_, above]| eight_digits(above)),
            low: low.map(|[below, _]| eight_digits(below)),
            high: high.map(|[_, above]| eight_digits(above)),
            trials: self.trials,
            confidence: self.confidence,
        })
    }
}

/// The neighbours between which `level` first reaches `power`; at the start of the grid, that alone.
fn bracket(levels: &[Level], power: f64, level: &dyn Fn(&Level) -> f64) -> Option<[f64; 2]> {
    let above = levels.iter().position(|at| level(at) >= power)?;
    Some([levels[above.saturating_sub(1)].delta, levels[above].delta])
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

impl Sink for Counts<'_> {
    fn take(&mut self, place: usize, observation: &mut Observation) {
        let is_h1 = self.region.contains(observation.statistics(self.ties));
        self.hits[place] += u64::from(is_h1);
    }

    fn merge(&mut self, other: Self) {
        for (sum, more) in self.hits.iter_mut().zip(other.hits) {
            *sum += more;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Experiment};
    use crate::pilot::Pilots;
    use crate::plan::Plan;
    use crate::run;

    const SEARCH: &str = "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n\
        [operating_point]\nsizes = [9, 12]\npower = [0.5, 0.9]\ndelta = { from = 0.0, to = 3.2 }\n";

    /// Against brute force: a sweep over every Δ of the finest grid on the same draws, and the three
    /// crossings read off its rates and limits.
    #[test]
    fn finds_what_a_grid_of_every_point_shows() {
        let Ok(Experiment::Exhibit(config)) = Experiment::parse("test", SEARCH) else {
            panic!("no exhibit");
        };
        let crate::config::ExhibitKind::OperatingPoint(search) = &config.kind else {
            panic!("no search");
        };
        let rows = rows(&config, search).unwrap();
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
            let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-9;
            assert!(close(row.delta, first(&|tally| tally.rate())[1]), "{row:?}");
            assert!(
                close(row.low, first(&|tally| tally.interval(0.95).1)[0]),
                "{row:?}"
            );
            assert!(
                close(row.high, first(&|tally| tally.interval(0.95).0)[1]),
                "{row:?}"
            );
        }
    }

    /// A power beyond the range is not reached, and says so.
    #[test]
    fn what_is_not_reached_is_left_out() {
        let text = SEARCH.replace("3.2", "0.05").replace("0.9]", "0.999]");
        let Ok(Experiment::Exhibit(config)) = Experiment::parse("test", &text) else {
            panic!("no exhibit");
        };
        let crate::config::ExhibitKind::OperatingPoint(search) = &config.kind else {
            panic!("no search");
        };
        let rows = rows(&config, search).unwrap();
        assert!(rows.iter().all(|row| row.delta.is_none()));
        assert!(quantities(&rows).is_empty());
    }
}
