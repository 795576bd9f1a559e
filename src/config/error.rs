//! Errors that point: file, line and column, what is wrong, what was got, what to do.

use super::MOST_PILOT_TRIALS;
use super::ride::RideProblem;
use super::source::{ConfigError, Source};
use crate::chain::RecordTooLong;
use crate::detect::{RegionError, SamplesError};
use crate::monitor::SettingsError;
use crate::signal::recording::UnitError;
use crate::signal::{
    DigitiserError, DisturbanceError, ImpulsesError, LawError, MotionError, SensorError,
};
use crate::stats::tally::MOST_TRIALS;
use crate::whiten::WhiteningError;
use serde::de::DeserializeOwned;
use std::fmt;

/// What is wrong with a config.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// The file is no TOML, or holds something that does not belong there.
    #[error("{0}")]
    Toml(Refusal),
    /// Neither an axis nor a drawing table.
    #[error(
        "required key `axis` is missing (add what is swept, for instance [axis] delta = [0.0, 1.0], \
         or one table that says what to draw: {0})"
    )]
    NothingToDo(String),
    /// An axis and a drawing table, or two drawing tables.
    #[error(
        "[{second}] cannot stand beside [{first}]: a config does one thing (take one of them out)"
    )]
    TwoThingsToDo {
        /// The one that stands first in the list of tables.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A drawing where a sweep is needed.
    #[error(
        "[{0}] says what to draw, but nothing is swept here (give a config with [axis], \
         or draw this one with `liftsim sweep`)"
    )]
    NoSweep(&'static str),
    /// A key that a drawing has no use for.
    #[error("{key} means nothing to [{kind}] (take it out)")]
    Unheeded {
        /// As written, with its section.
        key: String,
        /// The drawing.
        kind: &'static str,
    },
    /// A number of a drawing table that is out of range.
    #[error("{kind}.{key} must {rule}, got {got}{remedy}")]
    DrawingValue {
        /// The drawing.
        kind: &'static str,
        /// Its key.
        key: &'static str,
        /// What would do.
        rule: String,
        /// As given.
        got: String,
        /// What to do, in brackets after a space; or nothing.
        remedy: &'static str,
    },
    /// A law whose autocorrelation has no band.
    #[error(
        "noise.law: the band of an autocorrelation needs a fourth moment, which this law has not \
         (take another law, or a student_t above 4)"
    )]
    NoFourthMoment,
    /// No axis, or more than one.
    #[error("axis: exactly one key says what is swept, got {0} (for instance delta = [0.0, 1.0])")]
    AxisKeys(usize),
    /// An axis that is no parameter.
    #[error("axis: unknown parameter `{got}`{} (one of {known})", did_you_mean(.hint))]
    UnknownParameter {
        /// As written.
        got: String,
        /// The nearest one known.
        hint: Option<String>,
        /// All that are.
        known: String,
    },
    /// An axis without values.
    #[error("axis.{0}: no values (list some, or give from, to and step)")]
    EmptyAxis(&'static str),
    /// A value that the parameter cannot take.
    #[error("axis.{name}: {refusal}")]
    AxisValue {
        /// The parameter.
        name: &'static str,
        /// Why not.
        refusal: Refusal,
    },
    /// A step of zero or below.
    #[error("axis.{name}: step must be positive, got {step}")]
    Step {
        /// The parameter.
        name: &'static str,
        /// As given.
        step: f64,
    },
    /// A range that ends before it starts.
    #[error("axis.{name}: from = {from} lies above to = {to} (exchange them)")]
    Reversed {
        /// The parameter.
        name: &'static str,
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// More points than anyone wants.
    #[error("axis.{name}: {points:.0} points, more than {limit} (raise step)")]
    TooManyPoints {
        /// The parameter.
        name: &'static str,
        /// Their number.
        points: f64,
        /// What is allowed.
        limit: usize,
    },
    /// A parameter that is both set and swept.
    #[error(
        "the axis sweeps {0}, so it cannot be set here too (take it out here, or sweep another)"
    )]
    FixedAndSwept(&'static str),
    /// A label that tells no curve from another.
    #[error("curve.label must be there and differ from every other, got \"{0}\"")]
    Label(String),
    /// Panels for some curves only.
    #[error(
        "curve.panel: either every curve names its panel or none does (add it, or take it out)"
    )]
    PanelMissing,
    /// Two curves that look the same.
    #[error("curve.series: {0} is already in this panel (name another series)")]
    SeriesTwice(String),
    /// A confidence that is none.
    #[error("confidence must lie strictly between 0 and 1, got {0}")]
    Confidence(f64),
    /// A half-width out of reach.
    #[error("half_width must lie in [0.00001, 0.5), got {0}")]
    HalfWidth(f64),
    /// Two ways of saying how many trials.
    #[error("trials and half_width both fix the number of trials (leave one of them out)")]
    TrialsTwice,
    /// More trials than anyone can run.
    #[error("trials must be at most {limit}, got {0}", limit = MOST_TRIALS)]
    TooManyTrials(u64),
    /// No trials.
    #[error("trials must be at least 1, got 0")]
    NoTrials,
    /// A pilot of no trials, or of too many.
    #[error("pilot must lie between 1 and {MOST_PILOT_TRIALS} trials, got {0}")]
    Pilot(u64),
    /// A statistic whose law depends on the noise's.
    #[error(
        "detector.rule: {0} has no exact law (add calibrate = {{ law = \"normal\" }} to measure its \
         threshold, or calibrate = true)"
    )]
    NotCalibrated(&'static str),
    /// A search for what only a pilot could decide.
    #[error(
        "detector.rule: {0} has no exact region (name wilcoxon, product, disjunction or conjunction)"
    )]
    NoExactRegion(&'static str),
    /// A table is what it is.
    #[error(
        "detector.calibrate: a table's entries are given (leave calibrate out, or name a rule)"
    )]
    TableCalibrated,
    /// A rule made for a motion, where nothing moves.
    #[error(
        "detector.rule: {0} is made for one motion, and nothing moves here \
         (give motion.delta or impulses.nu and theta, or take the value that moves nothing out of the axis)"
    )]
    NothingStated(&'static str),
    /// The clairvoyant's filter is that of single samples.
    #[error(
        "detector.rule: clairvoyant knows the filter of single samples, not of means of {0} \
         (set decimation to 1)"
    )]
    ClairvoyantDecimated(usize),
    /// A sensor that remembers too much.
    #[error(
        "detector.rule: clairvoyant takes sensors of at most order 6, and no longer than the rest, got \
         order {0} (give another sensor)"
    )]
    ClairvoyantOrder(usize),
    /// A sample of one value.
    #[error("detector.rule: variance-ratio needs at least 2 samples in reference and in scale")]
    NoVariance,
    /// Too little rest for block means.
    #[error(
        "detector.rule: block-means needs {needed} samples of rest, 8 times shift, got {got} \
         (raise training or reference)"
    )]
    RestTooShort {
        /// 8 M₁.
        needed: usize,
        /// Training and X.
        got: usize,
    },
    /// A disturbance that cannot be.
    #[error("rest: {0}")]
    Disturbance(#[from] DisturbanceError),
    /// Two sensors.
    #[error("sensor: model, ar and transfer exclude each other, got {0} of them (leave one)")]
    SensorTwice(usize),
    /// The sensor's coefficients do not whiten block means.
    #[error(
        "whitening.fit: the known filter is that of single samples, not of means of {0} \
         (fit the filter, or set decimation to 1)"
    )]
    KnownFilterDecimated(usize),
    /// The sensor's coefficients do not say what whitening makes of block means.
    #[error(
        "motion.delta_at: the shift after whitening is known for single samples, not for means of {0} \
         (set delta_at to \"record\", or decimation to 1)"
    )]
    WhitenedDeltaDecimated(usize),
    /// A sensor that cannot be.
    #[error("sensor: {0}")]
    Sensor(#[from] SensorError),
    /// A law of noise that cannot be.
    #[error("noise: {0}")]
    Law(#[from] LawError),
    /// A converter that cannot be.
    #[error("noise: {0}")]
    Digitiser(#[from] DigitiserError),
    /// A motion that cannot be.
    #[error("motion: {0}")]
    Motion(#[from] MotionError),
    /// Impulses that cannot be.
    #[error("impulses: {0}")]
    Impulses(#[from] ImpulsesError),
    /// A filter that cannot be.
    #[error("whitening: {0}")]
    Whitening(#[from] WhiteningError),
    /// Samples that cannot be.
    #[error("samples: {0}")]
    Samples(#[from] SamplesError),
    /// What a monitor cannot be told.
    #[error(transparent)]
    Watch(#[from] SettingsError),
    /// A region that cannot be designed.
    #[error("detector: {0}")]
    Region(#[from] RegionError),
    /// A record that does not fit in memory.
    #[error("samples: {0}")]
    Record(#[from] RecordTooLong),
    /// Rides that cannot be made or watched.
    #[error("ride: {0}")]
    Ride(#[from] RideProblem),
    /// A unit that no recording has.
    #[error("recording.{0}")]
    Unit(UnitError),
}

/// What the TOML reader refused, in its words, with a hint where a name was nearly right.
#[derive(Debug)]
pub struct Refusal {
    path: String,
    error: Box<toml::de::Error>,
}

impl Refusal {
    pub(super) fn new(path: &str, error: toml::de::Error) -> Self {
        Self {
            path: path.to_owned(),
            error: Box::new(error),
        }
    }

    /// For an unknown name: what was written, then every name that would do.
    fn unknown_name(&self) -> Option<(String, Vec<String>)> {
        let message = self.error.message();
        if !(message.starts_with("unknown field") || message.starts_with("unknown variant")) {
            return None;
        }
        let mut names = message.split('`').skip(1).step_by(2).map(str::to_owned);
        Some((names.next()?, names.collect()))
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The reader's own names for the inside of a value are nobody's business.
        let written = self.path.split('.').filter(|part| !part.starts_with('$'));
        let mut path: Vec<&str> = written.filter(|part| !part.is_empty()).collect();
        if self.error.message().starts_with("unknown field") {
            path.pop();
        }
        if !path.is_empty() {
            write!(f, "{}: ", path.join("."))?;
        }
        let message = self.error.message().lines().next().unwrap_or_default();
        if let Some((got, known)) = self.unknown_name() {
            let kind = match message.starts_with("unknown field") {
                true => "key",
                false => "value",
            };
            let hint = nearest(&got, known.iter().map(String::as_str));
            let known = known.join(", ");
            return write!(
                f,
                "unknown {kind} `{got}`{} (one of {known})",
                did_you_mean(&hint)
            );
        }
        if let Some(name) = message.strip_prefix("missing field ") {
            return write!(f, "required key {name} is missing (add it)");
        }
        if message.contains("expected newtype variant")
            || message.contains("expected struct variant")
        {
            return f.write_str(
                "needs its parameters (write { student_t = 3.0 }, { table = [...] }, ...)",
            );
        }
        let value = message
            .strip_prefix("invalid type: ")
            .or(message.strip_prefix("invalid value: "));
        match value.and_then(|value| value.split_once(", expected ")) {
            Some((got, "a sequence")) => write!(
                f,
                "must be a list, got one {got} (write [[curve]] for [curve])"
            ),
            Some((got, expected)) => write!(f, "must be {expected}, got {got}"),
            None => f.write_str(message),
        }
    }
}

/// A hint in words.
pub(super) fn did_you_mean(hint: &Option<String>) -> String {
    hint.as_ref()
        .map_or(String::new(), |name| format!(", did you mean `{name}`?"))
}

/// The known name nearest to `got`, if it is near.
pub(super) fn nearest<'a>(got: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    crate::suggest::nearest(got, known).map(str::to_owned)
}

impl Source {
    /// Reads the text as TOML.
    pub(super) fn read_all<T: DeserializeOwned>(&self) -> Result<T, ConfigError> {
        let deserializer =
            toml::Deserializer::parse(self.text()).map_err(|error| self.toml("", error))?;
        serde_path_to_error::deserialize(deserializer).map_err(|error| {
            let path = error.path().to_string();
            self.toml(&path, error.into_inner())
        })
    }

    /// What the TOML reader refused at `path`.
    pub(super) fn toml(&self, path: &str, error: toml::de::Error) -> ConfigError {
        self.at(error.span(), Problem::Toml(Refusal::new(path, error)))
    }
}
