//! Rules across sections, and the keys to blame when they are broken.

use super::{Calibration, Scenario};
use crate::detect::{Baseline, Exceedances, Method, RegionError, Rule};
use crate::format::brief;
use crate::signal::MotionError;
use crate::whiten::{DEFAULT_ORDER, Fit, Order, WhiteningError};

/// Why sections do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ScenarioError {
    #[error("motion.{0}")]
    Motion(#[from] MotionError),
    #[error("whitening.{0}")]
    Whitening(#[from] WhiteningError),
    #[error(
        "noise.range: ±{} is less than a step of {}, so that every sample would read 0 (raise range or lower \
         noise.quantum)", brief(*.range), brief(*.quantum)
    )]
    RangeBelowQuantum { range: f64, quantum: f64 },
    #[error(
        "whitening.order: has no effect with fit = \"none\", got {0} (leave it out, or fit the filter)"
    )]
    OrderOfNothing(usize),
    #[error(
        "whitening.order: the known filter of this sensor has order {sensor}, got {order} (leave order out, or set it \
         to {sensor})"
    )]
    OrderAboveSensor { sensor: usize, order: usize },
    #[error("detector: {0}")]
    Region(#[from] RegionError),
    #[error(
        "whitening.fit: the known filter is that of single samples, not of means of {0} \
         (fit the filter, or set decimation to 1)"
    )]
    KnownFilterDecimated(usize),
    #[error(
        "motion.delta_at: the shift after whitening is known for single samples, not for means of {0} \
         (set delta_at to \"record\", or decimation to 1)"
    )]
    WhitenedDeltaDecimated(usize),
    #[error(
        "detector.rule: {0} is made for one motion, and nothing moves here \
         (give motion.delta or impulses.nu and theta, or take the value that moves nothing out of the axis)"
    )]
    NothingStated(&'static str),
    #[error("detector.exceedances: rule {0} counts none (take it out)")]
    NothingExceeds(&'static str),
    #[error(
        "detector.calibrate: a table's entries are given (leave calibrate out, or name a rule)"
    )]
    TableCalibrated,
    #[error(
        "detector.rule: {0} has no exact law (add calibrate = {{ law = \"normal\" }} to measure its \
         threshold, or calibrate = true)"
    )]
    NotCalibrated(&'static str),
    #[error(
        "detector.rule: clairvoyant knows the filter of single samples, not of means of {0} \
         (set decimation to 1)"
    )]
    ClairvoyantDecimated(usize),
    #[error(
        "detector.rule: clairvoyant takes sensors of at most order {MOST_CLAIRVOYANT_ORDER}, and no longer than \
         the rest, got order {0} (give another sensor)"
    )]
    ClairvoyantOrder(usize),
    #[error("detector.rule: variance-ratio needs at least 2 samples in reference and in scale")]
    NoVariance,
    #[error(
        "detector.rule: block-means needs {needed} samples of rest, 8 times shift, got {got} \
         (raise training or reference)"
    )]
    RestTooShort { needed: usize, got: usize },
}

/// The number of states of the clairvoyant grows like 2.4 to the power of the sensor's order.
const MOST_CLAIRVOYANT_ORDER: usize = 6;

const RULE: &str = "detector.rule";
const DECIMATION: &str = "samples.decimation";
const SENSOR: &[&str] = &["sensor.ar", "sensor.transfer", "sensor.model"];

impl ScenarioError {
    /// The keys to blame, the likeliest first.
    pub fn keys(&self) -> &'static [&'static str] {
        match self {
            Self::Motion(MotionError::Delta(_)) => &["motion.delta"],
            Self::Motion(MotionError::Duration { .. }) => &["motion.duration", "motion.offset"],
            Self::Motion(MotionError::Rise { .. }) => &["motion.profile", "motion.duration"],
            Self::Whitening(error) => error.keys(),
            Self::RangeBelowQuantum { .. } => &["noise.range", "noise.quantum"],
            Self::OrderOfNothing(_) | Self::OrderAboveSensor { .. } => {
                &["whitening.order", "whitening.fit"]
            }
            Self::Region(error) => blamed(error),
            Self::KnownFilterDecimated(_) => &["whitening.fit", DECIMATION],
            Self::WhitenedDeltaDecimated(_) => &["motion.delta_at", DECIMATION],
            Self::TableCalibrated => &["detector.calibrate"],
            Self::ClairvoyantDecimated(_) => &[DECIMATION],
            Self::ClairvoyantOrder(_) => SENSOR,
            Self::NoVariance => &["samples.reference", "samples.scale"],
            Self::NothingExceeds(_) => &["detector.exceedances"],
            Self::NothingStated(_) | Self::NotCalibrated(_) | Self::RestTooShort { .. } => &[RULE],
        }
    }
}

/// The keys to blame for a region that does not exist.
pub fn blamed(error: &RegionError) -> &'static [&'static str] {
    match error {
        RegionError::Alpha(_) | RegionError::Unreachable { .. } => &["detector.alpha", RULE],
        RegionError::Law(_) => &["samples.shift", "samples.reference", "samples.scale"],
        _ => &[RULE, "samples.scale"],
    }
}

/// The keys to blame for a record that does not fit in memory.
pub const RECORD_KEYS: &[&str] = &[
    "whitening.training",
    "samples.gap",
    DECIMATION,
    "samples.reference",
    "samples.scale",
    "samples.shift",
];

impl Scenario {
    /// Checks the sections against each other.
    pub(super) fn check(&self) -> Result<(), ScenarioError> {
        self.check_digitiser()?;
        self.check_order()?;
        self.check_decimation()?;
        let detector = &self.detector;
        let is_calibrated = detector.calibration != Calibration::None;
        let name = detector.method.name();
        if detector.method.states_its_alternative() && !self.moves() {
            return Err(ScenarioError::NothingStated(name));
        }
        match &detector.method {
            Method::Rule(Rule::Table(_)) if is_calibrated => Err(ScenarioError::TableCalibrated),
            Method::Baseline(_) if !is_calibrated => Err(ScenarioError::NotCalibrated(name)),
            Method::Baseline(_) if detector.exceedances != Exceedances::default() => {
                Err(ScenarioError::NothingExceeds(name))
            }
            Method::Baseline(baseline) => self.check_baseline(*baseline),
            _ => Ok(()),
        }
    }

    fn check_digitiser(&self) -> Result<(), ScenarioError> {
        match (self.digitiser.range(), self.digitiser.quantum()) {
            // The slack with which the converter counts its steps.
            (Some(range), Some(quantum)) if range * (1.0 + 1e-12) < quantum => {
                Err(ScenarioError::RangeBelowQuantum { range, quantum })
            }
            _ => Ok(()),
        }
    }

    /// An order that is written must mean something: what is not fitted has the default or the sensor's own.
    fn check_order(&self) -> Result<(), ScenarioError> {
        let Order::Fixed(order) = self.whitening.order else {
            return Ok(());
        };
        let sensor = self.sensor.ar().len();
        match self.whitening.fit {
            Fit::None if order != DEFAULT_ORDER => Err(ScenarioError::OrderOfNothing(order)),
            Fit::Known if order > sensor.max(DEFAULT_ORDER) => {
                Err(ScenarioError::OrderAboveSensor { sensor, order })
            }
            _ => Ok(()),
        }
    }

    /// Block means of a coloured record do not follow the sensor's autoregression, so methods that use its
    /// coefficients are refused.
    fn check_decimation(&self) -> Result<(), ScenarioError> {
        let decimation = self.samples.decimation();
        if decimation == 1 || self.sensor.ar().is_empty() {
            return Ok(());
        }
        if self.whitening.fit == Fit::Known {
            return Err(ScenarioError::KnownFilterDecimated(decimation));
        }
        if self.motion.delta_at == crate::signal::DeltaAt::Whitened {
            return Err(ScenarioError::WhitenedDeltaDecimated(decimation));
        }
        Ok(())
    }

    fn check_baseline(&self, baseline: Baseline) -> Result<(), ScenarioError> {
        let samples = &self.samples;
        let rest = self.whitening.lead() + samples.reference();
        match baseline {
            Baseline::Clairvoyant if samples.decimation() > 1 => {
                Err(ScenarioError::ClairvoyantDecimated(samples.decimation()))
            }
            Baseline::Clairvoyant => {
                let order = self.sensor.ar().len();
                if order > MOST_CLAIRVOYANT_ORDER || order > rest {
                    return Err(ScenarioError::ClairvoyantOrder(order));
                }
                Ok(())
            }
            Baseline::VarianceRatio if samples.reference() < 2 || samples.scale() < 2 => {
                Err(ScenarioError::NoVariance)
            }
            Baseline::BlockMeans => {
                let needed = samples.shift().saturating_mul(8);
                if rest < needed {
                    return Err(ScenarioError::RestTooShort { needed, got: rest });
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }
}
