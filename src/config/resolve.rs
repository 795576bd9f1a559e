//! From sections to a scenario: defaults filled in, parts checked against each other, every refusal
//! sent back to the value that caused it.

use super::error::Problem;
use super::file::{
    AlternativeKind, CalibrateKind, DeltaAtKind, DuringKind, FitKind, LawKind, ProfileKind,
    RuleKind, Sections, SensorSection, TiesKind,
};
use super::source::ConfigError;
use super::value::{Number, Whole};
use super::{AxisValue, Config};
use crate::chain::{Calibration, Detector, Scenario};
use crate::detect::{
    Alternative, Baseline, Method, RegionError, Rule, Samples, SamplesError, Ties,
};
use crate::signal::{
    DeltaAt, Digitiser, DigitiserError, Disturbance, DisturbanceError, During, Impulses,
    ImpulsesError, Law, Motion, MotionError, Noise, Profile, Sensor, SensorError, Transfer,
};
use crate::whiten::{Fit, Whitening, WhiteningError};
use toml::Spanned;

/// A problem and the sections and keys that may be to blame, the likeliest first.
pub(super) type Blamed = (Problem, &'static [(&'static str, &'static str)]);

impl Config {
    /// The scenario of `curve` (from 0) at one value of the axis.
    ///
    /// # Errors
    /// Where a parameter is out of range or does not fit another.
    pub fn scenario(&self, curve: usize, value: &AxisValue) -> Result<Scenario, ConfigError> {
        let mut sections = self.curves[curve].sections.clone();
        let axis_span = Some(self.axis.span());
        if let Err(problem) = self.axis.set(value, &mut sections) {
            return Err(self.source.at(axis_span, problem));
        }
        let mut scenario = sections.resolve().map_err(|(problem, keys)| {
            let span = sections.first_span(keys).or(axis_span);
            self.source.at(span, problem)
        })?;
        if scenario.detector.needs_pilot() {
            scenario.detector.pilot = self.pilot;
        }
        Ok(scenario)
    }

    /// A problem of one point that only shows when its region is designed or its record laid out.
    pub fn blame(&self, curve: usize, value: &AxisValue, problem: Problem) -> ConfigError {
        let mut sections = self.curves[curve].sections.clone();
        let axis_span = Some(self.axis.span());
        if let Err(problem) = self.axis.set(value, &mut sections) {
            return self.source.at(axis_span, problem);
        }
        let keys: &[_] = match &problem {
            Problem::Region(RegionError::Alpha(_) | RegionError::Unreachable { .. }) => {
                &[("detector", "alpha"), ("detector", "rule")]
            }
            Problem::Region(RegionError::Law(_)) => &[
                ("samples", "shift"),
                ("samples", "reference"),
                ("samples", "scale"),
            ],
            Problem::Region(_) => &[("detector", "rule"), ("samples", "scale")],
            _ => &[
                ("whitening", "training"),
                ("samples", "gap"),
                ("samples", "decimation"),
                ("samples", "reference"),
                ("samples", "scale"),
                ("samples", "shift"),
            ],
        };
        let span = sections.first_span(keys).or(axis_span);
        self.source.at(span, problem)
    }
}

impl Sections {
    pub(super) fn resolve(&self) -> Result<Scenario, Blamed> {
        let sensor = self.sensor()?;
        let samples = self.samples()?;
        self.check_decimation(&sensor, &samples)?;
        let noise = self.noise()?;
        let mut scenario = Scenario {
            disturbance: self.disturbance()?,
            digitiser: self.digitiser()?,
            motion: self.motion(&samples)?,
            impulses: self.impulses()?,
            whitening: self.whitening(&sensor)?,
            detector: self.detector(&sensor, noise)?,
            noise,
            sensor,
            samples,
        };
        check_method(&scenario)?;
        if scenario.detector.method.states_its_alternative() {
            scenario.detector.stated = Some((scenario.motion, scenario.impulses));
        }
        Ok(scenario)
    }

    fn disturbance(&self) -> Result<Disturbance, Blamed> {
        let section = &self.rest;
        let number = |value, default| get(value, Number(default)).0;
        let disturbance = Disturbance::new(
            number(&section.drift, 0.0),
            number(&section.swell, 1.0),
            number(&section.footfalls, 0.0),
            number(&section.jolt, 10.0),
        );
        disturbance.map_err(|error| {
            let key: &[_] = match error {
                DisturbanceError::Drift(_) => &[("rest", "drift")],
                DisturbanceError::Swell(_) => &[("rest", "swell")],
                DisturbanceError::Footfalls(_) => &[("rest", "footfalls")],
                DisturbanceError::Jolt(_) => &[("rest", "jolt")],
            };
            (error.into(), key)
        })
    }

    /// Block means of a coloured record are no longer the sensor's autoregression, so nothing that
    /// relies on its coefficients may be asked of them.
    fn check_decimation(&self, sensor: &Sensor, samples: &Samples) -> Result<(), Blamed> {
        let decimation = samples.decimation();
        if decimation == 1 || sensor.ar().is_empty() {
            return Ok(());
        }
        if matches!(
            get(&self.whitening.fit, FitKind::LeastSquares),
            FitKind::Known
        ) {
            let problem = Problem::KnownFilterDecimated(decimation);
            return Err((problem, &[("whitening", "fit"), ("samples", "decimation")]));
        }
        if matches!(
            get(&self.motion.delta_at, DeltaAtKind::Record),
            DeltaAtKind::Whitened
        ) {
            let problem = Problem::WhitenedDeltaDecimated(decimation);
            return Err((
                problem,
                &[("motion", "delta_at"), ("samples", "decimation")],
            ));
        }
        Ok(())
    }

    fn sensor(&self) -> Result<Sensor, Blamed> {
        sensor(&self.sensor)
    }

    fn noise(&self) -> Result<Noise, Blamed> {
        noise(get(&self.noise.law, LawKind::Normal)).map_err(|problem| (problem, LAW_KEYS))
    }

    fn digitiser(&self) -> Result<Digitiser, Blamed> {
        let number = |value: &Option<Spanned<Number>>| value.as_ref().map(|v| v.get_ref().0);
        let (quantum, range) = (number(&self.noise.quantum), number(&self.noise.range));
        Digitiser::new(quantum, range).map_err(|error| {
            let key: &[_] = match error {
                DigitiserError::Quantum(_) => &[("noise", "quantum")],
                DigitiserError::Range(_) => &[("noise", "range")],
            };
            (error.into(), key)
        })
    }

    fn motion(&self, samples: &Samples) -> Result<Motion, Blamed> {
        let section = &self.motion;
        let offset = get(&section.offset, Whole(0)).size();
        // Up to the last of Y₁, wherever it starts.
        let default_duration = samples.acceleration().saturating_sub(offset);
        let motion = Motion {
            delta: get(&section.delta, Number(0.0)).0,
            delta_at: match get(&section.delta_at, DeltaAtKind::Record) {
                DeltaAtKind::Record => DeltaAt::Record,
                DeltaAtKind::Whitened => DeltaAt::Whitened,
            },
            profile: match get(&section.profile, ProfileKind::Rectangular) {
                ProfileKind::Rectangular => Profile::Rectangular,
                ProfileKind::Trapezoid { rise } => Profile::Trapezoid { rise: rise.0 },
            },
            duration: get(&section.duration, Whole(default_duration as u64)).size(),
            offset,
        };
        motion.checked().map_err(|error| {
            let keys: &[_] = match error {
                MotionError::Delta(_) => &[("motion", "delta")],
                MotionError::Duration { .. } => &[("motion", "duration"), ("motion", "offset")],
                MotionError::Rise { .. } => &[("motion", "profile"), ("motion", "duration")],
            };
            (error.into(), keys)
        })
    }

    fn impulses(&self) -> Result<Impulses, Blamed> {
        let section = &self.impulses;
        let during = match get(&section.during, DuringKind::Motion) {
            DuringKind::Motion => During::Motion,
            DuringKind::Inertial => During::Inertial,
        };
        let (nu, theta) = (
            get(&section.nu, Number(0.1)).0,
            get(&section.theta, Number(2.0)).0,
        );
        Impulses::new(nu, theta, during).map_err(|error| {
            let key: &[_] = match error {
                ImpulsesError::Nu(_) => &[("impulses", "nu")],
                ImpulsesError::Theta(_) => &[("impulses", "theta")],
            };
            (error.into(), key)
        })
    }

    fn whitening(&self, sensor: &Sensor) -> Result<Whitening, Blamed> {
        let section = &self.whitening;
        let fit = match get(&section.fit, FitKind::LeastSquares) {
            FitKind::LeastSquares => Fit::LeastSquares,
            FitKind::YuleWalker => Fit::YuleWalker,
            FitKind::Burg => Fit::Burg,
            FitKind::Known => Fit::Known,
            FitKind::None => Fit::None,
        };
        let order = get(&section.order, Whole(2)).size();
        let training = get(&section.training, Whole(256)).size();
        let includes_reference = get(&section.includes_reference, false);
        let whitening = Whitening::new(order, fit, training, includes_reference, sensor.ar().len());
        whitening.map_err(|error| {
            let keys: &[_] = match error {
                WhiteningError::NoOrder => &[("whitening", "order")],
                WhiteningError::TrainingTooShort { .. } => &[
                    ("whitening", "training"),
                    ("whitening", "order"),
                    ("whitening", "fit"),
                ],
                WhiteningError::BelowSensor { .. } => &[
                    ("whitening", "order"),
                    ("whitening", "fit"),
                    ("sensor", "ar"),
                ],
            };
            (error.into(), keys)
        })
    }

    fn samples(&self) -> Result<Samples, Blamed> {
        let section = &self.samples;
        let size = |value: &Option<Spanned<Whole>>, default| get(value, Whole(default)).size();
        let samples = Samples::new(
            size(&section.reference, 12),
            size(&section.shift, 12),
            size(&section.scale, 12),
            size(&section.gap, 0),
            size(&section.decimation, 1),
        );
        samples.map_err(|error| {
            let key: &[_] = match error {
                SamplesError::Reference => &[("samples", "reference")],
                SamplesError::Shift => &[("samples", "shift")],
                SamplesError::Scale => &[("samples", "scale")],
                SamplesError::Decimation => &[("samples", "decimation")],
            };
            (error.into(), key)
        })
    }

    fn detector(&self, sensor: &Sensor, noise: Noise) -> Result<Detector, Blamed> {
        let section = &self.detector;
        Ok(Detector {
            alpha: get(&section.alpha, Number(0.01)).0,
            method: self.method(),
            alternative: match get(&section.alternative, AlternativeKind::Greater) {
                AlternativeKind::Greater => Alternative::Greater,
                AlternativeKind::Less => Alternative::Less,
                AlternativeKind::TwoSided => Alternative::TwoSided,
            },
            ties: match get(&section.ties, TiesKind::Random) {
                TiesKind::Random => Ties::Random,
                TiesKind::ByPosition => Ties::ByPosition,
                TiesKind::Strict => Ties::Strict,
            },
            calibration: self.calibration(sensor, noise)?,
            stated: None,
            pilot: 0,
        })
    }

    fn method(&self) -> Method {
        let Some(kind) = self.detector.rule.as_ref().map(Spanned::get_ref) else {
            return Method::Rule(Rule::Product);
        };
        match kind {
            RuleKind::Wilcoxon => Method::Rule(Rule::Wilcoxon),
            RuleKind::Product => Method::Rule(Rule::Product),
            RuleKind::Disjunction => Method::Rule(Rule::Disjunction),
            RuleKind::Conjunction => Method::Rule(Rule::Conjunction),
            RuleKind::Table(entries) => {
                Method::Rule(Rule::Table(entries.iter().map(|c| c.0).collect()))
            }
            RuleKind::LikelihoodRatio => Method::LikelihoodRatio,
            RuleKind::StudentT => Method::Baseline(Baseline::StudentT),
            RuleKind::VarianceRatio => Method::Baseline(Baseline::VarianceRatio),
            RuleKind::BlockMeans => Method::Baseline(Baseline::BlockMeans),
            RuleKind::Clairvoyant => Method::Baseline(Baseline::Clairvoyant),
        }
    }

    fn calibration(&self, own_sensor: &Sensor, own_noise: Noise) -> Result<Calibration, Blamed> {
        let table = match self.detector.calibrate.as_ref().map(Spanned::get_ref) {
            None | Some(CalibrateKind::Promise(false)) => return Ok(Calibration::None),
            Some(CalibrateKind::Promise(true)) => return Ok(Calibration::Promise),
            Some(CalibrateKind::Measured(table)) => table,
        };
        let at_calibrate = |problem| (problem, CALIBRATE_KEYS);
        let named = table.sensor.as_ref().map(sensor).transpose();
        let law = table.law.map(noise).transpose();
        Ok(Calibration::Measured {
            sensor: named
                .map_err(|(problem, _)| at_calibrate(problem))?
                .unwrap_or_else(|| own_sensor.clone()),
            noise: law.map_err(at_calibrate)?.unwrap_or(own_noise),
        })
    }
}

/// What a method asks of the rest of the scenario.
fn check_method(scenario: &Scenario) -> Result<(), Blamed> {
    let (detector, samples) = (&scenario.detector, &scenario.samples);
    let is_calibrated = detector.calibration != Calibration::None;
    let name = detector.method.name();
    if !(detector.alpha > 0.0 && detector.alpha < 1.0) {
        let problem = RegionError::Alpha(detector.alpha).into();
        return Err((problem, &[("detector", "alpha")]));
    }
    if detector.method.states_its_alternative() && !scenario.moves() {
        return Err((Problem::NothingStated(name), RULE_KEYS));
    }
    match detector.method {
        Method::Rule(Rule::Table(_)) if is_calibrated => {
            Err((Problem::TableCalibrated, CALIBRATE_KEYS))
        }
        Method::Baseline(_) if !is_calibrated => Err((Problem::NotCalibrated(name), RULE_KEYS)),
        Method::Baseline(Baseline::Clairvoyant) if samples.decimation() > 1 => Err((
            Problem::ClairvoyantDecimated(samples.decimation()),
            &[("samples", "decimation")],
        )),
        Method::Baseline(Baseline::Clairvoyant) => {
            let (order, rest) = (
                scenario.sensor.ar().len(),
                scenario.whitening.lead() + samples.reference(),
            );
            match order > MOST_CLAIRVOYANT_ORDER || order > rest {
                true => Err((Problem::ClairvoyantOrder(order), SENSOR_KEYS)),
                false => Ok(()),
            }
        }
        Method::Baseline(Baseline::VarianceRatio)
            if samples.reference() < 2 || samples.scale() < 2 =>
        {
            Err((
                Problem::NoVariance,
                &[("samples", "reference"), ("samples", "scale")],
            ))
        }
        Method::Baseline(Baseline::BlockMeans) => {
            let got = scenario.whitening.lead() + samples.reference();
            let needed = samples.shift().saturating_mul(8);
            match got < needed {
                true => Err((Problem::RestTooShort { needed, got }, RULE_KEYS)),
                false => Ok(()),
            }
        }
        _ => Ok(()),
    }
}

fn sensor(section: &SensorSection) -> Result<Sensor, Blamed> {
    let sensor = match (&section.model, &section.ar, &section.transfer) {
        (_, None, None) => Ok(Sensor::adxl105()),
        (None, Some(ar), None) => Sensor::from_ar(ar.get_ref().iter().map(|phi| phi.0).collect()),
        (None, None, Some(transfer)) => {
            let table = transfer.get_ref();
            Sensor::from_transfer(Transfer {
                a: table.a.0,
                b: table.b.0,
                c: table.c.0,
                period: table.period.0,
            })
        }
        (model, ar, transfer) => {
            let given = [model.is_some(), ar.is_some(), transfer.is_some()];
            let count = given.into_iter().filter(|given| *given).count();
            return Err((Problem::SensorTwice(count), SENSOR_KEYS));
        }
    };
    sensor.map_err(|error: SensorError| (error.into(), SENSOR_KEYS))
}

fn noise(law: LawKind) -> Result<Noise, Problem> {
    let law = match law {
        LawKind::Normal => Law::Normal,
        LawKind::Laplace => Law::Laplace,
        LawKind::Logistic => Law::Logistic,
        LawKind::Uniform => Law::Uniform,
        LawKind::Cauchy => Law::Cauchy,
        LawKind::StudentT(freedom) => Law::StudentT(freedom.0),
        LawKind::Contaminated { share, scale } => Law::Contaminated {
            share: share.0,
            scale: scale.0,
        },
    };
    Ok(Noise::new(law)?)
}

/// The clairvoyant's states are counted by 2.4 to the power of the sensor's order.
const MOST_CLAIRVOYANT_ORDER: usize = 6;

const LAW_KEYS: &[(&str, &str)] = &[("noise", "law")];
const RULE_KEYS: &[(&str, &str)] = &[("detector", "rule")];
const CALIBRATE_KEYS: &[(&str, &str)] = &[("detector", "calibrate")];
const SENSOR_KEYS: &[(&str, &str)] = &[
    ("sensor", "ar"),
    ("sensor", "transfer"),
    ("sensor", "model"),
];

fn get<T: Copy>(value: &Option<Spanned<T>>, default: T) -> T {
    value.as_ref().map_or(default, |value| *value.get_ref())
}
