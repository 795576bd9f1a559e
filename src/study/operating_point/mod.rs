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

pub(super) mod picture;
mod row;
mod trials;

pub use row::Row;

use crate::chain::{RecordTooLong, Scenario};
use crate::config::{Conflict, Unfit};
use crate::counts::{Counts, Key, Shape};
use crate::detect::{Method, NullLaws, Region, RegionError, Samples};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{self, Quantity, eight_digits};
use crate::run::{Identity, StudyError, Target, Trials};
use crate::scenario::ScenarioError;
use crate::schedule::Schedule;
use crate::signal::Motion;
use crate::stats::tally::Tally;
use crate::study::kind::{Context, Study, counted};
use crate::study::rules::{distinct, each};
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// The powers looked for, and where: `[operating_point]`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Search {
    /// N = M₁ = M₂.
    sizes: Vec<usize>,
    /// The powers looked for.
    power: Vec<f64>,
    /// Where they are looked for, Δ/σ_ξ.
    delta: DeltaRange,
}

/// `operating_point.delta`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DeltaRange {
    from: f64,
    to: f64,
}

/// Each size has a thousand levels.
const MOST_SIZES: usize = 100;
const MOST_POWERS: usize = 100;

impl Search {
    fn check(&self) -> Result<(), Conflict> {
        const SIZES: &str = "operating_point.sizes";
        const POWER: &str = "operating_point.power";
        let Self {
            sizes,
            power,
            delta,
        } = self;
        distinct(
            SIZES,
            ["size", "sizes"],
            MOST_SIZES,
            sizes,
            usize::to_string,
        )?;
        distinct(
            POWER,
            ["power", "powers"],
            MOST_POWERS,
            power,
            f64::to_string,
        )?;
        each(SIZES, sizes, "be at least 1", |size| *size > 0)?;
        each(POWER, power, "lie strictly between 0 and 1", |power| {
            (f64::EPSILON..1.0).contains(power)
        })?;
        if delta.from >= delta.to {
            let got = format!("{} to {}", delta.from, delta.to);
            let unfit = Unfit::new("operating_point.delta", "rise from `from` to `to`", got);
            return Err(unfit.into());
        }
        Ok(())
    }
}

/// The operating points of a scenario at every size.
pub(super) struct OperatingPoint {
    context: Context,
    scenario: Scenario,
    search: Search,
    sized: Vec<Sized>,
    targets: Vec<Target>,
    /// The place among the targets of each size's Δ, coarse or fine, by its bits.
    places: Vec<BTreeMap<u64, usize>>,
}

/// A scenario at one size.
struct Sized {
    size: usize,
    scenario: Scenario,
    region: Region,
    /// Δ at every step of the coarse grid.
    coarse: Vec<f64>,
    /// Without Δ.
    identity: Identity,
}

impl OperatingPoint {
    /// # Errors
    /// Where a size has no region, a motion that does not fit, or a record that does not fit in memory.
    fn new(context: Context, scenario: &Scenario, search: Search) -> Result<Self, StudyError> {
        let DeltaRange { from, to } = search.delta;
        let coarse = grid(from, to);
        let sized = search.sizes.iter();
        let sized = sized.map(|&size| Sized::new(scenario, size, coarse.clone()));
        let mut study = Self {
            sized: sized.collect::<Result<_, _>>()?,
            scenario: scenario.clone(),
            context,
            search,
            targets: Vec::new(),
            places: Vec::new(),
        };
        let mut known: BTreeMap<Key, usize> = BTreeMap::new();
        for sized in &study.sized {
            sized.schedule(&sized.coarse, context)?;
            let mut places = BTreeMap::new();
            for delta in sized.deltas() {
                let key = sized.identity(delta).key(Self::NAME, context.seed, true);
                let next = study.targets.len();
                let place = *known.entry(key.clone()).or_insert(next);
                if place == next {
                    let shape = Shape::events(1);
                    study.targets.push(Target { key, shape });
                }
                places.insert(delta.to_bits(), place);
            }
            study.places.push(places);
        }
        Ok(study)
    }

    /// The counter of a size, by its place, at a Δ of its grids.
    fn target(&self, size: usize, delta: f64) -> usize {
        self.places[size][&delta.to_bits()]
    }
}

impl Study for OperatingPoint {
    const NAME: &'static str = "operating_point";
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

    /// The wanted powers change no count.
    fn identities(&self) -> Vec<Identity> {
        let DeltaRange { from, to } = self.search.delta;
        let sized = self.sized.iter();
        sized
            .map(|sized| {
                let mut identity = sized.identity(from);
                let to = ("to".to_owned(), to.to_string());
                identity.parameters.push(to);
                identity
            })
            .collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(trials::Levels(self)))
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

    /// Δ/σ_ξ of every row by name; the end of the search, a bound, where the power is not reached.
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

/// Steps of each grid.
const STEPS: usize = 32;

/// `from`, `to` and the steps between them.
fn grid(from: f64, to: f64) -> Vec<f64> {
    let delta = |step| from + (to - from) * step as f64 / STEPS as f64;
    (0..=STEPS).map(delta).collect()
}

impl Sized {
    fn new(scenario: &Scenario, size: usize, coarse: Vec<f64>) -> Result<Self, StudyError> {
        let (gap, decimation) = (scenario.samples.gap(), scenario.samples.decimation());
        let samples = Samples::new(size, size, size, gap, decimation)?;
        let detector = &scenario.detector;
        let Method::Rule(rule) = &detector.method else {
            let name = detector.method.name();
            let rule = "have an exact region (name wilcoxon, product, disjunction or conjunction)";
            return Err(Unfit::new("detector.rule", rule, name).into());
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
        let scenario = Scenario {
            samples,
            motion: motion.checked().map_err(ScenarioError::from)?,
            ..scenario.clone()
        };
        let parameters = results::parameters(&scenario).into_iter();
        Ok(Self {
            identity: Identity {
                parameters: parameters.filter(|(name, _)| name != "delta").collect(),
                place: String::new(),
            },
            size,
            scenario,
            region,
            coarse,
        })
    }

    /// Δ at every step of the fine grid that ends at coarse step `above`.
    fn fine(&self, above: usize) -> Vec<f64> {
        grid(self.coarse[above - 1], self.coarse[above])
    }

    /// Δ at every step of every grid.
    fn deltas(&self) -> impl Iterator<Item = f64> {
        let fine = (1..=STEPS).flat_map(|above| self.fine(above));
        self.coarse.iter().copied().chain(fine)
    }

    fn at(&self, delta: f64) -> Scenario {
        let mut scenario = self.scenario.clone();
        scenario.motion.delta = delta;
        scenario
    }

    fn identity(&self, delta: f64) -> Identity {
        let mut identity = self.identity.clone();
        let delta = ("delta".to_owned(), delta.to_string());
        identity.parameters.push(delta);
        identity
    }

    /// The same scenario at several Δ, all on the same noise.
    fn schedule(&self, deltas: &[f64], context: Context) -> Result<Schedule, RecordTooLong> {
        let scenarios: Vec<Scenario> = deltas.iter().map(|&delta| self.at(delta)).collect();
        trials::schedule(&scenarios, context).map_err(|(_, refusal)| refusal)
    }
}

/// A rate and its interval at one Δ.
#[derive(Clone, Copy)]
struct Level {
    delta: f64,
    rate: f64,
    low: f64,
    high: f64,
}

/// The grids of one size, and which of the fine ones have been asked for, by the coarse step that they end at.
struct Grids<'a> {
    study: &'a OperatingPoint,
    counts: &'a Counts,
    size: usize,
    coarse: Vec<Level>,
    asked: BTreeSet<usize>,
}

impl<'a> Grids<'a> {
    fn new(study: &'a OperatingPoint, counts: &'a Counts, size: usize) -> Self {
        let mut grids = Self {
            study,
            counts,
            size,
            coarse: Vec::new(),
            asked: BTreeSet::new(),
        };
        grids.coarse = grids.levels(study.sized[size].coarse.clone());
        grids
    }

    fn levels(&self, deltas: Vec<f64>) -> Vec<Level> {
        let level = |delta: f64| {
            let target = &self.study.targets[self.study.target(self.size, delta)];
            let (trials, sums) = counted(self.counts, &target.key, &target.shape);
            let tally = Tally {
                hits: sums.counts[0],
                trials,
            };
            let (low, high) = tally.interval(self.study.context.confidence);
            Level {
                delta,
                rate: tally.rate(),
                low,
                high,
            }
        };
        deltas.into_iter().map(level).collect()
    }

    /// The fine grid from coarse step `above` − 1 to `above`.
    fn fine(&mut self, above: usize) -> Vec<Level> {
        self.asked.insert(above);
        self.levels(self.study.sized[self.size].fine(above))
    }

    /// The neighbours on the fine grid between which `is_reached` first holds; twice the start of the
    /// grid where it holds there, none where it never does.
    fn first(&mut self, is_reached: impl Fn(&Level) -> bool) -> Option<[f64; 2]> {
        let above = self.coarse.iter().position(&is_reached)?;
        if above == 0 {
            return Some([self.coarse[0].delta; 2]);
        }
        let fine = self.fine(above);
        let above = fine.iter().position(is_reached).unwrap_or(STEPS).max(1);
        Some([fine[above - 1].delta, fine[above].delta])
    }

    /// The same for the place after which `is_reached` holds to the end.
    fn last(&mut self, is_reached: impl Fn(&Level) -> bool) -> Option<[f64; 2]> {
        let fails = |at: &Level| !is_reached(at);
        let Some(below) = self.coarse.iter().rposition(fails) else {
            return Some([self.coarse[0].delta; 2]);
        };
        if below == STEPS {
            return None;
        }
        let fine = self.fine(below + 1);
        let below = fine.iter().rposition(fails).unwrap_or(0).min(STEPS - 1);
        Some([fine[below].delta, fine[below + 1].delta])
    }

    fn row(&mut self, power: f64) -> Row {
        let delta = self.first(|level| level.rate >= power);
        let low = self.first(|level| level.high >= power);
        let high = self.last(|level| level.low >= power);
        let OperatingPoint {
            context,
            sized,
            search,
            ..
        } = self.study;
        let low = match low {
            Some([start, above]) if start == above => None,
            Some([below, _]) => Some(below),
            None => Some(search.delta.to),
        };
        let Sized {
            size,
            scenario,
            region,
            ..
        } = &sized[self.size];
        Row {
            all_samples: *size,
            alpha: scenario.detector.alpha,
            size: region.size(),
            power,
            delta: delta.map(|[_, above]| eight_digits(above)),
            low: low.map(eight_digits),
            high: high.map(|[_, above]| eight_digits(above)),
            trials: context.trials,
            confidence: context.confidence,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::SweepConfig;
    use crate::pilot::Pilots;
    use crate::plan::Plan;
    use crate::run;
    use crate::study::tests::{read, rows};

    const SEARCH: &str = "question = \"?\"\nseed = 5\ntrials = 4000\n[impulses]\nnu = 0.2\n\
        [operating_point]\nsizes = [9, 12]\npower = [0.5, 0.9]\ndelta = { from = 0.0, to = 3.2 }\n";

    /// The study of a config's search, and its rows.
    fn searched(text: &str) -> (OperatingPoint, Vec<Row>) {
        let study: OperatingPoint = read(text);
        let rows = rows(&study, study.context.trials);
        (study, rows)
    }

    /// Against brute force: a sweep over every Δ of the finest grid on the same draws, and the three
    /// crossings read off its rates and limits.
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
            let plan = Plan::new(&SweepConfig::parse("test", &text).unwrap()).unwrap();
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
        let (study, rows) = searched(&text);
        assert!(rows.iter().all(|row| row.delta.is_none()));
        let bound = |q: &Quantity| (q.value, q.low, q.high) == (0.05, 0.05, f64::INFINITY);
        let quantities = study.quantities(&rows).unwrap();
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
