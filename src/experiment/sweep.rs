//! A sweep: an axis, curves, and the scenario of each axis value on each curve, which is file ⊕ curve ⊕ axis.

use super::file::{Experiment, SWEEP};
use super::header::Header;
use super::overlay::{Keys, Overlay};
use crate::claim::{self, Curve, Narrative, Scope};
use crate::config::{Axis, AxisValue, ConfigError, Conflict};
use crate::fields::names;
use crate::rule::OutOfRange;
use crate::scenario::{PARAMETERS, Parameter, Scenario, Sections, parameter};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::error::Error;
use std::path::Path;

/// Groups of alternative keys of the sections. Setting one key of a group replaces the others.
const CHOICES: &[&[&str]] = &[&["sensor.model", "sensor.ar", "sensor.transfer"]];

/// A sweep as its author wrote it.
#[derive(Clone, Debug)]
pub struct SweepConfig {
    /// The curves (at least one) and the axis, to which claims may refer.
    pub scope: Scope,
    /// The texts for the report, and the claims that the sweep tests.
    pub narrative: Narrative,
    experiment: Experiment,
    overlay: Overlay,
}

/// The keys of `[[curve]]` beside the sections.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CurveHeader {
    /// What tells it from the others; by default its number.
    #[serde(rename = "label")]
    #[schemars(with = "Option<String>")]
    _label: Option<IgnoredAny>,
    /// The panel it is drawn in.
    panel: Option<String>,
    /// Its name in the legend, where curves of several panels share it.
    series: Option<String>,
}

/// The error for a config that is not a sweep.
#[derive(Debug, thiserror::Error)]
#[error(
    "[{0}] says what to draw, but nothing is swept here (give a config with [axis], \
     or draw this one with `liftsim sweep`)"
)]
struct NoSweep(&'static str);

impl SweepConfig {
    /// Reads the text of a sweep. Messages call the file `name`.
    ///
    /// # Errors
    /// As [`Experiment::load`] and [`SweepConfig::new`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        Self::new(Experiment::parse(name, text, &[SWEEP])?)
    }

    /// Reads the file of a sweep.
    ///
    /// # Errors
    /// As [`Experiment::load`] and [`SweepConfig::new`].
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::new(Experiment::load(path, &[SWEEP])?)
    }

    /// Reads the sweep of an experiment.
    ///
    /// # Errors
    /// If the experiment is not a sweep, or a curve or a claim is not valid.
    pub fn new(experiment: Experiment) -> Result<Self, ConfigError> {
        if experiment.study() != SWEEP {
            return Err(experiment.refuse(NoSweep(experiment.study())));
        }
        let swept: Vec<_> = (PARAMETERS.iter().filter(|parameter| parameter.is_swept()))
            .map(|parameter| (parameter.name, parameter.paths.to_vec()))
            .collect();
        let keys = Keys {
            prefix: "",
            swept: &swept,
            is_parameter: &|key| names::<Sections>().contains(&key),
            choices: CHOICES,
            name: |label| {
                let is_blank = label.trim().is_empty();
                String::from(if is_blank { "" } else { label })
            },
        };
        let overlay =
            Overlay::read(&experiment.root, &keys).map_err(|error| experiment.conflict(error))?;
        check_order(&overlay.axis).map_err(|error| experiment.conflict(error))?;
        let scope = Scope {
            curves: curves(&experiment, &overlay)?,
            axis: described(&overlay.axis),
        };
        Ok(Self {
            narrative: experiment.narrative(&scope)?,
            scope,
            experiment,
            overlay,
        })
    }

    /// The keys at the top of the config.
    pub fn header(&self) -> &Header {
        &self.experiment.header
    }

    /// The axis: the name and values that are swept.
    pub fn axis(&self) -> &Axis {
        &self.overlay.axis
    }

    /// The parameter that the axis sweeps.
    pub fn parameter(&self) -> &'static Parameter {
        swept(self.axis())
    }

    /// The scenario of `curve` (from 0) at one value of the axis.
    ///
    /// # Errors
    /// If a parameter is out of range or does not fit another.
    pub fn scenario(&self, curve: usize, value: &AxisValue) -> Result<Scenario, ConfigError> {
        let laid = self.overlay.at(curve, value);
        self.experiment.laid_scenario(&laid, &self.axis().span)
    }

    /// Reports a problem of one point that only appears when its region is designed or its record is laid
    /// out.
    pub fn blame(
        &self,
        curve: usize,
        value: &AxisValue,
        keys: &[&str],
        error: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> ConfigError {
        let conflict = Conflict::of(keys.iter().copied(), error);
        let laid = self.overlay.at(curve, value);
        (self.experiment.source).conflict(&laid, conflict, &self.axis().span)
    }
}

fn swept(axis: &Axis) -> &'static Parameter {
    parameter(&axis.name).expect("the axis has been checked")
}

/// Describes the axis in the form to which claims refer.
fn described(axis: &Axis) -> claim::Axis {
    let parameter = swept(axis);
    let values = axis.values.iter();
    claim::Axis {
        name: parameter.name,
        symbol: if parameter.symbol.is_empty() {
            parameter.name
        } else {
            parameter.symbol
        },
        values: values
            .map(|value| (value.to_string(), value.number()))
            .collect(),
    }
}

/// Checks that an axis of orders has only numbers, because "auto" has no position among numbers.
fn check_order(axis: &Axis) -> Result<(), Conflict> {
    let name = axis.values.iter().find(|value| value.number().is_none());
    match name {
        Some(value) if axis.name == "order" => {
            let remedy =
                " (sweep another parameter and give a curve whitening = { order = \"auto\" })";
            let unfit = OutOfRange::new("axis.order", "be whole numbers", value);
            Err(Conflict::at(&axis.span, unfit.explained(remedy)))
        }
        _ => Ok(()),
    }
}

/// Reads the curves and checks that their panels and series are consistent.
fn curves(experiment: &Experiment, overlay: &Overlay) -> Result<Vec<Curve>, ConfigError> {
    let mut curves: Vec<Curve> = Vec::new();
    for (index, laid) in overlay.curves.iter().enumerate() {
        let prefix = format!("curve[{index}]");
        let CurveHeader { panel, series, .. } = experiment.source.read(&laid.header, &prefix)?;
        let refuse = |key: &str, rule: &str, got: &str| {
            let label = laid.header.get("label").map(|label| label.span.clone());
            let unfit = OutOfRange::new(format!("{prefix}.{key}"), rule, got);
            Err(experiment.source.at(label, unfit))
        };
        if let Some(first) = curves.first()
            && first.panel.is_some() != panel.is_some()
        {
            let got = panel.as_deref().unwrap_or("none");
            return refuse("panel", "be named by every curve or by none", got);
        }
        let is_same = |other: &Curve| other.panel == panel && other.series == series;
        if let Some(series) = &series
            && curves.iter().any(is_same)
        {
            return refuse("series", "differ from the others of its panel", series);
        }
        curves.push(Curve {
            label: laid.label.clone(),
            panel,
            series,
        });
    }
    Ok(curves)
}
