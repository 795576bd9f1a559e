//! `points.csv`: one row per point and hypothesis.

use super::RESULTS;
use crate::chain::Decision;
use crate::claim::Outcome;
use crate::config::Parameter;
use crate::format::eight_digits;
use crate::ledger::Key;
use crate::plan::{Hypothesis, Point};
use crate::signal::{Impulses, Motion};
use crate::stats::tally::Tally;
use serde::{Deserialize, Serialize};

/// One row of `points.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub curve: usize,
    pub label: String,
    pub hypothesis: String,
    pub delta: f64,
    pub nu: f64,
    pub theta: f64,
    pub noise: String,
    pub order: usize,
    pub training: usize,
    pub reference: usize,
    pub shift: usize,
    pub scale: usize,
    pub rule: String,
    pub alpha: f64,
    pub size: Option<f64>,
    pub trials: u64,
    pub detections: u64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
    pub confidence: f64,
    pub alternative: String,
    pub sensor: String,
    pub quantum: Option<f64>,
    pub range: Option<f64>,
    pub fit: String,
    pub includes_reference: bool,
    pub gap: usize,
    pub decimation: usize,
    pub delta_at: String,
    pub profile: String,
    pub duration: usize,
    pub offset: usize,
    pub during: String,
    pub drift: f64,
    pub swell: f64,
    pub footfalls: f64,
    pub jolt: f64,
    pub ties: String,
    pub calibrate: String,
    pub stated: String,
    pub pilot: u64,
    pub threshold: Option<f64>,
    pub reachable: Option<f64>,
}

/// What a row says of how its point decides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the row's own")]
pub struct Told {
    pub size: Option<f64>,
    pub threshold: Option<f64>,
    pub reachable: Option<f64>,
}

impl Row {
    /// What a point came to, and by which decision where it is known.
    pub fn new(point: &Point, decision: Option<&Decision>, tally: Tally, confidence: f64) -> Self {
        let scenario = &point.scenario;
        let (disturbance, detector) = (&scenario.disturbance, &scenario.detector);
        let (samples, whitening) = (&scenario.samples, &scenario.whitening);
        let (low, high) = tally.interval(confidence);
        Self {
            curve: point.curve + 1,
            label: point.label.clone(),
            hypothesis: match point.hypothesis {
                Hypothesis::H0 => "H0".to_owned(),
                Hypothesis::H1 => "H1".to_owned(),
            },
            delta: scenario.motion.delta,
            nu: scenario.impulses.nu(),
            theta: scenario.impulses.theta(),
            noise: scenario.noise.to_string(),
            order: whitening.order(),
            training: whitening.training(),
            reference: samples.reference(),
            shift: samples.shift(),
            scale: samples.scale(),
            rule: detector.method.to_string(),
            alpha: detector.alpha,
            size: decision.and_then(Decision::size).or(point.design.size()),
            trials: tally.trials,
            detections: tally.hits,
            rate: tally.rate(),
            low: eight_digits(low),
            high: eight_digits(high),
            confidence,
            alternative: detector.alternative.to_string(),
            sensor: scenario.sensor.to_string(),
            quantum: scenario.digitiser.quantum(),
            range: scenario.digitiser.range(),
            fit: whitening.fit().to_string(),
            includes_reference: whitening.includes_reference(),
            gap: samples.gap(),
            decimation: samples.decimation(),
            delta_at: scenario.motion.delta_at.to_string(),
            profile: scenario.motion.profile.to_string(),
            duration: scenario.motion.duration,
            offset: scenario.motion.offset,
            during: scenario.impulses.during().to_string(),
            drift: disturbance.drift(),
            swell: disturbance.swell(),
            footfalls: disturbance.footfalls(),
            jolt: disturbance.jolt(),
            ties: detector.ties.to_string(),
            calibrate: detector.calibration.to_string(),
            stated: detector.stated.map(stated).unwrap_or_default(),
            pilot: detector.pilot,
            threshold: decision.and_then(Decision::threshold).map(eight_digits),
            reachable: decision.and_then(Decision::reachable).map(eight_digits),
        }
    }

    /// The row of a point whose decision is known by what was told of it.
    pub fn retold(point: &Point, told: &Told, tally: Tally, confidence: f64) -> Self {
        Self {
            size: told.size,
            threshold: told.threshold,
            reachable: told.reachable,
            ..Self::new(point, None, tally, confidence)
        }
    }

    /// What it says of the decision.
    pub fn told(&self) -> Told {
        Told {
            size: self.size,
            threshold: self.threshold,
            reachable: self.reachable,
        }
    }

    /// What the counts here are known by: every parameter that they depend on, which its place among
    /// the curves is none of.
    pub fn key(&self, seed: u64, common_random_numbers: bool) -> Key {
        let mut text =
            format!("results {RESULTS} seed {seed} common_random_numbers {common_random_numbers}");
        for (name, value) in self.parameters() {
            if name != "curve" && name != "hypothesis" {
                text += &format!(" {name} {value}");
            }
        }
        Key::of(&text)
    }

    /// The number that an axis of this parameter would have here; none where there is none.
    pub fn on_axis(&self, parameter: Parameter) -> Option<f64> {
        Some(match parameter {
            Parameter::Delta => self.delta,
            Parameter::Duration => self.duration as f64,
            Parameter::Offset => self.offset as f64,
            Parameter::Nu => self.nu,
            Parameter::Theta => self.theta,
            Parameter::Quantum => self.quantum?,
            Parameter::Range => self.range?,
            Parameter::Drift => self.drift,
            Parameter::Swell => self.swell,
            Parameter::Footfalls => self.footfalls,
            Parameter::Training => self.training as f64,
            Parameter::Order => self.order as f64,
            Parameter::AllSamples | Parameter::Shift => self.shift as f64,
            Parameter::ReferenceAndScale | Parameter::Reference => self.reference as f64,
            Parameter::Scale => self.scale as f64,
            Parameter::Gap => self.gap as f64,
            Parameter::Decimation => self.decimation as f64,
            Parameter::Alpha => self.alpha,
            Parameter::Rule => return None,
        })
    }

    /// What claims and texts read of it, on an axis of this parameter.
    pub fn outcome(&self, parameter: Parameter) -> Outcome {
        Outcome {
            label: self.label.clone(),
            value: match (parameter, self.on_axis(parameter)) {
                (Parameter::Rule, _) => self.rule_name().to_owned(),
                (_, Some(number)) => number.to_string(),
                (_, None) => "none".to_owned(),
            },
            is_at_rest: self.is_at_rest(),
            tally: self.tally(),
            low: self.low,
            high: self.high,
            alpha: self.alpha,
            size: self.size,
            reachable: self.reachable,
        }
    }

    /// The rule without its table.
    pub fn rule_name(&self) -> &str {
        self.rule.split('(').next().unwrap_or_default()
    }

    /// Whether this is the point at rest.
    pub fn is_at_rest(&self) -> bool {
        self.hypothesis == "H0"
    }

    /// The counts that everything else about the outcome derives from.
    pub fn tally(&self) -> Tally {
        Tally {
            hits: self.detections,
            trials: self.trials,
        }
    }

    /// The parameters alone, by column.
    pub fn parameters(&self) -> Vec<(String, String)> {
        const DERIVED: [&str; 10] = [
            "label",
            "trials",
            "detections",
            "rate",
            "low",
            "high",
            "confidence",
            "size",
            "threshold",
            "reachable",
        ];
        let columns = match serde_json::to_value(self) {
            Ok(serde_json::Value::Object(columns)) => columns,
            _ => unreachable!("a row is plain data"),
        };
        let parameters = columns
            .into_iter()
            .filter(|(name, _)| !DERIVED.contains(&name.as_str()));
        parameters
            .map(|(name, value)| (name, value.to_string()))
            .collect()
    }
}

/// The motion that a method is made for.
fn stated((motion, impulses): (Motion, Impulses)) -> String {
    let (delta, duration, offset) = (motion.delta, motion.duration, motion.offset);
    let (nu, theta, during) = (impulses.nu(), impulses.theta(), impulses.during());
    format!(
        "delta {delta} {} {} duration {duration} offset {offset} nu {nu} theta {theta} {during}",
        motion.delta_at, motion.profile
    )
}

/// Rows as a CSV has them.
pub fn csv_bytes<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("a row is plain data");
    }
    writer.into_inner().expect("a vector takes every byte")
}
