//! `points.csv`: one row per point and hypothesis.

use crate::plan::{Hypothesis, Point};
use crate::tally::Tally;
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
    pub size: f64,
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
}

impl Row {
    /// What a point came to.
    pub fn new(point: &Point, tally: Tally, confidence: f64) -> Self {
        let scenario = &point.scenario;
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
            rule: scenario.detector.rule.to_string(),
            alpha: scenario.detector.alpha,
            size: point.region.size(),
            trials: tally.trials,
            detections: tally.hits,
            rate: tally.rate(),
            low: eight_digits(low),
            high: eight_digits(high),
            confidence,
            alternative: scenario.detector.alternative.to_string(),
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
        }
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
    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        const DERIVED: [&str; 8] = [
            "label",
            "trials",
            "detections",
            "rate",
            "low",
            "high",
            "confidence",
            "size",
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

/// Eight significant digits: more than any count supports, fewer than the last bits of a bisection.
pub fn eight_digits(value: f64) -> f64 {
    format!("{value:.7e}").parse().unwrap_or(value)
}

/// Rows as a CSV has them.
pub fn csv_bytes<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("a row is plain data");
    }
    writer.into_inner().expect("a vector takes every byte")
}
