//! A sweep: an axis, curves, and the scenario of each value on each curve: file ⊕ curve ⊕ axis.

use super::{CHOICES, Experiment, File, SECTIONS, curve_tables, scenario};
use crate::claim::{self, Narrative, Scope};
use crate::config::{Axis, AxisValue, ConfigError, Conflict, Node, Source, Unfit};
use crate::scenario::{PARAMETERS, Parameter, Scenario, parameter};
use schemars::JsonSchema;
use serde::Deserialize;
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
    /// The file's sections with its own laid over them.
    sections: Node,
}

/// The keys of `[[curve]]` beside the sections.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CurveHeader {
    /// What tells it from the others; by default its number.
    label: Option<String>,
    /// The panel it is drawn in.
    panel: Option<String>,
    /// Its name in the legend, where curves of several panels share it.
    series: Option<String>,
}

/// More curves than this are a mistake.
const MOST_CURVES: usize = 1000;

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

    pub(super) fn new(file: File) -> Result<Self, ConfigError> {
        let (source, root) = (&file.source, &file.root);
        let refused = |conflict| source.conflict(root, conflict, &root.span);
        let swept = PARAMETERS.iter().filter(|p| p.is_swept()).map(|p| p.name);
        let axis = root.get("axis").expect("it is asked for");
        let axis = Axis::read(axis, swept).map_err(refused)?;
        check_order(&axis).map_err(refused)?;
        let curves = curves(&file, &axis)?;
        let narrative = file.narrative(&scope(&axis, &curves))?;
        Ok(Self {
            question: file.header.question.clone(),
            seed: file.header.seed,
            trials: file.trials,
            confidence: file.header.confidence.get(),
            common_random_numbers: file.header.common_random_numbers,
            at_rest: file.header.at_rest,
            pilot: file.header.pilot,
            axis,
            curves,
            narrative,
            source: file.source,
        })
    }

    /// What the axis sweeps.
    pub fn parameter(&self) -> &'static Parameter {
        parameter(&self.axis.name).expect("the axis has been checked")
    }

    /// What its claims may refer to.
    pub fn scope(&self) -> Scope {
        scope(&self.axis, &self.curves)
    }

    /// The scenario of `curve` (from 0) at one value of the axis.
    ///
    /// # Errors
    /// Where a parameter is out of range or does not fit another.
    pub fn scenario(&self, curve: usize, value: &AxisValue) -> Result<Scenario, ConfigError> {
        scenario(
            &self.source,
            &self.laid(curve, value),
            self.pilot,
            &self.axis.span,
        )
    }

    /// The sections of a curve with a value of the axis laid over them.
    fn laid(&self, curve: usize, value: &AxisValue) -> Node {
        let mut laid = self.curves[curve].sections.clone();
        for path in self.parameter().paths {
            laid.set(path, value.0.clone());
        }
        laid
    }

    /// A problem of one point that only shows when its region is designed or its record laid out.
    pub fn blame(
        &self,
        curve: usize,
        value: &AxisValue,
        keys: &[&str],
        error: impl Into<Box<dyn std::error::Error + Send + Sync>>,
    ) -> ConfigError {
        let conflict = Conflict::of(keys.iter().copied(), error);
        (self.source).conflict(&self.laid(curve, value), conflict, &self.axis.span)
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
    let parameter = parameter(&axis.name).expect("the axis has been checked");
    let curve = |curve: &Curve| claim::Curve {
        label: curve.label.clone(),
        panel: curve.panel.clone(),
        series: curve.series.clone(),
    };
    let values = axis
        .values
        .iter()
        .map(|value| (value.to_string(), value.number()));
    Scope {
        curves: curves.iter().map(curve).collect(),
        axis: claim::Axis {
            name: parameter.name,
            symbol: if parameter.symbol.is_empty() {
                parameter.name
            } else {
                parameter.symbol
            },
            values: values.collect(),
        },
    }
}

/// An axis of orders has numbers alone, since "auto" would stand nowhere among them.
fn check_order(axis: &Axis) -> Result<(), Conflict> {
    let name = axis.values.iter().find(|value| value.number().is_none());
    match name {
        Some(value) if axis.name == "order" => {
            let remedy =
                " (sweep another parameter and give a curve whitening = { order = \"auto\" })";
            let unfit = Unfit::new("axis.order", "be whole numbers", value);
            Err(Conflict::at(&axis.span, Unfit { remedy, ..unfit }))
        }
        _ => Ok(()),
    }
}

fn curves(file: &File, axis: &Axis) -> Result<Vec<Curve>, ConfigError> {
    let (source, root) = (&file.source, &file.root);
    let base = file.sections();
    check_free(source, &base, axis)?;
    let tables = curve_tables(root, "curve")
        .map_err(|conflict| source.conflict(root, conflict, &root.span))?;
    if tables.len() > MOST_CURVES {
        let rule = format!("be at most {MOST_CURVES} curves");
        let span = root.get("curve").map(|list| list.span.clone());
        return Err(source.at(span, Unfit::new("curve", rule, tables.len())));
    }
    let mut curves: Vec<Curve> = Vec::new();
    for (index, table) in tables.iter().enumerate() {
        let prefix = format!("curve[{index}]");
        let header = table.only(|key| !SECTIONS.contains(&key));
        let header: CurveHeader = source.read(&header, &prefix)?;
        let own = table.only(|key| SECTIONS.contains(&key));
        check_free(source, &own, axis)?;
        let label = header.label.unwrap_or((index + 1).to_string());
        let refuse = |path: &str, rule: &str, got: &str| {
            let path = format!("{prefix}.{path}");
            let span = table.get("label").map(|label| label.span.clone());
            Err(source.at(span, Unfit::new(path, rule, got)))
        };
        if label.trim().is_empty() || curves.iter().any(|other| other.label == label) {
            return refuse(
                "label",
                "be there and differ from every other",
                &format!("\"{label}\""),
            );
        }
        let curve = Curve {
            label,
            panel: header.panel,
            series: header.series,
            sections: own.over(&base, CHOICES),
        };
        let first = curves.first().unwrap_or(&curve);
        if curve.panel.is_some() != first.panel.is_some() {
            return refuse(
                "panel",
                "be named by every curve or by none",
                curve.panel.as_deref().unwrap_or("none"),
            );
        }
        let is_same = |other: &Curve| other.panel == curve.panel && other.series == curve.series;
        if let Some(series) = curve
            .series
            .as_deref()
            .filter(|_| curves.iter().any(is_same))
        {
            return refuse("series", "differ from the others of its panel", series);
        }
        curves.push(curve);
    }
    Ok(curves)
}

/// What is swept must not be set as well.
fn check_free(source: &Source, sections: &Node, axis: &Axis) -> Result<(), ConfigError> {
    let parameter = parameter(&axis.name).expect("the axis has been checked");
    let set = parameter.paths.iter().find_map(|path| sections.get(path));
    match set {
        Some(node) => Err(source.at(Some(node.span.clone()), axis.swept_and_set())),
        None => Ok(()),
    }
}
