//! The one table of parameters: for each its key in a config, its column in `points.csv`, its place on an
//! axis, and the words that pictures and verdicts have for it.
//!
//! A parameter is a field of a section's type and a line here.

use super::Scenario;
use crate::signal::{Impulses, Motion};
use crate::whiten::Order;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The value of a parameter at a point, as a cell of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// Absent.
    None,
    /// A flag.
    Flag(bool),
    /// A whole number.
    Whole(u64),
    /// A number.
    Number(f64),
    /// Words.
    Text(String),
}

/// A parameter of a scenario.
pub struct Parameter {
    /// Its name on an axis, and the header of its column.
    pub name: &'static str,
    /// The keys that it stands for, as paths.
    pub paths: &'static [&'static str],
    /// What formulas call it; blank for its name.
    pub symbol: &'static str,
    /// What an axis calls it; blank where no axis sweeps it.
    pub axis_label: &'static str,
    /// Its value at a point; none for what has no column of its own.
    pub cell: Option<fn(&Scenario) -> Cell>,
}

/// A parameter with its own column, which an axis may sweep.
const fn row(
    name: &'static str,
    paths: &'static [&'static str],
    symbol: &'static str,
    axis_label: &'static str,
    cell: fn(&Scenario) -> Cell,
) -> Parameter {
    Parameter { name, paths, symbol, axis_label, cell: Some(cell) }
}

/// A parameter with its own column, which no axis sweeps.
const fn fixed(
    name: &'static str,
    paths: &'static [&'static str],
    cell: fn(&Scenario) -> Cell,
) -> Parameter {
    Parameter { name, paths, symbol: "", axis_label: "", cell: Some(cell) }
}

/// Parameters that an axis sweeps together.
const fn together(
    name: &'static str,
    paths: &'static [&'static str],
    symbol: &'static str,
    axis_label: &'static str,
) -> Parameter {
    Parameter { name, paths, symbol, axis_label, cell: None }
}

/// In the order of the columns.
pub const PARAMETERS: &[Parameter] = &[
    row("delta", &["motion.delta"], "Δ/σ_ξ", "Δ/σ_ξ", |s| s.motion.delta.into()),
    row("nu", &["impulses.nu"], "ν", "ν, probability of an impulse per sample", |s| s.impulses.nu().into()),
    row("theta", &["impulses.theta"], "θ/σ_ξ", "θ/σ_ξ", |s| s.impulses.theta().into()),
    fixed("noise", &["noise.law"], |s| Cell::text(s.noise)),
    row("order", &["whitening.order"], "m", "order m of the whitening filter", |s| Cell::order(s.whitening.order())),
    row("training", &["whitening.training"], "", "training length, samples", |s| s.whitening.training().into()),
    row("reference", &["samples.reference"], "N", "N, samples", |s| s.samples.reference().into()),
    row("shift", &["samples.shift"], "M₁", "M_1, samples", |s| s.samples.shift().into()),
    row("scale", &["samples.scale"], "M₂", "M_2, samples", |s| s.samples.scale().into()),
    row("rule", &["detector.rule"], "", "decision rule", |s| Cell::text(&s.detector.method)),
    row("alpha", &["detector.alpha"], "α", "α", |s| s.detector.alpha.into()),
    fixed("alternative", &["detector.alternative"], |s| Cell::text(s.detector.alternative)),
    fixed("sensor", &["sensor.model", "sensor.ar", "sensor.transfer"], |s| Cell::text(&s.sensor)),
    row("quantum", &["noise.quantum"], "", "quantisation step, σ_ξ", |s| s.digitiser.quantum().into()),
    row("range", &["noise.range"], "", "range of the sensor, σ_ξ", |s| s.digitiser.range().into()),
    fixed("fit", &["whitening.fit"], |s| Cell::text(s.whitening.fit())),
    fixed("includes_reference", &["whitening.includes_reference"], |s| Cell::Flag(s.whitening.includes_reference())),
    row("gap", &["samples.gap"], "", "gap, samples", |s| s.samples.gap().into()),
    row("decimation", &["samples.decimation"], "", "decimation, raw observations per sample", |s| s.samples.decimation().into()),
    fixed("delta_at", &["motion.delta_at"], |s| Cell::text(s.motion.delta_at)),
    fixed("profile", &["motion.profile"], |s| Cell::text(s.motion.profile)),
    row("duration", &["motion.duration"], "", "duration of the acceleration, samples", |s| s.motion.duration.into()),
    row("offset", &["motion.offset"], "", "start of the acceleration after X, samples", |s| s.motion.offset.into()),
    fixed("during", &["impulses.during"], |s| Cell::text(s.impulses.during())),
    row("drift", &["rest.drift"], "", "drift, σ_ξ per raw sample", |s| s.disturbance.drift().into()),
    row("swell", &["rest.swell"], "", "deviation of the noise after X, relative to that before", |s| s.disturbance.swell().into()),
    row("footfalls", &["rest.footfalls"], "", "probability of a footfall per raw sample", |s| s.disturbance.footfalls().into()),
    fixed("jolt", &["rest.jolt"], |s| s.disturbance.jolt().into()),
    fixed("ties", &["detector.ties"], |s| Cell::text(s.detector.ties)),
    fixed("calibrate", &["detector.calibrate"], |s| Cell::text(&s.detector.calibration)),
    fixed("stated", &[], |s| Cell::Text(s.detector.stated.map(stated).unwrap_or_default())),
    fixed("pilot", &[], |s| Cell::Whole(s.detector.pilot)),
    together(
        "all_samples",
        &["samples.reference", "samples.shift", "samples.scale"],
        "N = M₁ = M₂",
        "N = M_1 = M_2, samples",
    ),
    together(
        "reference_and_scale",
        &["samples.reference", "samples.scale"],
        "N = M₂",
        "N = M_2, samples",
    ),
];

/// The parameter of a name.
pub fn parameter(name: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.name == name)
}

impl Parameter {
    /// Whether an axis may sweep it.
    pub fn is_swept(&self) -> bool {
        !self.axis_label.is_empty()
    }

    /// The column that has its value: its own, or that of the first of several swept together.
    pub fn column(&self) -> &'static str {
        match self.cell {
            Some(_) => self.name,
            None => self.paths[0].rsplit('.').next().expect("a path has a last part"),
        }
    }
}

impl fmt::Debug for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for Parameter {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// A motion that a method is made for, in words.
fn stated((motion, impulses): (Motion, Impulses)) -> String {
    let (delta, duration, offset) = (motion.delta, motion.duration, motion.offset);
    let (nu, theta, during) = (impulses.nu(), impulses.theta(), impulses.during());
    format!(
        "delta {delta} {} {} duration {duration} offset {offset} nu {nu} theta {theta} {during}",
        motion.delta_at, motion.profile
    )
}

impl Cell {
    fn order(order: Order) -> Self {
        match order {
            Order::Fixed(order) => order.into(),
            Order::Auto => Self::text(order),
        }
    }

    fn text(value: impl fmt::Display) -> Self {
        Self::Text(value.to_string())
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Whole(number) => Some(*number as f64),
            _ => None,
        }
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<usize> for Cell {
    fn from(number: usize) -> Self {
        Self::Whole(number as u64)
    }
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self::None, Self::Number)
    }
}

/// As in a table.
impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => Ok(()),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Whole(number) => write!(f, "{number}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}
