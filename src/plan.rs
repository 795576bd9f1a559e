//! The plan of a sweep: every point with its scenario and region, and the families that share noise. Errors
//! in a config are found here, before the first trial.

use crate::chain::{Detector, Purpose, Scenario};
use crate::claim::{self, Pair};
use crate::detect::{
    Alternative, Exceedances, Method, NullLaws, Region, RegionError, Rule, Samples,
};
use crate::experiment::{ConfigError, SweepConfig};
use crate::scenario::{RECORD_KEYS, ScenarioError};
use crate::schedule::Schedule;
use std::sync::Arc;

/// Every point of an experiment, ready to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The points, in the order of the results.
    pub points: Vec<Point>,
    /// For each curve, the index of the point at each value of the axis. This is the point in motion, or the
    /// point at rest if nothing in the curve moves. Points that are equal at rest are planned once, under the
    /// first curve.
    pub along: Vec<Vec<usize>>,
    /// The seed of all random draws.
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
    /// The number of the curve, from 0.
    pub curve: usize,
    /// The number of the axis value, from 0.
    pub value: usize,
    /// The curve's label.
    pub label: String,
    /// Whether anything moves.
    pub hypothesis: Hypothesis,
    /// The parameters of the point.
    pub scenario: Scenario,
    /// How the point makes its decision.
    pub design: Design,
}

/// How a point obtains its decision rule.
#[derive(Clone, Debug)]
pub enum Design {
    /// The region follows from the exact laws.
    Region(Arc<Region>),
    /// A pilot run determines the rule.
    Pilot,
}

impl Design {
    /// The exact size, if it is known without a pilot.
    pub fn size(&self) -> Option<f64> {
        match self {
            Self::Region(region) => Some(region.size()),
            Self::Pilot => None,
        }
    }
}

/// The hypothesis that a point simulates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hypothesis {
    /// Rest.
    H0,
    /// Motion.
    H1,
}

impl Plan {
    /// Plans every point of every curve, and one point at rest for each distinct (sensor, noise, whitening,
    /// samples, detector). A curve in which nothing ever moves is a false-alarm curve and has only points at
    /// rest. A config that asks only for points at rest has only these, too.
    ///
    /// # Errors
    /// If a parameter of a point is out of range, or no region or record can be made for the point.
    pub fn new(config: &SweepConfig) -> Result<Self, ConfigError> {
        let header = config.header();
        let (points, along) = points(config)?;
        let schedule = Schedule::new(
            points.iter().map(|point| &point.scenario),
            header.trials(),
            header.seed,
            Purpose::Results,
            header.common_random_numbers,
        )
        .map_err(|(point, refusal)| {
            let Point { curve, value, .. } = points[point];
            let refusal = format!("samples: {refusal}");
            config.blame(curve, &config.axis().values[value], RECORD_KEYS, refusal)
        })?;
        Ok(Self {
            points,
            along,
            seed: header.seed,
            common_random_numbers: header.common_random_numbers,
            pilot: header.pilot,
            schedule,
        })
    }

    /// The schedule of a subset of the points.
    pub fn schedule_of(&self, points: &[usize]) -> Schedule {
        let schedule = Schedule::new(
            points.iter().map(|&at| &self.points[at].scenario),
            self.schedule.trials,
            self.seed,
            Purpose::Results,
            self.common_random_numbers,
        );
        schedule.expect("the records fitted in memory with more points")
    }

    /// The pairs of points that the claims of the config compare.
    pub fn pairs(&self, config: &SweepConfig) -> Vec<Pair> {
        claim::pairs(&config.narrative.claims, &config.scope, &self.along)
    }
}

/// Every point, and for each curve the index of the point at each value of the axis.
fn points(config: &SweepConfig) -> Result<(Vec<Point>, Vec<Vec<usize>>), ConfigError> {
    let mut designer = Designer::default();
    let (mut points, mut at_rest, mut along) = (Vec::<Point>::new(), Vec::new(), Vec::new());
    for (curve, scenarios) in scenarios(config)?.into_iter().enumerate() {
        let moves = !config.header().at_rest && scenarios.iter().any(Scenario::moves);
        let mut places = Vec::new();
        for (value, scenario) in scenarios.into_iter().enumerate() {
            let design = designer.design(&scenario).map_err(|error| {
                config.blame(curve, &config.axis().values[value], error.keys(), error)
            })?;
            let point = |hypothesis, scenario| Point {
                curve,
                value,
                label: config.scope.curves[curve].label.clone(),
                hypothesis,
                scenario,
                design: design.clone(),
            };
            let resting = scenario.at_rest();
            // An earlier value or curve may have planned the same point at rest.
            let known = at_rest
                .iter()
                .find(|&&at: &&usize| points[at].scenario == resting);
            let mut place = known.copied().unwrap_or(points.len());
            if known.is_none() {
                at_rest.push(place);
                points.push(point(Hypothesis::H0, resting));
            }
            if moves {
                place = points.len();
                points.push(point(Hypothesis::H1, scenario));
            }
            places.push(place);
        }
        along.push(places);
    }
    Ok((points, along))
}

/// For each curve, the scenario at each value of the axis.
fn scenarios(config: &SweepConfig) -> Result<Vec<Vec<Scenario>>, ConfigError> {
    let curves = 0..config.scope.curves.len();
    curves
        .map(|curve| {
            let values = config.axis().values.iter();
            values.map(|value| config.scenario(curve, value)).collect()
        })
        .collect()
}

/// Makes each region once. It keeps only the latest laws, because laws are large.
#[derive(Default)]
struct Designer {
    laws: Option<((Samples, Exceedances, Alternative), NullLaws)>,
    regions: Vec<(Samples, Detector, Arc<Region>)>,
}

impl Designer {
    /// The exact region, or a note that a pilot will determine it. The exact region is made even for a rule
    /// that a pilot will calibrate, because a level that cannot be reached exactly cannot be reached by
    /// calibration.
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
        let (samples, detector) = (scenario.samples, &scenario.detector);
        let key = (samples, detector.exceedances, detector.alternative);
        let laws = match self.laws.take() {
            Some((known, laws)) if known == key => laws,
            _ => NullLaws::new(detector.exceedances, detector.alternative, &samples)
                .map_err(RegionError::from)?,
        };
        Ok(&self.laws.insert((key, laws)).1)
    }
}
