//! The experiment as its author wrote it: a TOML file, read strictly.
//!
//! `file` mirrors the file, with the place of every value. A [`Config`] is that file once its
//! parts have been checked against each other; [`Config::scenario`] resolves one point of one curve,
//! by laying the curve over the file's own sections and the axis value over both. Every refusal is a
//! [`ConfigError`] that points at the value to change.

mod axis;
mod drawing;
mod error;
mod exhibit;
mod file;
mod read;
mod resolve;
mod ride;
mod source;
#[cfg(test)]
mod tests;
mod trace;
mod tree;
mod value;
mod watch;

pub use axis::{Axis, AxisValue, Parameter};
pub use error::Problem;
pub use exhibit::{ExhibitConfig, ExhibitKind, Experiment, Search};
pub use read::Refusal;
pub use ride::{Measure, RideCurve, RidePoint, RideProblem, RideStudy};
pub use source::{ConfigError, Source};
pub use trace::{Part, Trace};
pub use tree::{Node, Table, Value};
pub use watch::WatchConfig;

use crate::claim::{self, Narrative, Scope};
use crate::stats::tally;
use file::{AxisTable, File, Sections};
use std::ops::Range;
use std::path::Path;

/// An experiment: what it asks, how often, along which axis, for which curves.
#[derive(Clone, Debug)]
pub struct Config {
    /// What the experiment is for.
    pub question: String,
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Of the intervals.
    pub confidence: f64,
    /// Whether one noise realisation serves every point that can share it.
    pub common_random_numbers: bool,
    /// Trials of each pilot run.
    pub pilot: u64,
    /// Whether only the points at rest are run.
    pub at_rest: bool,
    /// What the x axis sweeps.
    pub axis: Axis,
    /// At least one.
    pub curves: Vec<Curve>,
    /// What the report says of it, and the claims it tests.
    pub narrative: Narrative,
    source: Source,
}

/// One curve: a label and what it changes.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What tells it from the others.
    pub label: String,
    /// The panel it is drawn in.
    pub panel: Option<String>,
    /// Its name in the legend, where curves of several panels share it.
    pub series: Option<String>,
    sections: Sections,
}

impl Config {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// Where it cannot be read, is no TOML, has an unknown key, lacks a required one, or holds a
    /// value of the wrong kind or range; where it sweeps nothing.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Experiment::load(path)?.sweep()
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`Config::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        Experiment::parse(name, text)?.sweep()
    }

    /// Checks the file of a sweep, whose axis is `axis`.
    fn new(source: Source, file: &File, axis: &AxisTable) -> Result<Self, ConfigError> {
        let axis = Axis::new(axis).map_err(|(span, problem)| source.at(span, problem))?;
        let confidence = file.confidence(&source)?;
        let trials = file.trials(&source, confidence)?;
        let base = file.sections();
        let mut curves: Vec<Curve> = Vec::new();
        for (index, curve) in file.curves().iter().enumerate() {
            let fixed = |sections: &Sections| sections.first_span(axis.parameter.keys());
            if let Some(span) = fixed(&base).or(fixed(&curve.sections())) {
                let name = axis.parameter.name();
                return Err(source.at(Some(span), Problem::FixedAndSwept(name)));
            }
            let given = curve.label.as_ref();
            let label = given.map_or((index + 1).to_string(), |label| label.get_ref().clone());
            if label.trim().is_empty() || curves.iter().any(|other| other.label == label) {
                let span = given.map(toml::Spanned::span);
                return Err(source.at(span, Problem::Label(label)));
            }
            curves.push(Curve {
                label,
                panel: curve.panel.clone(),
                series: curve.series.clone(),
                sections: curve.sections().over(&base),
            });
        }
        check_panels(file, &curves, &source)?;
        let narrative = narrative(&source, &scope(&axis, &curves))?;
        Ok(Self {
            question: file.question.clone(),
            seed: file.seed.0,
            trials,
            confidence,
            common_random_numbers: (file.common_random_numbers.as_ref())
                .is_none_or(|shared| *shared.get_ref()),
            at_rest: (file.at_rest.as_ref()).is_some_and(|at_rest| *at_rest.get_ref()),
            pilot: file.pilot(&source)?,
            axis,
            curves,
            narrative,
            source,
        })
    }

    /// What its claims may refer to.
    pub fn scope(&self) -> Scope {
        scope(&self.axis, &self.curves)
    }

    /// The file's text.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// What messages call the file.
    pub fn name(&self) -> &str {
        self.source.name()
    }
}

fn scope(axis: &Axis, curves: &[Curve]) -> Scope {
    let curve = |curve: &Curve| claim::Curve {
        label: curve.label.clone(),
        panel: curve.panel.clone(),
        series: curve.series.clone(),
    };
    Scope {
        curves: curves.iter().map(curve).collect(),
        axis: claim::Axis {
            name: axis.parameter.name(),
            symbol: axis.parameter.symbol(),
            values: (axis.values.iter())
                .map(|value| (value.to_string(), value.number()))
                .collect(),
        },
    }
}

/// What a config says for the report and claims, checked against what the claims may refer to.
fn narrative(source: &Source, scope: &Scope) -> Result<Narrative, ConfigError> {
    let root = source.parse()?;
    let of_report = root.only(|key| ["title", "text", "order", "claim"].contains(&key));
    let narrative: Narrative = source.read(&of_report, "")?;
    narrative.check(scope).map_err(|(path, problem)| {
        let span = root.get(&path).map(|node| node.span.clone());
        source.at(span, format!("{path}: {problem}"))
    })?;
    Ok(narrative)
}

/// Panels are for all curves or for none, and a series is drawn once in each.
fn check_panels(file: &File, curves: &[Curve], source: &Source) -> Result<(), ConfigError> {
    for (index, curve) in curves.iter().enumerate() {
        let before = &curves[..index];
        let is_same = |other: &Curve| other.panel == curve.panel && other.series == curve.series;
        let problem = if curve.panel.is_some() != curves[0].panel.is_some() {
            Problem::PanelMissing
        } else if curve.series.is_some() && before.iter().any(is_same) {
            Problem::SeriesTwice(curve.series.clone().unwrap_or_default())
        } else {
            continue;
        };
        let tables = file.curves();
        let span = tables[index].label.as_ref().map(toml::Spanned::span);
        return Err(source.at(span, problem));
    }
    Ok(())
}

impl File {
    fn confidence(&self, source: &Source) -> Result<f64, ConfigError> {
        let Some(given) = &self.confidence else {
            return Ok(0.95);
        };
        let value = given.get_ref().0;
        match value > 0.0 && value < 1.0 {
            true => Ok(value),
            false => Err(source.at(Some(given.span()), Problem::Confidence(value))),
        }
    }

    fn pilot(&self, source: &Source) -> Result<u64, ConfigError> {
        let Some(given) = &self.pilot else {
            return Ok(DEFAULT_PILOT_TRIALS);
        };
        match given.get_ref().0 {
            value @ 1..=MOST_PILOT_TRIALS => Ok(value),
            value => Err(source.at(Some(given.span()), Problem::Pilot(value))),
        }
    }

    fn trials(&self, source: &Source, confidence: f64) -> Result<u64, ConfigError> {
        let refuse = |span: Range<usize>, problem| Err(source.at(Some(span), problem));
        match (&self.trials, &self.half_width) {
            (Some(_), Some(half_width)) => refuse(half_width.span(), Problem::TrialsTwice),
            (Some(trials), None) if trials.get_ref().0 == 0 => {
                refuse(trials.span(), Problem::NoTrials)
            }
            (Some(trials), None) if trials.get_ref().0 > tally::MOST_TRIALS => {
                refuse(trials.span(), Problem::TooManyTrials(trials.get_ref().0))
            }
            (Some(trials), None) => Ok(trials.get_ref().0),
            (None, Some(half_width)) => {
                let value = half_width.get_ref().0;
                match (1e-5..0.5).contains(&value) {
                    true => Ok(tally::trials_for_half_width(value, confidence)),
                    false => refuse(half_width.span(), Problem::HalfWidth(value)),
                }
            }
            (None, None) => Ok(DEFAULT_TRIALS),
        }
    }
}

/// Trials per point where the file says nothing.
const DEFAULT_TRIALS: u64 = 200_000;

/// Trials of a pilot run where neither the file nor the command line says anything.
pub const DEFAULT_PILOT_TRIALS: u64 = 200_000;

/// A pilot keeps what it has seen in memory.
pub const MOST_PILOT_TRIALS: u64 = 10_000_000;
