//! The search: each Δ that may be counted, and the crossings that the counts show.

use super::row::Row;
use super::search::{DeltaRange, STEPS, Search, Sized, grid};
use crate::chain::Scenario;
use crate::counts::{Counts, Key, Shape};
use crate::results::eight_digits;
use crate::run::{StudyError, Target};
use crate::stats::tally::Tally;
use crate::study::kind::{Context, counted};
use std::collections::{BTreeMap, BTreeSet};

/// The name of the study's table.
pub const NAME: &str = "operating_point";

/// The operating points of a scenario at every size.
pub struct OperatingPoint {
    pub context: Context,
    pub scenario: Scenario,
    pub search: Search,
    pub sized: Vec<Sized>,
    pub targets: Vec<Target>,
    /// For each size, the place of each Δ, coarse or fine, among the targets. The bits of Δ are the key.
    pub places: Vec<BTreeMap<u64, usize>>,
}

impl OperatingPoint {
    /// Plans a search.
    ///
    /// # Errors
    /// If a size has no region, a motion that does not fit, or a record that does not fit in memory.
    pub fn new(context: Context, scenario: &Scenario, search: Search) -> Result<Self, StudyError> {
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
                let key = sized.identity(delta).key(NAME, context.seed, true);
                let next = study.targets.len();
                let place = *known.entry(key).or_insert(next);
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
    pub fn target(&self, size: usize, delta: f64) -> usize {
        self.places[size][&delta.to_bits()]
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

/// The grids of one size, and the fine grids that have been asked for, by the coarse step at their end.
pub struct Grids<'a> {
    study: &'a OperatingPoint,
    counts: &'a Counts,
    size: usize,
    coarse: Vec<Level>,
    pub asked: BTreeSet<usize>,
}

impl<'a> Grids<'a> {
    pub fn new(study: &'a OperatingPoint, counts: &'a Counts, size: usize) -> Self {
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

    /// The neighbours on the fine grid between which `is_reached` first holds. If it holds at the start of
    /// the grid, both are the start. If it never holds, there are no neighbours.
    fn first(&mut self, is_reached: impl Fn(&Level) -> bool) -> Option<[f64; 2]> {
        let above = self.coarse.iter().position(&is_reached)?;
        if above == 0 {
            return Some([self.coarse[0].delta; 2]);
        }
        let fine = self.fine(above);
        let above = fine.iter().position(is_reached).unwrap_or(STEPS).max(1);
        Some([fine[above - 1].delta, fine[above].delta])
    }

    /// The neighbours on the fine grid after which `is_reached` holds to the end.
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

    pub fn row(&mut self, power: f64) -> Row {
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
