//! Experiments that are no sweep: one table says what to draw, the usual sections say of what.

use super::Config;
use super::drawing::{self, Refused};
use super::error::Problem;
use super::file::{File, Sections};
use super::ride::{self, RideStudy};
use super::source::{ConfigError, Source};
use super::trace::{self, Trace};
use super::value::Whole;
use crate::chain::Scenario;
use crate::claim::{Narrative, Scope};
use crate::detect::{RegionError, Rule};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// What a config is for.
#[derive(Clone, Debug)]
pub enum Experiment {
    /// Rates along an axis.
    Sweep(Box<Config>),
    /// A picture of something else.
    Exhibit(Box<ExhibitConfig>),
}

/// An experiment that is no sweep.
#[derive(Clone, Debug)]
pub struct ExhibitConfig {
    /// What the experiment is for.
    pub question: String,
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials, where the exhibit counts any; else 1.
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

/// What is drawn, with its own parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum ExhibitKind {
    /// The autocorrelation of the sensor's noise.
    Autocorrelation {
        /// The largest lag.
        lags: usize,
        /// Samples in one record.
        length: usize,
    },
    /// One realisation of a ride.
    Trace(Trace),
    /// Where X, Y₁ and Y₂ lie.
    Layout,
    /// The plane of W and T with the regions of several rules.
    Region {
        /// At least one.
        rules: Vec<Rule>,
    },
    /// Whether W and T are independent, by enumeration.
    Independence {
        /// N, M₁ and M₂, at least once.
        sizes: Vec<[usize; 3]>,
    },
    /// The laws of λ and of S.
    ImpulseLaw {
        /// At least one.
        nu: Vec<f64>,
        /// Samples of one realisation.
        length: usize,
    },
    /// The Δ/σ_ξ at which the power reaches a value.
    OperatingPoint(Search),
    /// Whole rides before the monitor.
    Ride(RideStudy),
}

/// The powers looked for, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// N = M₁ = M₂, at least one.
    pub sizes: Vec<usize>,
    /// At least one.
    pub power: Vec<f64>,
    /// The smallest and the largest Δ/σ_ξ.
    pub delta: [f64; 2],
}

impl Experiment {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// As [`Config::load`], where a sweep and a drawing are asked for at once, or neither.
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
        let file = File::parse(&source)?;
        let axis = file.axis.as_ref().map(|axis| ("axis", axis.span()));
        let asked = file.asked();
        let drawings = asked.iter().map(|asked| (asked.name, asked.table.clone()));
        let things: Vec<_> = axis.into_iter().chain(drawings).collect();
        if let [(first, _), (second, span), ..] = &things[..] {
            let (first, second) = (*first, *second);
            let problem = Problem::TwoThingsToDo { first, second };
            return Err(source.at(Some(span.clone()), problem));
        }
        match (&file.axis, asked.into_iter().next()) {
            (Some(axis), _) => {
                Config::new(source, &file, axis).map(|config| Self::Sweep(Box::new(config)))
            }
            (None, Some(asked)) => ExhibitConfig::new(source, &file, asked)
                .map(|config| Self::Exhibit(Box::new(config))),
            (None, None) => {
                let known = ExhibitKind::NAMES.map(|name| format!("[{name}]"));
                Err(source.at(Some(0..1), Problem::NothingToDo(known.join(", "))))
            }
        }
    }

    /// The same with another number of trials.
    ///
    /// # Errors
    /// Where they are too few for what it draws.
    pub fn with_trials(self, trials: u64) -> Result<Self, ConfigError> {
        Ok(match self {
            Self::Sweep(config) => Self::Sweep(Box::new(Config { trials, ..*config })),
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
                Err((exhibit.source).at(span, Problem::NoSweep(exhibit.kind.name())))
            }
        }
    }
}

/// A drawing table that is there.
struct Asked {
    name: &'static str,
    table: Range<usize>,
    kind: Result<ExhibitKind, Refused>,
}

impl Asked {
    fn new<T>(
        name: &'static str,
        table: &Option<Spanned<T>>,
        kind: impl Fn(&T) -> Result<ExhibitKind, Refused>,
    ) -> Option<Self> {
        let table = table.as_ref()?;
        Some(Self {
            name,
            table: table.span(),
            kind: kind(table.get_ref()),
        })
    }
}

impl File {
    /// The drawing tables that are there, and what each comes to.
    fn asked(&self) -> Vec<Asked> {
        let rules = |table: &_| drawing::rules(table, &self.sections());
        let all = [
            Asked::new(
                "autocorrelation",
                &self.autocorrelation,
                drawing::autocorrelation,
            ),
            Asked::new("trace", &self.trace, trace::trace),
            Asked::new("layout", &self.layout, |_| Ok(ExhibitKind::Layout)),
            Asked::new("region", &self.region, rules),
            Asked::new("independence", &self.independence, drawing::sizes),
            Asked::new("impulse_law", &self.impulse_law, drawing::impulse_law),
            Asked::new("operating_point", &self.operating_point, drawing::search),
            Asked::new("ride", &self.ride, ride::study),
        ];
        all.into_iter().flatten().collect()
    }

    /// What stands in the file and means nothing to this kind of drawing.
    fn check_heeded(&self, kind: &ExhibitKind) -> Result<(), Refused> {
        let curve = (!self.curve.is_empty()).then(|| ("curve".to_owned(), None));
        let of_sweeps = [
            (
                "common_random_numbers",
                self.common_random_numbers.as_ref().map(Spanned::span),
            ),
            ("at_rest", self.at_rest.as_ref().map(Spanned::span)),
            ("pilot", self.pilot.as_ref().map(Spanned::span)),
        ];
        let shared = of_sweeps
            .into_iter()
            .find_map(|(key, span)| Some((key.to_owned(), Some(span?))));
        let trials = [
            ("trials", self.trials.as_ref().map(Spanned::span)),
            ("half_width", self.half_width.as_ref().map(Spanned::span)),
            ("confidence", self.confidence.as_ref().map(Spanned::span)),
        ];
        let trials = trials
            .into_iter()
            .find_map(|(key, span)| Some((key.to_owned(), Some(span?))))
            .filter(|_| !kind.has_trials());
        let sections = self.sections().written();
        let section = sections
            .into_iter()
            .find(|(section, key, _)| !kind.heeds(section, key))
            .map(|(section, key, span)| (format!("{section}.{key}"), Some(span)));
        match curve.or(shared).or(trials).or(section) {
            Some((key, span)) => {
                let kind = kind.name();
                Err((span, Problem::Unheeded { key, kind }))
            }
            None => Ok(()),
        }
    }
}

impl ExhibitConfig {
    fn new(source: Source, file: &File, asked: Asked) -> Result<Self, ConfigError> {
        let Asked { table, kind, .. } = asked;
        let refuse = |(span, problem): Refused| source.at(span.or(Some(table.clone())), problem);
        let kind = kind.map_err(refuse)?;
        file.check_heeded(&kind).map_err(refuse)?;
        let sections = kind.laid_over(file.sections(), &table);
        let scenario = sections
            .resolve()
            .map_err(|(problem, keys)| refuse((sections.first_span(keys), problem)))?;
        kind.check(&scenario, file).map_err(refuse)?;
        let narrative = super::narrative(&source, &Scope::default())?;
        let confidence = file.confidence(&source)?;
        let trials = match kind.has_trials() {
            true => file.trials(&source, confidence)?,
            false => 1,
        };
        let config = Self {
            question: file.question.clone(),
            seed: file.seed.0,
            trials: 1,
            confidence,
            scenario,
            kind,
            narrative,
            source,
            table,
        };
        config.with_trials(trials)
    }

    /// The same with another number of trials, where it has any.
    ///
    /// # Errors
    /// Where they are too few.
    pub fn with_trials(self, trials: u64) -> Result<Self, ConfigError> {
        let kind = self.kind.name();
        if matches!(self.kind, ExhibitKind::Autocorrelation { .. }) && trials < 2 {
            let problem = Problem::DrawingValue {
                kind,
                key: "trials",
                rule: "be at least 2".to_owned(),
                got: trials.to_string(),
                remedy: " (one record has no deviation)",
            };
            return Err(self.refuse(problem));
        }
        let trials = if self.kind.has_trials() { trials } else { 1 };
        Ok(Self { trials, ..self })
    }

    /// A problem that only shows when the drawing is made.
    pub fn refuse(&self, problem: Problem) -> ConfigError {
        self.source.at(Some(self.table.clone()), problem)
    }

    /// A region that cannot be designed.
    pub fn refuse_region(&self, error: RegionError) -> ConfigError {
        self.refuse(error.into())
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

impl ExhibitKind {
    /// The names of the tables.
    pub const NAMES: [&'static str; 8] = [
        "autocorrelation",
        "trace",
        "layout",
        "region",
        "independence",
        "impulse_law",
        "operating_point",
        "ride",
    ];

    /// The name of its table.
    pub fn name(&self) -> &'static str {
        let index = match self {
            Self::Autocorrelation { .. } => 0,
            Self::Trace(_) => 1,
            Self::Layout => 2,
            Self::Region { .. } => 3,
            Self::Independence { .. } => 4,
            Self::ImpulseLaw { .. } => 5,
            Self::OperatingPoint(_) => 6,
            Self::Ride(_) => 7,
        };
        Self::NAMES[index]
    }

    /// Whether it repeats anything.
    pub fn has_trials(&self) -> bool {
        matches!(
            self,
            Self::Autocorrelation { .. }
                | Self::ImpulseLaw { .. }
                | Self::OperatingPoint(_)
                | Self::Ride(_)
        )
    }

    /// Whether a key of the usual sections changes anything in it.
    fn heeds(&self, section: &str, key: &str) -> bool {
        match self {
            Self::Autocorrelation { .. } => section == "sensor" || key == "law",
            Self::Trace(trace) => match section {
                "sensor" | "noise" | "impulses" => true,
                "motion" => !matches!(key, "duration" | "offset"),
                "whitening" | "samples" => trace.whitened && key != "decimation",
                _ => false,
            },
            Self::Layout => match section {
                "motion" => !matches!(key, "delta" | "delta_at"),
                "whitening" => true,
                "samples" => key != "decimation",
                _ => false,
            },
            Self::Region { .. } => match section {
                "samples" => !matches!(key, "gap" | "decimation"),
                "detector" => key != "rule",
                _ => false,
            },
            Self::OperatingPoint(_) => match section {
                "motion" => !matches!(key, "delta" | "duration"),
                "samples" => matches!(key, "gap" | "decimation"),
                "detector" => key != "calibrate",
                _ => true,
            },
            Self::Independence { .. } | Self::ImpulseLaw { .. } | Self::Ride(_) => false,
        }
    }

    /// The sections with what the drawing's own table says put into them: the acceleration of a trace
    /// lasts as long as its phase.
    fn laid_over(&self, mut sections: Sections, table: &Range<usize>) -> Sections {
        if let Self::Trace(trace) = self {
            let accelerated = trace.parts.iter().filter(|part| part.phase.sign() != 0.0);
            let shortest = accelerated.map(|part| part.length as u64).min();
            let duration = Whole(shortest.unwrap_or(1));
            sections.motion.duration = Some(Spanned::new(table.clone(), duration));
        }
        sections
    }

    /// What cannot be seen from the table alone.
    fn check(&self, scenario: &Scenario, file: &File) -> Result<(), Refused> {
        match self {
            Self::Autocorrelation { .. } => drawing::check_law(&file.sections()),
            Self::Trace(trace) if trace.whitened => trace::check_fit(trace, scenario, file),
            Self::Layout => drawing::check_length(scenario),
            _ => Ok(()),
        }
    }
}
