//! The table of parameters: for each the key in a config, the column in `points.csv`, the label on an axis,
//! and the words in pictures and verdicts.
//!
//! A parameter is a field of a section's type and a line here.

use super::Scenario;
use crate::fields::further;
use crate::signal::{Impulses, Motion, Sensor};
use crate::whiten::Order;
use serde::de::{Deserializer, Error, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The value of a parameter at a point, as a cell of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
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

/// The values of all parameters that have a column, by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(Vec<Cell>);

/// A parameter of a scenario.
pub struct Parameter {
    /// The name on an axis and the header of the column.
    pub name: &'static str,
    /// The paths of the keys that it sets.
    pub paths: &'static [&'static str],
    /// The symbol in formulas; blank to use the name.
    pub symbol: &'static str,
    /// The label of an axis; blank if no axis may sweep it.
    pub axis_label: &'static str,
    /// The value at a point; `None` without a column of its own.
    pub cell: Option<fn(&Scenario) -> Cell>,
    /// The part of a caption about it.
    pub caption: Option<Caption>,
}

/// The part of a caption about a parameter.
pub struct Caption {
    /// The position in the caption: smaller comes first.
    pub place: u8,
    /// The words.
    pub words: Words,
    /// The values for which it is left out.
    pub usual: Usual,
}

/// The words for a value.
pub enum Words {
    /// A template in which the value replaces `{}`.
    Template(&'static str),
    /// Words that depend on other values too.
    Of(fn(&Values) -> String),
}

/// The usual values of a parameter, which a caption leaves out.
pub enum Usual {
    /// None: the caption always has it.
    Never,
    /// This value.
    Is(&'static str),
    /// When this holds.
    If(fn(&Values) -> bool),
    /// Any value at rest.
    AtRest,
    /// Any value at rest, and this value.
    AtRestOr(&'static str),
    /// Any value at rest, and values for which this is true.
    AtRestOrIf(fn(&Values) -> bool),
}

use Usual::{AtRest, AtRestOr, AtRestOrIf, If, Is, Never};
use Words::{Of, Template};

/// A parameter with its own column.
const fn column(
    name: &'static str,
    paths: &'static [&'static str],
    cell: fn(&Scenario) -> Cell,
) -> Parameter {
    Parameter {
        name,
        paths,
        symbol: "",
        axis_label: "",
        cell: Some(cell),
        caption: None,
    }
}

/// Parameters that an axis sweeps together.
const fn together(name: &'static str, paths: &'static [&'static str]) -> Parameter {
    Parameter {
        name,
        paths,
        symbol: "",
        axis_label: "",
        cell: None,
        caption: None,
    }
}

impl Parameter {
    /// Lets an axis sweep it.
    const fn axis(mut self, symbol: &'static str, label: &'static str) -> Self {
        self.symbol = symbol;
        self.axis_label = label;
        self
    }

    /// Adds it to captions.
    const fn said(mut self, place: u8, words: Words, usual: Usual) -> Self {
        self.caption = Some(Caption {
            place,
            words,
            usual,
        });
        self
    }
}

/// In the order of the columns.
#[rustfmt::skip]
pub const PARAMETERS: &[Parameter] = &[
    column("delta", &["motion.delta"], |s| s.motion.delta.into())
        .axis("Δ/σ_ξ", "Δ/σ_ξ").said(9, Of(delta), AtRest),
    column("nu", &["impulses.nu"], |s| s.impulses.nu.get().into())
        .axis("ν", "ν, probability of an impulse per sample").said(13, Template("ν = {}"), AtRest),
    column("theta", &["impulses.theta"], |s| s.impulses.theta.get().into())
        .axis("θ/σ_ξ", "θ/σ_ξ").said(14, Template("θ/σ_ξ = {}"), AtRestOrIf(|v| v.number("nu") == 0.0)),
    column("noise", &["noise.law"], |s| Cell::text(s.noise)).said(16, Template("{} noise"), Never),
    column("order", &["whitening.order"], |s| Cell::order(s.whitening.order))
        .axis("m", "order m of the whitening filter").said(26, Template("order {}"), Never),
    column("training", &["whitening.training"], |s| s.whitening.training.into())
        .axis("", "training length, samples").said(27, Template("training {}"), Is("0")),
    column("reference", &["samples.reference"], |s| s.samples.reference().into())
        .axis("N", "N, samples").said(4, Template("N = {}"), Never),
    column("shift", &["samples.shift"], |s| s.samples.shift().into())
        .axis("M₁", "M_1, samples").said(5, Template("M_1 = {}"), Never),
    column("scale", &["samples.scale"], |s| s.samples.scale().into())
        .axis("M₂", "M_2, samples").said(6, Template("M_2 = {}"), Never),
    column("rule", &["detector.rule"], |s| Cell::text(&s.detector.method))
        .axis("", "decision rule").said(2, Of(|v| format!("rule {}", v.rule_name())), Never),
    column("alpha", &["detector.alpha"], |s| s.detector.alpha.into())
        .axis("α", "α").said(1, Template("α = {}"), Never),
    // The counts come here, and columns added later come after them.
    column("alternative", &["detector.alternative"], |s| Cell::text(s.detector.alternative))
        .said(3, Template("alternative {}"), Is("greater")),
    column("sensor", &["sensor.model", "sensor.ar", "sensor.transfer"], |s| Cell::text(&s.sensor))
        .said(17, Template("{}"), If(|v| v.text("sensor") == Sensor::default().to_string())),
    column("quantum", &["noise.quantum"], |s| s.digitiser.quantum().into())
        .axis("", "quantisation step, σ_ξ").said(18, Template("step {} σ_ξ"), Is("")),
    column("range", &["noise.range"], |s| s.digitiser.range().into())
        .axis("", "range of the sensor, σ_ξ").said(19, Template("range {} σ_ξ"), Is("")),
    column("fit", &["whitening.fit"], |s| Cell::text(s.whitening.fit)).said(25, Of(fit), Never),
    column("includes_reference", &["whitening.includes_reference"], |s| Cell::Flag(s.whitening.includes_reference))
        .said(28, Template("X inside the training record"), Is("false")),
    column("gap", &["samples.gap"], |s| s.samples.gap().into())
        .axis("", "gap, samples").said(7, Template("gap {}"), Is("0")),
    column("decimation", &["samples.decimation"], |s| s.samples.decimation().into())
        .axis("", "decimation, raw observations per sample").said(8, Template("means of {}"), Is("1")),
    column("delta_at", &["motion.delta_at"], |s| Cell::text(s.motion.delta_at)),
    column("profile", &["motion.profile"], |s| Cell::text(s.motion.profile))
        .said(10, Template("{}"), AtRestOr("rectangular")),
    column("duration", &["motion.duration"], |s| s.motion.duration.into())
        .axis("", "duration of the acceleration, samples").said(11, Template("duration {}"), AtRestOrIf(Values::acts_through_shift)),
    column("offset", &["motion.offset"], |s| s.motion.offset.into())
        .axis("", "start of the acceleration after X, samples").said(12, Template("offset {}"), AtRestOr("0")),
    column("during", &["impulses.during"], |s| Cell::text(s.impulses.during))
        .said(15, Template("impulses in Y_2 alone"), AtRestOr("motion")),
    column("drift", &["rest.drift"], |s| s.disturbance.drift.get().into())
        .axis("", "drift, σ_ξ per raw sample").said(20, Template("drift {} σ_ξ per sample"), Is("0")),
    column("swell", &["rest.swell"], |s| s.disturbance.swell.get().into())
        .axis("", "deviation of the noise after X, relative to that before")
        .said(21, Template("noise {} times as strong after X"), Is("1")),
    column("footfalls", &["rest.footfalls"], |s| s.disturbance.footfalls.get().into())
        .axis("", "probability of a footfall per raw sample").said(22, Of(footfalls), Is("0")),
    column("jolt", &["rest.jolt"], |s| s.disturbance.jolt.get().into()),
    column("ties", &["detector.ties"], |s| Cell::text(s.detector.ties)).said(23, Template("ties {}"), Is("random")),
    column("calibrate", &["detector.calibrate"], |s| Cell::text(&s.detector.calibration))
        .said(24, Of(calibration), Is("no")),
    column("exceedances", &["detector.exceedances"], |s| Cell::text(s.detector.exceedances))
        .said(3, Template("exceedances of Y_1 and Y_2"), Is("scale")),
    column("stated", &[], |s| s.detector.stated.map_or(Cell::None, stated)),
    column("pilot", &[], |s| Cell::Whole(s.detector.pilot)),
    together("all_samples", &["samples.reference", "samples.shift", "samples.scale"])
        .axis("N = M₁ = M₂", "N = M_1 = M_2, samples"),
    together("reference_and_scale", &["samples.reference", "samples.scale"])
        .axis("N = M₂", "N = M_2, samples"),
];

fn delta(values: &Values) -> String {
    let delta = values.text("delta");
    match values.text("delta_at").as_str() {
        "whitened" => format!("Δ(1 − β)/σ_ξ = {delta}"),
        _ => format!("Δ/σ_ξ = {delta}"),
    }
}

fn fit(values: &Values) -> String {
    match values.text("fit").as_str() {
        "none" => "no whitening".to_owned(),
        fit => format!("{fit} filter"),
    }
}

fn footfalls(values: &Values) -> String {
    let (footfalls, jolt) = (values.text("footfalls"), values.text("jolt"));
    format!("footfalls {footfalls} per sample, of {jolt} σ_ξ")
}

fn calibration(values: &Values) -> String {
    match values.text("calibrate").as_str() {
        "promise" => "calibrated to keep α".to_owned(),
        _ => "threshold set by measured false alarms".to_owned(),
    }
}

impl Values {
    /// The values of a scenario.
    pub fn of(scenario: &Scenario) -> Self {
        Self(
            columns()
                .filter_map(|parameter| parameter.cell)
                .map(|cell| cell(scenario))
                .collect(),
        )
    }

    /// Values that are all absent.
    pub fn unknown() -> Self {
        Self(columns().map(|_| Cell::None).collect())
    }

    /// Sets the value of a column; returns whether there is a column with this name.
    pub fn set(&mut self, name: &str, cell: Cell) -> bool {
        let place = columns().position(|parameter| parameter.name == name);
        if let Some(place) = place {
            self.0[place] = cell;
        }
        place.is_some()
    }

    /// A value; absent for a name without a column.
    pub fn cell(&self, name: &str) -> &Cell {
        let mut all = self.iter();
        all.find(|(known, _)| *known == name)
            .map_or(&Cell::None, |(_, cell)| cell)
    }

    /// A value that is a number; NaN for any other.
    pub fn number(&self, name: &str) -> f64 {
        self.cell(name).number().unwrap_or(f64::NAN)
    }

    /// A value in words.
    pub fn text(&self, name: &str) -> String {
        self.cell(name).to_string()
    }

    /// The rule without its entries.
    pub fn rule_name(&self) -> String {
        let rule = self.text("rule");
        rule.split('(').next().unwrap_or_default().to_owned()
    }

    /// All values in the order of the columns.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Cell)> {
        columns().map(|parameter| parameter.name).zip(&self.0)
    }

    /// Whether Δ acts to the last of Y₁, as it does by default.
    fn acts_through_shift(&self) -> bool {
        let end = self.number("shift") + self.number("gap");
        self.number("duration") == (end - self.number("offset")).max(0.0)
    }
}

/// The parameters that have a column.
pub fn columns() -> impl Iterator<Item = &'static Parameter> {
    PARAMETERS
        .iter()
        .filter(|parameter| parameter.cell.is_some())
}

impl Usual {
    /// Whether a value is usual.
    pub fn holds(&self, value: &str, values: &Values, is_at_rest: bool) -> bool {
        match self {
            Self::Never => false,
            Self::Is(usual) => value == *usual,
            Self::If(holds) => holds(values),
            Self::AtRest => is_at_rest,
            Self::AtRestOr(usual) => is_at_rest || value == *usual,
            Self::AtRestOrIf(holds) => is_at_rest || holds(values),
        }
    }
}

/// The parameter with this name.
pub fn parameter(name: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.name == name)
}

impl Parameter {
    /// Whether an axis may sweep it.
    pub fn is_swept(&self) -> bool {
        !self.axis_label.is_empty()
    }

    /// Whether an axis that sweeps `other` shows this parameter too.
    pub fn is_said_by(&self, other: &Self) -> bool {
        self.paths.iter().any(|path| other.paths.contains(path))
    }

    /// The column with its value: its own, or that of the first parameter swept together with it.
    pub fn column(&self) -> &'static str {
        match self.cell {
            Some(_) => self.name,
            None => self.paths[0]
                .rsplit('.')
                .next()
                .expect("a path has a last part"),
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

/// The stated motion of a method, in words.
fn stated((motion, impulses): (Motion, Impulses)) -> Cell {
    let named = ["delta", "delta_at", "profile", "duration", "offset"];
    let further = further(&motion, &named) + &further(&impulses, &["nu", "theta", "during"]);
    let (delta, duration, offset) = (motion.delta, motion.duration, motion.offset);
    let (nu, theta, during) = (impulses.nu.get(), impulses.theta.get(), impulses.during);
    Cell::text(format_args!(
        "delta {delta} {} {} duration {duration} offset {offset} nu {nu} theta {theta} {during}{further}",
        motion.delta_at, motion.profile
    ))
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

/// Reads the value from a cell of a table.
impl<'de> Deserialize<'de> for Cell {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CellVisitor)
    }
}

struct CellVisitor;

impl Visitor<'_> for CellVisitor {
    type Value = Cell;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a cell")
    }

    fn visit_bool<E: Error>(self, flag: bool) -> Result<Cell, E> {
        Ok(Cell::Flag(flag))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Cell, E> {
        Ok(Cell::Whole(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Cell, E> {
        Ok(Cell::Number(number as f64))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Cell, E> {
        Ok(Cell::Number(number))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Cell, E> {
        Ok(if text.is_empty() {
            Cell::None
        } else {
            Cell::text(text)
        })
    }

    fn visit_unit<E: Error>(self) -> Result<Cell, E> {
        Ok(Cell::None)
    }
}

/// Writes the value as in a table.
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
