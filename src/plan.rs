//! What a config comes to: every point with its scenario and region, and the families that share
//! noise. Whatever can go wrong goes wrong here, before the first trial.

use crate::chain::{Detector, Purpose, Scenario};
use crate::claim::{self, Pair};
use crate::config::AxisValue;
use crate::detect::{Alternative, Method, NullLaws, Region, RegionError, Rule, Samples};
use crate::experiment::{ConfigError, SweepConfig};
use crate::scenario::{RECORD_KEYS, ScenarioError};
use crate::schedule::Schedule;
use std::sync::Arc;

/// Every point of an experiment, ready to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// In the order of the results.
    pub points: Vec<Point>,
    /// Where every draw starts from.
    pub seed: u64,
    /// Whether points share their noise.
    pub common_random_numbers: bool,
    /// Trials of each pilot run.
    pub pilot: u64,
    /// The points again, arranged by the noise they share.
    pub schedule: Schedule,
}

/// One point of one curve under one hypothesis.
#[derive(Clone, Debug)]
pub struct Point {
    /// From 0.
    pub curve: usize,
    /// The curve's label.
    pub label: String,
    /// Whether anything moves.
    pub hypothesis: Hypothesis,
    /// Every parameter.
    pub scenario: Scenario,
    /// How it decides.
    pub design: Design,
}

/// How a point comes by its decision.
#[derive(Clone, Debug)]
pub enum Design {
    /// A region that the exact laws give.
    Region(Arc<Region>),
    /// What a pilot run finds.
    Pilot,
}

impl Design {
    /// The exact size, where it is known before any pilot.
    pub fn size(&self) -> Option<f64> {
        match self {
            Self::Region(region) => Some(region.size()),
            Self::Pilot => None,
        }
    }
}

/// What a point simulates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hypothesis {
    /// Rest.
    H0,
    /// Motion.
    H1,
}

impl Plan {
    /// Every point of every curve, and for each distinct (sensor, noise, whitening, samples,
    /// detector) the same at rest. A curve in which nothing ever moves is a false-alarm curve: it
    /// has points at rest alone, and so has a config that asks for nothing else.
    ///
    /// # Errors
    /// Where a parameter of a point is out of range, or no region or record can be made for it.
    pub fn new(config: &SweepConfig) -> Result<Self, ConfigError> {
        if config.header().at_rest {
            Self::at_rest(config)
        } else {
            Self::of(config, |_| true)
        }
    }

    /// The points at rest alone: what the false-alarm gate runs.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn at_rest(config: &SweepConfig) -> Result<Self, ConfigError> {
        Self::of(config, |hypothesis| hypothesis == Hypothesis::H0)
    }

    /// The same with some of its points alone.
    pub fn subset(&self, points: &[usize]) -> Self {
        let points: Vec<Point> = points.iter().map(|&at| self.points[at].clone()).collect();
        let schedule = Schedule::new(
            points.iter().map(|point| &point.scenario),
            self.schedule.trials,
            self.seed,
            Purpose::Results,
            self.common_random_numbers,
        );
        Self {
            points,
            schedule: schedule.expect("the records fitted in memory with more points"),
            ..*self
        }
    }

    /// Of every point the family it belongs to: points of one family share their noise.
    pub fn families(&self) -> Vec<usize> {
        let mut family_of = vec![0; self.points.len()];
        for (index, family) in self.schedule.families.iter().enumerate() {
            family.places().for_each(|place| family_of[place] = index);
        }
        family_of
    }

    /// The pairs of points that the claims of its config compare.
    pub fn pairs(&self, config: &SweepConfig) -> Vec<Pair> {
        let claims = &config.narrative.claims;
        if claims.is_empty() {
            return Vec::new();
        }
        claim::pairs(claims, &config.scope, &self.along_axis(config))
    }

    /// Of each curve the point at each value of the axis: the one in motion, or the one at rest where nothing
    /// in the curve moves. What is the same at rest is planned once, under the first curve.
    fn along_axis(&self, config: &SweepConfig) -> Vec<Vec<Option<usize>>> {
        let along = |curve| {
            let is_moving = |&at: &usize| {
                let Point {
                    curve: own,
                    hypothesis,
                    ..
                } = self.points[at];
                own == curve && hypothesis == Hypothesis::H1
            };
            let moving: Vec<_> = (0..self.points.len()).filter(is_moving).map(Some).collect();
            if !moving.is_empty() {
                return moving;
            }
            let at_rest = |value| {
                let scenario = config.scenario(curve, value).ok()?.at_rest();
                (self.points.iter()).position(|point| {
                    point.hypothesis == Hypothesis::H0 && point.scenario == scenario
                })
            };
            config.axis().values.iter().map(at_rest).collect()
        };
        (0..config.scope.curves.len()).map(along).collect()
    }

    fn of(config: &SweepConfig, wanted: impl Fn(Hypothesis) -> bool) -> Result<Self, ConfigError> {
        let mut designer = Designer::default();
        let mut points: Vec<Point> = Vec::new();
        let mut blame = Vec::new();
        for (curve, Curve { scenarios, moves }) in curves(config)?.into_iter().enumerate() {
            for (value, scenario) in config.axis().values.iter().zip(scenarios) {
                let design = designer
                    .design(&scenario)
                    .map_err(|error| config.blame(curve, value, error.keys(), error))?;
                let mut add = |hypothesis, scenario| {
                    if wanted(hypothesis) {
                        points.push(Point {
                            curve,
                            label: config.scope.curves[curve].label.clone(),
                            hypothesis,
                            scenario,
                            design: design.clone(),
                        });
                        blame.push((curve, value));
                    }
                };
                if designer.is_new_at_rest(&scenario) {
                    add(Hypothesis::H0, scenario.at_rest());
                }
                if moves {
                    add(Hypothesis::H1, scenario);
                }
            }
        }
        let schedule = Schedule::new(
            points.iter().map(|point| &point.scenario),
            config.header().trials(),
            config.header().seed,
            Purpose::Results,
            config.header().common_random_numbers,
        )
        .map_err(|(point, refusal)| {
            let (curve, value) = blame[point];
            config.blame(curve, value, RECORD_KEYS, format!("samples: {refusal}"))
        })?;
        Ok(Self {
            points,
            seed: config.header().seed,
            common_random_numbers: config.header().common_random_numbers,
            pilot: config.header().pilot,
            schedule,
        })
    }
}

/// The scenarios of one curve along the axis.
struct Curve {
    scenarios: Vec<Scenario>,
    moves: bool,
}

fn curves(config: &SweepConfig) -> Result<Vec<Curve>, ConfigError> {
    let scenario = |curve: usize, value: &AxisValue| config.scenario(curve, value);
    (0..config.scope.curves.len())
        .map(|curve| {
            let values = config.axis().values.iter();
            let scenarios: Vec<Scenario> = values
                .map(|value| scenario(curve, value))
                .collect::<Result<_, _>>()?;
            let moves = scenarios.iter().any(Scenario::moves);
            Ok(Curve { scenarios, moves })
        })
        .collect()
}

/// Makes each region once, and remembers what has been seen at rest. Of the laws, which are large, it
/// keeps only those of the last sizes.
#[derive(Default)]
struct Designer {
    laws: Option<(Samples, Alternative, NullLaws)>,
    regions: Vec<(Samples, Detector, Arc<Region>)>,
    at_rest: Vec<Scenario>,
}

impl Designer {
    /// The exact region, or the promise of a pilot. A rule that is to be calibrated is made all the
    /// same: what it cannot reach exactly, it cannot reach at all.
    fn design(&mut self, scenario: &Scenario) -> Result<Design, ScenarioError> {
        let detector = &scenario.detector;
        let region = match &detector.method {
            Method::Rule(rule) => self.region(scenario, rule)?,
            _ => {
                self.laws(scenario)?;
                return Ok(Design::Pilot);
            }
        };
        Ok(if detector.needs_pilot() {
            Design::Pilot
        } else {
            Design::Region(region)
        })
    }

    fn region(&mut self, scenario: &Scenario, rule: &Rule) -> Result<Arc<Region>, ScenarioError> {
        let (samples, detector) = (scenario.samples, &scenario.detector);
        let mut known = self.regions.iter();
        if let Some((.., region)) = known.find(|(s, d, _)| *s == samples && d == detector) {
            return Ok(region.clone());
        }
        let region = Arc::new(self.laws(scenario)?.region(rule, detector.alpha)?);
        self.regions
            .push((samples, detector.clone(), region.clone()));
        Ok(region)
    }

    fn laws(&mut self, scenario: &Scenario) -> Result<&NullLaws, ScenarioError> {
        let (samples, alternative) = (scenario.samples, scenario.detector.alternative);
        let known = self.laws.take();
        let laws = match known {
            Some((s, a, laws)) if s == samples && a == alternative => laws,
            _ => NullLaws::new(alternative, &samples).map_err(RegionError::from)?,
        };
        Ok(&self.laws.insert((samples, alternative, laws)).2)
    }

    /// Whether `scenario` at rest differs from every one asked for before.
    fn is_new_at_rest(&mut self, scenario: &Scenario) -> bool {
        let at_rest = scenario.at_rest();
        let is_new = !self.at_rest.contains(&at_rest);
        if is_new {
            self.at_rest.push(at_rest);
        }
        is_new
    }
}
