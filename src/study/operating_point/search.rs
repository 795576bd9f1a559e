//! The keys of a search, and the scenario of each size with its grids of Δ.

use crate::chain::{Purpose, RecordTooLong, Scenario};
use crate::config::Conflict;
use crate::detect::{Method, NullLaws, Region, RegionError, Samples};
use crate::results;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::scenario::ScenarioError;
use crate::schedule::Schedule;
use crate::signal::Motion;
use crate::study::kind::Context;
use crate::study::rules::{distinct, each};
use schemars::JsonSchema;
use serde::Deserialize;

/// The Δ/σ_ξ at which the power reaches a value, for samples of several sizes.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Search {
    /// N = M₁ = M₂.
    pub sizes: Vec<usize>,
    /// The powers looked for.
    pub power: Vec<f64>,
    /// Where they are looked for, Δ/σ_ξ.
    pub delta: DeltaRange,
}

/// `operating_point.delta`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeltaRange {
    /// The smallest.
    pub from: f64,
    /// The largest.
    pub to: f64,
}

/// The most sizes. Each size has a thousand values of Δ.
const MOST_SIZES: usize = 100;
const MOST_POWERS: usize = 100;

impl Search {
    /// Checks that the values fit each other.
    pub fn check(&self) -> Result<(), Conflict> {
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
            let unfit = OutOfRange::new("operating_point.delta", "rise from `from` to `to`", got);
            return Err(unfit.into());
        }
        Ok(())
    }
}

/// The number of steps in each grid.
pub const STEPS: usize = 32;

/// The grid of `from`, `to` and the steps between them.
pub fn grid(from: f64, to: f64) -> Vec<f64> {
    let delta = |step| from + (to - from) * step as f64 / STEPS as f64;
    (0..=STEPS).map(delta).collect()
}

/// A scenario at one size.
pub struct Sized {
    pub size: usize,
    pub scenario: Scenario,
    pub region: Region,
    /// Δ at every step of the coarse grid.
    pub coarse: Vec<f64>,
    /// The scenario without Δ.
    identity: Identity,
}

impl Sized {
    pub fn new(scenario: &Scenario, size: usize, coarse: Vec<f64>) -> Result<Self, StudyError> {
        let (gap, decimation) = (scenario.samples.gap(), scenario.samples.decimation());
        let samples = Samples::new(size, size, size, gap, decimation)?;
        let detector = &scenario.detector;
        let Method::Rule(rule) = &detector.method else {
            let name = detector.method.name();
            let rule = "have an exact region (name wilcoxon, product, disjunction or conjunction)";
            return Err(OutOfRange::new("detector.rule", rule, name).into());
        };
        let laws = NullLaws::new(detector.exceedances, detector.alternative, &samples)
            .map_err(RegionError::from)?;
        let region = laws.region(rule, detector.alpha)?;
        // The acceleration lasts to the end of Y₁, so its duration follows the size.
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
            identity: Identity::new(parameters.filter(|(name, _)| name != "delta")),
            size,
            scenario,
            region,
            coarse,
        })
    }

    /// Δ at every step of the fine grid that ends at coarse step `above`.
    pub fn fine(&self, above: usize) -> Vec<f64> {
        grid(self.coarse[above - 1], self.coarse[above])
    }

    /// Δ at each step of all grids.
    pub fn deltas(&self) -> impl Iterator<Item = f64> {
        let fine = (1..=STEPS).flat_map(|above| self.fine(above));
        self.coarse.iter().copied().chain(fine)
    }

    fn at(&self, delta: f64) -> Scenario {
        let mut scenario = self.scenario.clone();
        scenario.motion.delta = delta;
        scenario
    }

    pub fn identity(&self, delta: f64) -> Identity {
        self.identity.clone().with("delta", delta)
    }

    /// The same scenario at several Δ, all on the same noise.
    pub fn schedule(&self, deltas: &[f64], context: Context) -> Result<Schedule, RecordTooLong> {
        let scenarios: Vec<Scenario> = deltas.iter().map(|&delta| self.at(delta)).collect();
        let Context { seed, trials, .. } = context;
        Schedule::new(&scenarios, trials, seed, Purpose::Results, true)
            .map_err(|(_, refusal)| refusal)
    }
}
