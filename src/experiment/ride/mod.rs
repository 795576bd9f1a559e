//! `[ride]`: whole simulated rides before the monitor, counted along an axis for several curves.
//!
//! Accelerations are in m/s², times in s. What stands for the strength of the noise is one of three keys:
//! `sigma`, the deviation of a sample; `density`, the one-sided root density of the noise in m/s²/√Hz, which is
//! what a sensor has whatever it is sampled at, so that sigma = density √(rate/2); `delta_over_sigma`, the
//! drive's acceleration in units of sigma. Vibration, θ, quantum and jolt are in units of sigma.

mod keys;
mod point;
mod problem;
#[cfg(test)]
mod tests;

pub use point::RidePoint;
pub use problem::RideProblem;

pub(super) use keys::RideTable;

use super::axis::{self, AxisValue};
use super::drawing::Refused;
use super::error::{Problem, Refusal};
use super::exhibit::ExhibitKind;
use keys::{CurveTable, RideKeys, STRENGTH};
use serde::Deserialize;
use std::ops::Range;

/// What is asked of each trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// A ride: are its trips found, and how late?
    Rides,
    /// A rest: how often does it look like motion?
    Rest,
    /// A ride and a rest: what does finding soon cost?
    Tradeoff,
    /// A ride whose last trip jams: does it alarm, and how late?
    Jam,
    /// A ride that the monitor sees from somewhere in its first uniform motion on: does it take that for
    /// rest, and when does it know better?
    SwitchedOn,
}

/// Rides along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct RideStudy {
    /// What is asked of each trial.
    pub measure: Measure,
    /// The key that is swept.
    pub axis: &'static str,
    /// At least one.
    pub curves: Vec<RideCurve>,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct RideCurve {
    /// What tells it from the others.
    pub label: String,
    /// Each value of the axis and what it comes to here.
    pub points: Vec<(f64, RidePoint)>,
}

/// More trips than anyone needs in a ride.
const MOST_TRIPS: usize = 100;

impl Measure {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rides => "rides",
            Self::Rest => "rest",
            Self::Tradeoff => "tradeoff",
            Self::Jam => "jam",
            Self::SwitchedOn => "switched_on",
        }
    }

    /// Whether it makes trips.
    pub fn rides(self) -> bool {
        self != Self::Rest
    }

    /// Whether it rests for a given time.
    pub fn rests(self) -> bool {
        matches!(self, Self::Rest | Self::Tradeoff)
    }

    /// The keys that change nothing in it.
    fn unheeded(self) -> &'static [&'static str] {
        match self {
            Self::Rides => &["length", "jam_within"],
            Self::Rest => &[
                "distance",
                "speed",
                "jerk",
                "trips",
                "rest",
                "jam_within",
                "tolerance",
                "vibration",
                "nu",
                "theta",
            ],
            Self::Tradeoff => &["jam_within"],
            Self::Jam => &["length"],
            Self::SwitchedOn => &["length", "jam_within"],
        }
    }

    fn check_heeded(self, keys: &RideKeys) -> Result<(), Refused> {
        let mut written = keys.written().into_iter();
        match written.find(|(key, _)| self.unheeded().contains(key)) {
            Some((key, span)) => {
                let measure = self;
                Err((Some(span), RideProblem::Unheeded { key, measure }.into()))
            }
            None => Ok(()),
        }
    }
}

/// The axis and where it stands.
struct Axis {
    name: &'static str,
    values: Vec<AxisValue>,
    span: Range<usize>,
}

/// What the table comes to.
pub(super) fn study(table: &RideTable) -> Result<ExhibitKind, Refused> {
    let (measure, base) = (table.measure, table.keys());
    let axis = Axis::new(table)?;
    axis.check_free(&base)?;
    measure.check_heeded(&base)?;
    let mut curves: Vec<RideCurve> = Vec::new();
    for (index, curve) in tables(table).iter().enumerate() {
        let keys = curve.keys();
        axis.check_free(&keys)?;
        measure.check_heeded(&keys)?;
        let label = label(curve, index, &curves)?;
        let points = axis.points(measure, &keys.laid_over(&base))?;
        curves.push(RideCurve { label, points });
    }
    Ok(ExhibitKind::Ride(RideStudy {
        measure,
        axis: axis.name,
        curves,
    }))
}

/// The curves, or the one that a table without any stands for.
fn tables(table: &RideTable) -> Vec<CurveTable> {
    match table.curve.is_empty() {
        true => vec![CurveTable::default()],
        false => table.curve.clone(),
    }
}

/// A label of its own, also when it is part of a quantity's name.
fn label(table: &CurveTable, index: usize, before: &[RideCurve]) -> Result<String, Refused> {
    let given = table.label.as_ref();
    let label = given.map_or((index + 1).to_string(), |label| label.get_ref().clone());
    let name = RideCurve::name_of(&label);
    let is_taken = before.iter().any(|other| other.name() == name);
    match name.is_empty() || is_taken {
        true => Err((given.map(toml::Spanned::span), Problem::Label(label))),
        false => Ok(label),
    }
}

impl RideCurve {
    /// Its label as part of a quantity's name: letters and digits, `_` for anything between.
    pub fn name(&self) -> String {
        Self::name_of(&self.label)
    }

    fn name_of(label: &str) -> String {
        let lower = label.to_lowercase();
        let words = lower.split(|c: char| !c.is_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        words.join("_")
    }
}

impl Axis {
    fn new(table: &RideTable) -> Result<Self, Refused> {
        let (key, value) = axis::only(&table.axis)?;
        let known = RideKeys::NAMES.iter().copied();
        let Some(name) = known.clone().find(|name| name == key.get_ref()) else {
            return Err(axis::unknown(key, known));
        };
        if table.measure.unheeded().contains(&name) {
            let measure = table.measure;
            let problem = RideProblem::Unheeded { key: name, measure };
            return Err((Some(key.span()), problem.into()));
        }
        let span = value.span();
        let values =
            axis::values(name, value.get_ref()).map_err(|problem| (Some(span.clone()), problem))?;
        Ok(Self { name, values, span })
    }

    /// What is swept must not be set as well.
    fn check_free(&self, keys: &RideKeys) -> Result<(), Refused> {
        let rivals: &[&str] = match STRENGTH.contains(&self.name) {
            true => &STRENGTH,
            false => &[self.name],
        };
        match rivals.iter().find_map(|key| keys.span(key)) {
            Some(span) => Err((Some(span), Problem::FixedAndSwept(self.name))),
            None => Ok(()),
        }
    }

    /// What each value comes to.
    fn points(&self, measure: Measure, keys: &RideKeys) -> Result<Vec<(f64, RidePoint)>, Refused> {
        let at = |problem: Problem| (Some(self.span.clone()), problem);
        let point = |value: &AxisValue| {
            let no_number = || at(RideProblem::NoNumber(self.name).into());
            let number = value.number().ok_or_else(no_number)?;
            let mut keys = keys.clone();
            let set = keys.set(self.name, value.written(), self.span.clone());
            set.map_err(|error| {
                at(Problem::AxisValue {
                    name: self.name,
                    refusal: Refusal::new("", error),
                })
            })?;
            let point = RidePoint::new(measure, &keys);
            let point = point.map_err(|problem| (keys.blamed(&problem), problem.into()))?;
            Ok((number, point))
        };
        self.values.iter().map(point).collect()
    }
}

impl RideKeys {
    /// Where the value stands that a problem is about: most begin with its key.
    fn blamed(&self, problem: &RideProblem) -> Option<Range<usize>> {
        let words = problem.to_string();
        let mut words = words.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let key = match problem {
            RideProblem::Settings(error) => error.key(),
            _ => words.next().unwrap_or_default(),
        };
        let rivals: &[&str] = match STRENGTH.contains(&key) {
            true => &STRENGTH,
            false => &[key],
        };
        rivals.iter().find_map(|key| self.span(key))
    }
}
