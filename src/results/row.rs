//! `points.csv`: one row per point and hypothesis.

use crate::chain::{Decision, Scenario};
use crate::counts::DecisionSummary;
use crate::plan::{Design, Hypothesis, Point};
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

    /// The row of a point whose decision is known by its summary.
    pub fn summarised(
        point: &Point,
        decision: &DecisionSummary,
        tally: Tally,
        confidence: f64,
    ) -> Self {
        Self {
            size: decision.size,
            threshold: decision.threshold,
            reachable: decision.reachable,
            ..Self::new(point, None, tally, confidence)
        }
    }

    /// What it says of the decision.
    pub fn decision(&self) -> DecisionSummary {
        DecisionSummary {
            size: self.size,
            threshold: self.threshold,
            reachable: self.reachable,
        }
    }

    /// The number that an axis of this name would have here; none where it has none.
    pub fn on_axis(&self, parameter: &str) -> Option<f64> {
        Some(match parameter {
            "delta" => self.delta,
            "duration" => self.duration as f64,
            "offset" => self.offset as f64,
            "nu" => self.nu,
            "theta" => self.theta,
            "quantum" => self.quantum?,
            "range" => self.range?,
            "drift" => self.drift,
            "swell" => self.swell,
            "footfalls" => self.footfalls,
            "training" => self.training as f64,
            "order" => self.order as f64,
            "all_samples" | "shift" => self.shift as f64,
            "reference_and_scale" | "reference" => self.reference as f64,
            "scale" => self.scale as f64,
            "gap" => self.gap as f64,
            "decimation" => self.decimation as f64,
            "alpha" => self.alpha,
            _ => return None,
        })
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
    fn parameters(&self) -> Vec<(String, String)> {
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

/// Every parameter of a scenario by its column.
pub fn parameters(scenario: &Scenario) -> Vec<(String, String)> {
    let point = Point {
        curve: 0,
        label: String::new(),
        hypothesis: Hypothesis::H1,
        scenario: scenario.clone(),
        design: Design::Pilot,
    };
    let nothing = Tally { hits: 0, trials: 1 };
    let parameters = Row::new(&point, None, nothing, 0.5)
        .parameters()
        .into_iter();
    let is_place = |name: &str| name == "curve" || name == "hypothesis";
    parameters.filter(|(name, _)| !is_place(name)).collect()
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
