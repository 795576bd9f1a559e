//! The experiment as its author wrote it: a config, read strictly.
//!
//! A config is a [`Header`], the claims it tests, the sections of a scenario, and one thing to do: `[axis]` and
//! `[[curve]]` make it a sweep, any other table names its study. Every refusal points at the value to change.

mod header;
mod monitor_options;
pub mod reference;
mod ride;
mod sweep;
mod tables;
#[cfg(test)]
mod tests;
mod trace;

pub use header::{DEFAULT_PILOT_TRIALS, Header, MOST_PILOT_TRIALS};
pub use monitor_options::MonitorOptions;
pub use ride::{Measure, RideCurve, RidePoint, RideStudy};
pub use sweep::{Config, Curve};
pub use tables::{ExhibitKind, Search};
pub use trace::{Part, Trace};

use crate::claim::{Narrative, Scope};
pub use crate::config::{Axis, AxisValue, ConfigError};
use crate::config::{Conflict, Node, Source, Unfit, Value};
use crate::detect::RegionError;
use crate::scenario::{Scenario, ScenarioError, Sections};
use crate::suggest::among;
use std::error::Error;
use std::ops::Range;
use std::path::Path;

/// What a config is for.
#[derive(Clone, Debug)]
pub enum Experiment {
    /// Rates along an axis.
    Sweep(Box<Config>),
    /// Anything else.
    Exhibit(Box<ExhibitConfig>),
}

/// An experiment that is no sweep.
#[derive(Clone, Debug)]
pub struct ExhibitConfig {
    /// What the experiment is for.
    pub question: String,
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials, where the study counts any; else 1.
    pub trials: u64,
    /// Of the intervals.
    pub confidence: f64,
    /// What the sections say, defaults filled in.
    pub scenario: Scenario,
    /// What is drawn.
    pub kind: ExhibitKind,
    /// What the report says of it, and the claims it tests.
    pub narrative: Narrative,
    source: Source,
    table: Range<usize>,
}

/// The names of the sections.
const SECTIONS: [&str; 8] = [
    "sensor",
    "noise",
    "rest",
    "motion",
    "impulses",
    "whitening",
    "samples",
    "detector",
];

/// The keys of what the report says and of the claims.
const NARRATIVE: [&str; 4] = ["title", "text", "order", "claim"];

/// Keys of the sections of which one replaces the others.
const CHOICES: &[&[&str]] = &[&["sensor.model", "sensor.ar", "sensor.transfer"]];

/// Why a config describes no experiment.
#[derive(Debug, thiserror::Error)]
enum ExperimentError {
    #[error("unknown key {0}")]
    Unknown(String),
    #[error(
        "required key `axis` is missing (add what is swept, for instance [axis] delta = [0.0, 1.0], \
         or one table that says what to draw: {0})"
    )]
    NothingToDo(String),
    #[error(
        "[{second}] cannot stand beside [{first}]: a config does one thing (take one of them out)"
    )]
    TwoThingsToDo { first: String, second: String },
    #[error(
        "[{0}] says what to draw, but nothing is swept here (give a config with [axis], \
         or draw this one with `liftsim sweep`)"
    )]
    NoSweep(&'static str),
    #[error("{key} means nothing to [{kind}] (take it out)")]
    Unheeded { key: String, kind: &'static str },
}

/// A config's text, its tree, and what every experiment says.
struct File {
    source: Source,
    root: Node,
    header: Header,
    trials: u64,
}

impl File {
    fn new(source: Source) -> Result<Self, ConfigError> {
        let root = source.parse()?;
        let known = Header::KEYS
            .iter()
            .chain(&NARRATIVE)
            .chain(&["axis", "curve"])
            .chain(&ExhibitKind::NAMES)
            .chain(&SECTIONS)
            .copied();
        let written = root.table().into_iter().flatten();
        let mut strange = written.filter(|(key, _)| !known.clone().any(|known| known == *key));
        if let Some((key, (span, _))) = strange.next() {
            let among = among(&crate::format::shorten(key), known);
            return Err(source.at(Some(span.clone()), ExperimentError::Unknown(among)));
        }
        let header: Header = source.read(&root.only(|key| Header::KEYS.contains(&key)), "")?;
        let trials =
            (header.trials()).map_err(|conflict| source.conflict(&root, conflict, &root.span))?;
        Ok(Self {
            source,
            root,
            header,
            trials,
        })
    }

    /// What the sections of the file say, laid under those of a curve.
    fn sections(&self) -> Node {
        self.root.only(|key| SECTIONS.contains(&key))
    }

    /// What it says for the report and claims, checked against what the claims may refer to.
    fn narrative(&self, scope: &Scope) -> Result<Narrative, ConfigError> {
        let told = self.root.only(|key| NARRATIVE.contains(&key));
        let narrative: Narrative = self.source.read(&told, "")?;
        narrative.check(scope).map_err(|(path, problem)| {
            let conflict = Conflict::of([path.clone()], format!("{path}: {problem}"));
            self.source.conflict(&self.root, conflict, &self.root.span)
        })?;
        Ok(narrative)
    }

    /// The place of a top-level key.
    fn key_span(&self, key: &str) -> Option<Range<usize>> {
        let (span, _) = self.root.table()?.get(key)?;
        Some(span.clone())
    }

    /// The tables that say what to do, in the order of the text.
    fn asked(&self) -> Vec<(&'static str, Range<usize>)> {
        let names = ["axis"].into_iter().chain(ExhibitKind::NAMES);
        let mut asked: Vec<_> = names
            .filter_map(|name| Some((name, self.root.get(name)?.span.clone())))
            .collect();
        // [axis] is the first, wherever it stands.
        asked.sort_by_key(|(name, span)| (*name != "axis", span.start));
        asked
    }
}

/// The scenario that laid sections make.
fn scenario(
    source: &Source,
    laid: &Node,
    pilot: u64,
    otherwise: &Range<usize>,
) -> Result<Scenario, ConfigError> {
    let sections: Sections = source.read(laid, "")?;
    sections.scenario(pilot).map_err(|error: ScenarioError| {
        let conflict = Conflict::of(error.keys().iter().copied(), error);
        source.conflict(laid, conflict, otherwise)
    })
}

impl Experiment {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// As [`Config::load`], where a sweep and another study are asked for at once, or neither.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::from_source(Source::load(path)?)
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`Experiment::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        Self::from_source(Source::new(name, text))
    }

    fn from_source(source: Source) -> Result<Self, ConfigError> {
        let file = File::new(source)?;
        match &file.asked()[..] {
            [] => {
                let known = ExhibitKind::NAMES.map(|name| format!("[{name}]"));
                let error = ExperimentError::NothingToDo(known.join(", "));
                Err(file.source.at(Some(0..1), error))
            }
            [("axis", _)] => Config::new(file).map(|config| Self::Sweep(Box::new(config))),
            [(name, span)] => ExhibitConfig::new(file, name, span.clone())
                .map(|config| Self::Exhibit(Box::new(config))),
            [(first, _), (second, span), ..] => {
                let (first, second) = (first.to_string(), second.to_string());
                let error = ExperimentError::TwoThingsToDo { first, second };
                Err(file.source.at(Some(span.clone()), error))
            }
        }
    }

    /// The same with another number of trials.
    ///
    /// # Errors
    /// Where they are too few for what it draws.
    pub fn with_trials(self, trials: u64) -> Result<Self, ConfigError> {
        Ok(match self {
            Self::Sweep(mut config) => {
                config.trials = trials;
                Self::Sweep(config)
            }
            Self::Exhibit(exhibit) => Self::Exhibit(Box::new(exhibit.with_trials(trials)?)),
        })
    }

    /// The sweep.
    ///
    /// # Errors
    /// Where it is none.
    pub fn sweep(self) -> Result<Config, ConfigError> {
        match self {
            Self::Sweep(config) => Ok(*config),
            Self::Exhibit(exhibit) => {
                let span = Some(exhibit.table.clone());
                Err((exhibit.source).at(span, ExperimentError::NoSweep(exhibit.kind.name())))
            }
        }
    }
}

impl ExhibitConfig {
    fn new(file: File, name: &'static str, table: Range<usize>) -> Result<Self, ConfigError> {
        let (source, root) = (&file.source, &file.root);
        let kind = ExhibitKind::read(name, source, root)?;
        check_heeded(&file, &kind)?;
        let mut sections = file.sections();
        if let ExhibitKind::Trace(trace) = &kind {
            trace.lay_over(&mut sections, &table);
        }
        let scenario = scenario(source, &sections, DEFAULT_PILOT_TRIALS, &table)?;
        kind.check(&scenario)
            .map_err(|conflict| source.conflict(root, conflict, &table))?;
        let narrative = file.narrative(&Scope::default())?;
        let trials = if kind.has_trials() { file.trials } else { 1 };
        let config = Self {
            question: file.header.question.clone(),
            seed: file.header.seed,
            trials: 1,
            confidence: file.header.confidence.get(),
            scenario,
            kind,
            narrative,
            table,
            source: file.source,
        };
        config.with_trials(trials)
    }

    /// The same with another number of trials, where it has any.
    ///
    /// # Errors
    /// Where they are too few.
    pub fn with_trials(self, trials: u64) -> Result<Self, ConfigError> {
        if matches!(self.kind, ExhibitKind::Autocorrelation { .. }) && trials < 2 {
            let remedy = " (one record has no deviation)";
            let unfit = Unfit::new("trials", "be at least 2", trials);
            return Err(self.refuse(Unfit { remedy, ..unfit }));
        }
        let trials = if self.kind.has_trials() { trials } else { 1 };
        Ok(Self { trials, ..self })
    }

    /// A problem that only shows when the study is run.
    pub fn refuse(&self, error: impl Into<Box<dyn Error + Send + Sync>>) -> ConfigError {
        self.source.at(Some(self.table.clone()), error)
    }

    /// A region that cannot be designed.
    pub fn refuse_region(&self, error: RegionError) -> ConfigError {
        self.refuse(ScenarioError::from(error))
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

/// Refuses what stands in the file and means nothing to this kind of study.
fn check_heeded(file: &File, kind: &ExhibitKind) -> Result<(), ConfigError> {
    let of_sweeps = ["curve", "common_random_numbers", "at_rest", "pilot"];
    let of_trials = ["trials", "half_width", "confidence"];
    let of_trials = of_trials.into_iter().filter(|_| !kind.has_trials());
    let keys = of_sweeps.into_iter().chain(of_trials);
    let mut strange = keys
        .filter_map(|key| Some((key.to_owned(), file.root.get(key)?.span.clone())))
        .chain(file.sections().written().into_iter().filter(|(path, _)| {
            let (section, key) = path.split_once('.').unwrap_or((path, ""));
            !kind.heeds(section, key)
        }));
    match strange.next() {
        Some((key, span)) => {
            let span = if key == "curve" {
                file.key_span(&key).unwrap_or(span)
            } else {
                span
            };
            let kind = kind.name();
            Err(file
                .source
                .at(Some(span), ExperimentError::Unheeded { key, kind }))
        }
        None => Ok(()),
    }
}

/// The tables under `curve`; one plain curve where there are none.
fn curve_tables(table: &Node, path: &str) -> Result<Vec<Node>, Conflict> {
    let plain = || Ok(vec![Node::empty(table.span.clone())]);
    let Some((span, node)) = table.table().and_then(|entries| entries.get("curve")) else {
        return plain();
    };
    match &node.value {
        Value::List(list) if list.is_empty() => plain(),
        Value::List(list) => Ok(list.clone()),
        _ => {
            let rule = "be a list (write [[curve]] for [curve])";
            Err(Conflict::at(span, Unfit::new(path, rule, "a single one")))
        }
    }
}
