//! Experiments that are no sweep: one table says what to draw, the usual sections say of what.

use super::Config;
use super::drawing::{
    AutocorrelationTable, ImpulseLawTable, IndependenceTable, PhaseTable, RegionTable, TraceTable,
};
use super::error::{ConfigError, Problem, Source};
use super::file::{File, LawKind, Sections};
use super::value::{Number, Whole};
use crate::chain::Scenario;
use crate::detect::{RegionError, Rule, Samples};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// What a config is for.
#[derive(Clone, Debug)]
pub enum Experiment {
    /// Rates along an axis.
    Sweep(Config),
    /// A picture of something else.
    Exhibit(ExhibitConfig),
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
}

/// A ride and how it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// In the order of time.
    pub phases: Vec<Phase>,
    /// Samples per second.
    pub rate: f64,
    /// σ_ξ in `unit`.
    pub sigma: f64,
    /// Of the record.
    pub unit: String,
    /// Deviation of the vibration, white noise added in motion, in σ_ξ.
    pub vibration: f64,
    /// Whether the record is also shown after whitening, with X, Y₁ and Y₂ marked.
    pub whitened: bool,
    /// The first sample in the picture.
    pub drawn_from: usize,
}

/// A part of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phase {
    /// What the cage does.
    pub kind: PhaseKind,
    /// For how many samples.
    pub length: usize,
}

/// What the cage does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhaseKind {
    /// It stands.
    Rest,
    /// It gains speed: Δ acts.
    Acceleration,
    /// It moves by itself.
    Inertial,
    /// It loses speed: −Δ acts.
    Braking,
}

/// Most samples in one realisation.
const LONGEST: usize = 1_000_000;
/// Most assignments of ranks that an enumeration may take; their square is exact in an f64.
const MOST_ASSIGNMENTS: u128 = 50_000_000;

/// A problem and where it stands, if anywhere but the whole table.
type Refused = (Option<Range<usize>>, Problem);

impl Experiment {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// As [`Config::load`], where a sweep and a drawing are asked for at once, or neither.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        match std::fs::read_to_string(path) {
            Ok(text) => Self::parse(&name, &text),
            Err(error) => Err(Source::new(&name, "").at(None, Problem::Unreadable(error))),
        }
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`Experiment::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        let source = Source::new(name, text);
        let file = File::parse(&source)?;
        let tables = file.tables();
        if let [(first, _), (second, span), ..] = &tables[..] {
            let (first, second) = (*first, *second);
            let problem = Problem::TwoThingsToDo { first, second };
            return Err(source.at(Some(span.clone()), problem));
        }
        match (&file.axis, tables.first()) {
            (Some(axis), _) => Config::new(source, &file, axis).map(Self::Sweep),
            (None, Some((_, span))) => {
                ExhibitConfig::new(source, &file, span.clone()).map(Self::Exhibit)
            }
            (None, None) => {
                let known = ExhibitKind::NAMES.map(|name| format!("[{name}]"));
                Err(source.at(Some(0..1), Problem::NothingToDo(known.join(", "))))
            }
        }
    }

    /// The sweep.
    ///
    /// # Errors
    /// Where it is none.
    pub fn sweep(self) -> Result<Config, ConfigError> {
        match self {
            Self::Sweep(config) => Ok(config),
            Self::Exhibit(exhibit) => {
                let span = Some(exhibit.table.clone());
                Err((exhibit.source).at(span, Problem::NoSweep(exhibit.kind.name())))
            }
        }
    }
}

impl File {
    /// The axis and the drawing tables that are there, each with its place.
    fn tables(&self) -> Vec<(&'static str, Range<usize>)> {
        let all = [
            ("axis", self.axis.as_ref().map(Spanned::span)),
            (
                "autocorrelation",
                self.autocorrelation.as_ref().map(Spanned::span),
            ),
            ("trace", self.trace.as_ref().map(Spanned::span)),
            ("layout", self.layout.as_ref().map(Spanned::span)),
            ("region", self.region.as_ref().map(Spanned::span)),
            (
                "independence",
                self.independence.as_ref().map(Spanned::span),
            ),
            ("impulse_law", self.impulse_law.as_ref().map(Spanned::span)),
        ];
        let there = all.into_iter();
        there
            .filter_map(|(name, span)| Some((name, span?)))
            .collect()
    }

    /// What is drawn, of a file that says so.
    fn kind(&self) -> Result<ExhibitKind, Refused> {
        if let Some(table) = &self.autocorrelation {
            return autocorrelation(table.get_ref());
        }
        if let Some(table) = &self.trace {
            return trace(table.get_ref()).map(ExhibitKind::Trace);
        }
        if let Some(table) = &self.region {
            return rules(table.get_ref(), &self.sections());
        }
        if let Some(table) = &self.independence {
            return sizes(table.get_ref());
        }
        match &self.impulse_law {
            Some(table) => impulse_law(table.get_ref()),
            None => Ok(ExhibitKind::Layout),
        }
    }

    /// What stands in the file and means nothing to this kind of drawing.
    fn check_heeded(&self, kind: &ExhibitKind) -> Result<(), Refused> {
        let curve = (!self.curve.is_empty()).then(|| ("curve".to_owned(), None));
        let shared = (self.common_random_numbers.as_ref())
            .map(|value| ("common_random_numbers".to_owned(), Some(value.span())));
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
    fn new(source: Source, file: &File, table: Range<usize>) -> Result<Self, ConfigError> {
        let refuse = |(span, problem): Refused| source.at(span.or(Some(table.clone())), problem);
        let kind = file.kind().map_err(refuse)?;
        file.check_heeded(&kind).map_err(refuse)?;
        let sections = kind.laid_over(file.sections(), &table);
        let scenario = sections
            .resolve()
            .map_err(|(problem, keys)| refuse((sections.first_span(keys), problem)))?;
        kind.check(&scenario, file).map_err(refuse)?;
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
    pub const NAMES: [&'static str; 6] = [
        "autocorrelation",
        "trace",
        "layout",
        "region",
        "independence",
        "impulse_law",
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
        };
        Self::NAMES[index]
    }

    /// Whether it repeats anything.
    pub fn has_trials(&self) -> bool {
        matches!(self, Self::Autocorrelation { .. } | Self::ImpulseLaw { .. })
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
            Self::Independence { .. } | Self::ImpulseLaw { .. } => false,
        }
    }

    /// The sections with what the drawing's own table says put into them: the acceleration of a trace
    /// lasts as long as its phase.
    fn laid_over(&self, mut sections: Sections, table: &Range<usize>) -> Sections {
        if let Self::Trace(trace) = self {
            let accelerated = trace.phases.iter().filter(|phase| phase.kind.sign() != 0.0);
            let shortest = accelerated.map(|phase| phase.length as u64).min();
            let duration = Whole(shortest.unwrap_or(1));
            sections.motion.duration = Some(Spanned::new(table.clone(), duration));
        }
        sections
    }

    /// What cannot be seen from the table alone.
    fn check(&self, scenario: &Scenario, file: &File) -> Result<(), Refused> {
        match self {
            Self::Autocorrelation { .. } => check_law(&file.sections()),
            Self::Trace(trace) if trace.whitened => check_fit(trace, scenario, file),
            _ => Ok(()),
        }
    }
}

impl PhaseKind {
    /// Whether the cage moves.
    pub fn moves(self) -> bool {
        self != Self::Rest
    }

    /// Of Δ: 1, 0 or −1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Acceleration => 1.0,
            Self::Braking => -1.0,
            Self::Rest | Self::Inertial => 0.0,
        }
    }

    /// As in a config and in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Acceleration => "acceleration",
            Self::Inertial => "inertial",
            Self::Braking => "braking",
        }
    }
}

impl Trace {
    /// Samples of the whole ride.
    pub fn length(&self) -> usize {
        self.phases.iter().map(|phase| phase.length).sum()
    }

    /// Where the first of X lies: X ends where the first acceleration starts. `None` where there is
    /// no acceleration, or not enough of a record before it.
    pub fn reference_start(&self, samples: &Samples) -> Option<usize> {
        self.acceleration_start()?.checked_sub(samples.reference())
    }

    fn acceleration_start(&self) -> Option<usize> {
        let mut phases = self.phases.iter();
        let first = phases.position(|phase| phase.kind == PhaseKind::Acceleration)?;
        Some(self.phases[..first].iter().map(|phase| phase.length).sum())
    }
}

fn autocorrelation(table: &AutocorrelationTable) -> Result<ExhibitKind, Refused> {
    const KIND: &str = "autocorrelation";
    let length = whole(KIND, "length", &table.length, 4096, 2..=LONGEST)?;
    let lags = whole(KIND, "lags", &table.lags, 40, 1..=length.min(10_000) - 1)?;
    Ok(ExhibitKind::Autocorrelation { lags, length })
}

fn trace(table: &TraceTable) -> Result<Trace, Refused> {
    const KIND: &str = "trace";
    let phases: Vec<Phase> = table
        .phases
        .get_ref()
        .iter()
        .map(phase)
        .collect::<Result<_, _>>()?;
    let length = phases
        .iter()
        .fold(0usize, |sum, phase| sum.saturating_add(phase.length));
    if !(1..=LONGEST).contains(&length) {
        let rule = format!("hold 1 to {LONGEST} samples");
        let problem = out_of_range(KIND, "phases", rule, length.to_string());
        return Err((Some(table.phases.span()), problem));
    }
    let unit = table.unit.as_ref().map(|unit| unit.get_ref().trim());
    if let Some("") = unit {
        let problem = out_of_range(KIND, "unit", "have a name".to_owned(), "\"\"".to_owned());
        return Err((table.unit.as_ref().map(Spanned::span), problem));
    }
    Ok(Trace {
        rate: positive(KIND, "rate", &table.rate, 1.0)?,
        sigma: positive(KIND, "sigma", &table.sigma, 1.0)?,
        unit: unit.unwrap_or("σ_ξ").to_owned(),
        vibration: vibration(&table.vibration)?,
        whitened: table
            .whitened
            .as_ref()
            .is_some_and(|whitened| *whitened.get_ref()),
        drawn_from: whole(KIND, "drawn_from", &table.drawn_from, 0, 0..=length - 1)?,
        phases,
    })
}

fn phase(given: &Spanned<PhaseTable>) -> Result<Phase, Refused> {
    let (kind, length) = match *given.get_ref() {
        PhaseTable::Rest(length) => (PhaseKind::Rest, length),
        PhaseTable::Acceleration(length) => (PhaseKind::Acceleration, length),
        PhaseTable::Inertial(length) => (PhaseKind::Inertial, length),
        PhaseTable::Braking(length) => (PhaseKind::Braking, length),
    };
    let length = length.size();
    if length == 0 {
        let rule = format!("give {} at least 1 sample", kind.name());
        let problem = out_of_range("trace", "phases", rule, "0".to_owned());
        return Err((Some(given.span()), problem));
    }
    Ok(Phase { kind, length })
}

fn vibration(given: &Option<Spanned<Number>>) -> Result<f64, Refused> {
    let value = given.as_ref().map_or(0.0, |value| value.get_ref().0);
    match value >= 0.0 {
        true => Ok(value),
        false => {
            let rule = "be zero or positive".to_owned();
            let problem = out_of_range("trace", "vibration", rule, value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

/// The rules, read by the same code as a detector's.
fn rules(table: &RegionTable, sections: &Sections) -> Result<ExhibitKind, Refused> {
    let given = table.rules.get_ref();
    if given.is_empty() {
        let problem = out_of_range(
            "region",
            "rules",
            "name a rule".to_owned(),
            "none".to_owned(),
        );
        return Err((Some(table.rules.span()), problem));
    }
    let rule = |kind: &Spanned<_>| {
        let mut sections = sections.clone();
        sections.detector.rule = Some(kind.clone());
        match sections.resolve() {
            Ok(scenario) => Ok(scenario.detector.rule),
            Err((problem, keys)) => Err((sections.first_span(keys), problem)),
        }
    };
    let rules = given.iter().map(rule).collect::<Result<_, _>>()?;
    Ok(ExhibitKind::Region { rules })
}

fn sizes(table: &IndependenceTable) -> Result<ExhibitKind, Refused> {
    let refuse = |span, rule: String, got: String| {
        Err((Some(span), out_of_range("independence", "sizes", rule, got)))
    };
    let given = table.sizes.get_ref();
    if given.is_empty() {
        let rule = "list at least one [N, M1, M2]".to_owned();
        return refuse(table.sizes.span(), rule, "none".to_owned());
    }
    let mut sizes = Vec::new();
    for spanned in given {
        let triple = spanned.get_ref().map(Whole::size);
        if triple.contains(&0) {
            let rule = "be at least 1 each".to_owned();
            return refuse(spanned.span(), rule, format!("{triple:?}"));
        }
        if assignments(triple).is_none_or(|number| number > MOST_ASSIGNMENTS) {
            let rule = format!("have at most {MOST_ASSIGNMENTS} assignments of ranks");
            return refuse(spanned.span(), rule, format!("{triple:?}"));
        }
        sizes.push(triple);
    }
    Ok(ExhibitKind::Independence { sizes })
}

/// (N + M₁ + M₂)!/(N! M₁! M₂!), unless it is very large.
fn assignments([n, m1, m2]: [usize; 3]) -> Option<u128> {
    let mut number = 1u128;
    for (before, more) in [(n, m1), (n.checked_add(m1)?, m2)] {
        for i in 1..=more {
            number = number.checked_mul(before.checked_add(i)? as u128)? / i as u128;
            if number > MOST_ASSIGNMENTS {
                return None;
            }
        }
    }
    Some(number)
}

fn impulse_law(table: &ImpulseLawTable) -> Result<ExhibitKind, Refused> {
    const KIND: &str = "impulse_law";
    let refuse = |span, rule: &str, got: String| {
        let problem = out_of_range(KIND, "nu", rule.to_owned(), got);
        Err((Some(span), problem))
    };
    let mut nu: Vec<f64> = Vec::new();
    for given in table.nu.get_ref() {
        let value = given.get_ref().0;
        if !(value > 0.0 && value < 1.0) {
            let rule = "lie strictly between 0 and 1";
            return refuse(given.span(), rule, value.to_string());
        }
        if nu.contains(&value) {
            return refuse(given.span(), "differ from the others", value.to_string());
        }
        nu.push(value);
    }
    if nu.is_empty() {
        return refuse(
            table.nu.span(),
            "list at least one probability",
            "none".to_owned(),
        );
    }
    let length = whole(KIND, "length", &table.length, 200, 1..=10_000)?;
    Ok(ExhibitKind::ImpulseLaw { nu, length })
}

/// The band of an autocorrelation is that of a mean of squares, which a heavy tail does not have.
fn check_law(sections: &Sections) -> Result<(), Refused> {
    let law = sections.noise.law.as_ref();
    let is_heavy = |law: &Spanned<LawKind>| match *law.get_ref() {
        LawKind::Cauchy => true,
        LawKind::StudentT(freedom) => freedom.0 <= 4.0,
        _ => false,
    };
    match law.filter(|law| is_heavy(law)) {
        Some(law) => Err((Some(law.span()), Problem::NoFourthMoment)),
        None => Ok(()),
    }
}

/// Training, X, Y₁ and Y₂ must lie inside the ride.
fn check_fit(trace: &Trace, scenario: &Scenario, file: &File) -> Result<(), Refused> {
    let refuse = |rule: String, got: usize| {
        let span = file
            .trace
            .as_ref()
            .map(|table| table.get_ref().phases.span());
        let problem = Problem::DrawingValue {
            kind: "trace",
            key: "phases",
            rule,
            got: got.to_string(),
            remedy: " (lengthen them, or leave whitened out)",
        };
        Err((span, problem))
    };
    let samples = &scenario.samples;
    let before = scenario.whitening.lead() + samples.reference();
    let Some(start) = trace.acceleration_start() else {
        return refuse("hold an acceleration".to_owned(), 0);
    };
    if start < before {
        let rule = format!("hold {before} samples for training and X before the acceleration");
        return refuse(rule, start);
    }
    let (needed, after) = (samples.span() - samples.reference(), trace.length() - start);
    if after < needed {
        let rule = format!("hold {needed} samples for Y1 and Y2 from the acceleration on");
        return refuse(rule, after);
    }
    Ok(())
}

fn whole(
    kind: &'static str,
    key: &'static str,
    given: &Option<Spanned<Whole>>,
    default: usize,
    allowed: std::ops::RangeInclusive<usize>,
) -> Result<usize, Refused> {
    let value = given
        .as_ref()
        .map_or(default, |value| value.get_ref().size());
    match allowed.contains(&value) {
        true => Ok(value),
        false => {
            let rule = format!("lie in {} to {}", allowed.start(), allowed.end());
            let problem = out_of_range(kind, key, rule, value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

fn positive(
    kind: &'static str,
    key: &'static str,
    given: &Option<Spanned<Number>>,
    default: f64,
) -> Result<f64, Refused> {
    let value = given.as_ref().map_or(default, |value| value.get_ref().0);
    match value > 0.0 {
        true => Ok(value),
        false => {
            let problem = out_of_range(kind, key, "be positive".to_owned(), value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

fn out_of_range(kind: &'static str, key: &'static str, rule: String, got: String) -> Problem {
    Problem::DrawingValue {
        kind,
        key,
        rule,
        got,
        remedy: "",
    }
}
