//! One decision to be found by pilots: the pilots it needs, the false alarms they may count, and the resulting
//! decision.

use super::gather::{Gauge, Largest};
use super::ladder::Ladder;
use super::stage::Stage;
use crate::chain::{Calibration, Decision, Detector, RecordTooLong, Scenario, Score};
use crate::detect::{Histogram, Method, Region};
use crate::plan::Point;
use crate::signal::{Law, Noise};
use crate::stats::binomial;
use std::sync::Arc;

/// The only laws of noise under which a calibrated design promises its level.
pub const PROMISED_LAWS: [Law; 4] = [Law::Normal, Law::Laplace, Law::Uniform, Law::Cauchy];

/// The largest probability that a promise is broken.
pub const PROMISE_LEVEL: f64 = 1e-3;

/// Why no decision could be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PilotError {
    /// A pilot's record does not fit in memory.
    #[error("pilot: {0}")]
    Record(#[from] RecordTooLong),
    /// No region or threshold keeps the level.
    #[error(
        "curve {curve}: detector: {pilot} pilot trials show no region or threshold of rule {rule} that keeps \
         alpha = {alpha} (raise pilot, training or alpha)"
    )]
    Nothing {
        /// The label of the first curve that needs it.
        curve: String,
        /// The decision rule.
        rule: String,
        /// The level asked for.
        alpha: f64,
        /// Trials of each pilot.
        pilot: u64,
    },
}

/// With fewer false alarms a measured rate is too uncertain to set a threshold.
const FEWEST_FALSE_ALARMS: u64 = 20;

/// With fewer trials the order of likelihood ratios is mostly noise.
const FEWEST_TRIALS: u64 = 1000;

/// A decision to be found.
#[derive(Debug)]
pub(super) struct Need {
    /// The label of the first curve that needs it.
    curve: String,
    /// The scenario at rest, with the noise of its pilots.
    pub scenario: Scenario,
    /// The score that decides; `None` for a region.
    score: Option<Arc<Score>>,
    /// The most false alarms allowed in a pilot at rest.
    allowed: u64,
    /// Trials of each pilot.
    pilot: u64,
    /// Its index among the pilots in motion.
    motion: Option<usize>,
    /// Its indices among the pilots at rest.
    rest: Vec<usize>,
}

impl Need {
    /// Adds the pilots of `scenario`, which `point` needs first, to the stages.
    pub fn new(
        point: &Point,
        scenario: Scenario,
        pilot: u64,
        motion: &mut Stage,
        rest: &mut Stage,
    ) -> Result<Self, PilotError> {
        let detector = &scenario.detector;
        let curve = point.label.clone();
        let is_too_short = detector.method == Method::LikelihoodRatio && pilot < FEWEST_TRIALS;
        let allowed = allowed(detector, pilot).filter(|_| !is_too_short);
        let Some(allowed) = allowed else {
            return Err(nothing(curve, detector, pilot));
        };
        let score = Score::new(&scenario).map(Arc::new);
        let gauge = match &score {
            Some(score) => Gauge::Score(score.clone(), Largest::new(allowed as usize + 1)),
            None => Gauge::Statistics(detector.ties, Histogram::default()),
        };
        let stated = detector
            .stated
            .filter(|_| detector.method == Method::LikelihoodRatio);
        let moving = stated.map(|(motion, impulses)| Scenario {
            motion,
            impulses,
            ..scenario.clone()
        });
        Ok(Self {
            motion: moving.map(|moving| motion.add(moving, gauge.clone())),
            rest: resting(&scenario)
                .into_iter()
                .map(|resting| rest.add(resting, gauge.clone()))
                .collect(),
            curve,
            scenario,
            score,
            allowed,
            pilot,
        })
    }

    /// The decision, from the gauges of the pilots in motion and at rest.
    pub fn decide(&self, motion: &[Gauge], rest: &[Gauge]) -> Result<Decision, PilotError> {
        let detector = &self.scenario.detector;
        let rest: Vec<&Gauge> = self.rest.iter().map(|&place| &rest[place]).collect();
        if let Some(score) = &self.score {
            let thresholds = rest.iter().map(|gauge| gauge.threshold());
            return Ok(Decision::Threshold {
                score: score.clone(),
                threshold: thresholds.fold(f64::NEG_INFINITY, f64::max),
            });
        }
        let motion = self.motion.map(|place| motion[place].histogram());
        let ladder = Ladder::new(&self.scenario, motion);
        let keeps = |region: &Region| {
            let mut counts = rest.iter().map(|gauge| gauge.count(region));
            counts.all(|count| count <= self.allowed)
        };
        let region = match detector.calibration {
            Calibration::None => ladder.region(detector.alpha),
            Calibration::Promise => ladder.climb(detector.alpha, keeps),
            Calibration::Measured { .. } => ladder.search(keeps),
        };
        if region.size() > 0.0 {
            Ok(Decision::Region {
                region: Arc::new(region),
                ties: detector.ties,
            })
        } else {
            Err(nothing(self.curve.clone(), detector, self.pilot))
        }
    }
}

/// The scenarios at rest on which its level is measured.
fn resting(scenario: &Scenario) -> Vec<Scenario> {
    match scenario.detector.calibration {
        Calibration::None => Vec::new(),
        Calibration::Measured { .. } => vec![scenario.clone()],
        Calibration::Promise => {
            let under = |of| Scenario {
                noise: law(of),
                ..scenario.clone()
            };
            PROMISED_LAWS.map(under).to_vec()
        }
    }
}

/// The scenario at rest, with the sensor and law of its calibration.
pub(super) fn believed(scenario: &Scenario) -> Scenario {
    let mut rest = scenario.at_rest();
    match &scenario.detector.calibration {
        Calibration::None => {}
        Calibration::Promise => rest.noise = law(PROMISED_LAWS[0]),
        Calibration::Measured { sensor, noise } => {
            rest.sensor = sensor.clone().unwrap_or(rest.sensor);
            rest.noise = noise.unwrap_or(rest.noise);
        }
    }
    rest
}

fn law(law: Law) -> Noise {
    Noise::new(law).expect("the promised laws have no parameters out of range")
}

fn nothing(curve: String, detector: &Detector, pilot: u64) -> PilotError {
    PilotError::Nothing {
        curve,
        rule: detector.method.to_string(),
        alpha: detector.alpha,
        pilot,
    }
}

/// The most false alarms allowed in a pilot at rest; `None` if the pilot is too short.
fn allowed(detector: &Detector, pilot: u64) -> Option<u64> {
    let expected = (detector.alpha * pilot as f64).floor() as u64;
    match detector.calibration {
        Calibration::None => return Some(0),
        Calibration::Measured { .. } => {
            return (expected >= FEWEST_FALSE_ALARMS).then_some(expected);
        }
        Calibration::Promise => {}
    }
    // Counts so small that a rate of α gives them with probability 0.001 at most.
    let is_shown = |count: u64| binomial::lower_tail(count, pilot, detector.alpha) <= PROMISE_LEVEL;
    let (mut shown, mut not_shown) = (0, expected + 1);
    while shown < not_shown {
        let middle = shown + (not_shown - shown) / 2;
        if is_shown(middle) {
            shown = middle + 1
        } else {
            not_shown = middle
        }
    }
    shown.checked_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::SweepConfig;

    /// Against the definition by sums of exact masses: the largest count k with P(K ≤ k) ≤ 0.001 at a rate of α,
    /// or `None`.
    #[test]
    fn allowed_counts_are_exact() {
        let detector = |calibrate: &str| {
            let text = format!(
                "question = \"?\"\nseed = 1\n[detector]\ncalibrate = {calibrate}\n[axis]\ndelta = [1.0]\n"
            );
            let config = SweepConfig::parse("test", &text).unwrap();
            config
                .scenario(0, &config.axis().values[0])
                .unwrap()
                .detector
        };
        let promise = detector("true");
        for pilot in [700u64, 1000, 5000, 20_000] {
            let cumulative = |count: u64| {
                (0..=count)
                    .map(|k| binomial::mass(k, pilot, 0.01))
                    .sum::<f64>()
            };
            let expected = (0..pilot)
                .take_while(|&count| cumulative(count) <= 1e-3)
                .last();
            assert_eq!(allowed(&promise, pilot), expected, "{pilot}");
        }
        assert_eq!(allowed(&promise, 500), None);
        assert_eq!(allowed(&detector("{}"), 5000), Some(50));
        assert_eq!(allowed(&detector("{}"), 1000), None);
    }
}
