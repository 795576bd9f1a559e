//! `[detectors]`: which detectors, noise and starts, and the columns of `points.csv`.

use super::noise::Noise;
use super::start::{REST, SECOND, Start};
use crate::detect::running::Detector;
use crate::rule::{OutOfRange, Rule};
use crate::study::curves::name_of;
use crate::study::outcomes::{ascending, outcome_row};
use libm::expm1;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Detectors of a start at one measured rate of false alarms.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The false alarms per hour of each detector on white normal noise.
    pub per_hour: f64,
    /// Records of 120 s that set the thresholds.
    pub pilot: usize,
    /// Records of 120 s in a trial at rest.
    pub records: usize,
    /// Which detectors.
    pub detector: Vec<Detector>,
    /// Δ/σ, the height of a start in deviations of the noise, in ascending order.
    pub delta: Vec<f64>,
    /// The starts.
    pub start: Vec<Start>,
    /// The noise, the first of the picture.
    pub noise: Vec<Noise>,
}

/// A detector on a noise, at rest or with a start.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub detector: Detector,
    pub noise: Noise,
    /// At rest, the start that the clairvoyant looks for; of the others none.
    pub start: Option<Start>,
    /// 0 at rest.
    pub delta: f64,
}

outcome_row! {
    |point: &Point|
    detector: String = point.detector.to_string();
    noise: String = point.noise.label.clone();
    start: String = point.start.as_ref().map_or(String::new(), |it| it.label.clone());
    delta: f64 = point.delta;
    ..
}

/// So many records of the pilot reach the threshold at least.
const REACH: f64 = 10.0;

impl Table {
    /// The share of records at rest that alarm.
    pub fn share(&self) -> f64 {
        -expm1(-self.per_hour * REST as f64 / (3600 * SECOND) as f64)
    }

    /// The smallest pilot.
    pub fn fewest(&self) -> usize {
        (REACH / self.share()).ceil() as usize
    }

    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If a number breaks its rule, a list is empty, or two things have one name.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(0.01, 30.0, "").check("detectors.per_hour", &self.per_hour)?;
        let fewest = self.fewest() as f64;
        Rule::Within(fewest, 1e6, "records").check("detectors.pilot", &(self.pilot as f64))?;
        let records = Rule::Within(1.0, 1000.0, "records");
        records.check("detectors.records", &(self.records as f64))?;
        let detectors = self.detector.iter().map(Detector::to_string);
        named("detectors.detector", "a detector", detectors)?;
        let starts = self.start.iter().map(|it| it.label.clone());
        named("detectors.start", "a start", starts)?;
        let noises = self.noise.iter().map(|it| it.label.clone());
        named("detectors.noise", "a noise", noises)?;
        self.start.iter().try_for_each(Start::check)?;
        let delta = Rule::Within(1e-3, 1e3, "");
        ascending("detectors.delta", "Δ/σ", delta, &self.delta)?;
        for noise in &self.noise {
            noise.check()?;
            if let Some(of) = &noise.delta {
                ascending("detectors.noise.delta", "Δ/σ", delta, of)?;
            }
        }
        Ok(())
    }

    /// Noise by noise, at rest and then start by start; all detectors at each Δ.
    pub fn points(&self) -> Vec<Point> {
        let each = self.noise.iter().flat_map(|noise| {
            let rests = self.detectors().filter_map(move |(detector, start)| {
                let is_first = self.start.first() == Some(start);
                let known = detector.knows_start().then(|| start.clone());
                (known.is_some() || is_first).then_some((detector, known, 0.0))
            });
            let deltas = noise.delta.as_ref().unwrap_or(&self.delta);
            let starts = self.start.iter().flat_map(move |start| {
                let at = move |&delta: &f64| {
                    let all = self.detector.iter();
                    all.map(move |detector| (*detector, Some(start.clone()), delta))
                };
                deltas.iter().flat_map(at)
            });
            let point = |(detector, start, delta)| Point {
                detector,
                noise: noise.clone(),
                start,
                delta,
            };
            rests.chain(starts).map(point).collect::<Vec<_>>()
        });
        each.collect()
    }

    /// Every detector with every start.
    pub fn detectors(&self) -> impl Iterator<Item = (Detector, &Start)> {
        let each = self.detector.iter();
        each.flat_map(|detector| self.start.iter().map(move |start| (*detector, start)))
    }
}

impl Point {
    /// Whether nothing starts.
    pub fn rests(&self) -> bool {
        self.delta == 0.0
    }
}

/// Checks that there are things of this kind, each with a name of its own.
fn named(key: &str, one: &str, labels: impl Iterator<Item = String>) -> Result<(), OutOfRange> {
    let mut names: Vec<String> = Vec::new();
    for label in labels {
        let name = name_of(&label);
        if name.is_empty() {
            return Err(OutOfRange::new(
                key,
                "have a letter or a digit in each name",
                label,
            ));
        }
        if names.contains(&name) {
            return Err(OutOfRange::new(key, "differ from point to point", label));
        }
        names.push(name);
    }
    match names.len() {
        0 => Err(OutOfRange::new(key, format!("name {one}"), "none")),
        _ => Ok(()),
    }
}
