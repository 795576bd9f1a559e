//! Studies: what a config's table describes. Each study is a module, which this file names twice: as a module
//! and as a line in [`STUDIES`].
//!
//! A study produces its own rows (`points.csv`), from which its picture is drawn, and may produce single
//! numbers (`quantities.csv`). Counts of trials go through [`run`](crate::run). Everything else that it
//! computes is a function of the config alone.

pub mod air;
mod along;
mod any;
pub(crate) mod autocorrelation;
mod curves;
pub mod detectors;
mod dots;
mod estimate;
pub mod floors;
pub mod gravity;
pub mod height;
pub(crate) mod impulse_law;
pub(crate) mod independence;
mod kind;
pub(crate) mod layout;
mod loaded;
pub(crate) mod operating_point;
mod outcomes;
pub mod phases;
pub mod quality;
pub mod records;
pub mod reference;
pub(crate) mod region;
pub mod ride;
mod rules;
pub mod run_length;
mod sweep;
pub(crate) mod trace;
pub mod trips;
pub mod vibration;

pub use kind::{Context, Study, TooMany};
pub use loaded::Loaded;
pub use sweep::{Sweep, TrialOutcomes};

use crate::experiment::{ConfigError, Experiment};
use crate::results::Origin;
use crate::run::StudyError;
use schemars::SchemaGenerator;
use serde_json::Value;
use std::path::Path;

/// All studies.
pub const STUDIES: &[Entry] = &[
    Entry::of::<sweep::Sweep>(),
    Entry::of::<autocorrelation::Autocorrelation>(),
    Entry::of::<trace::Realisation>(),
    Entry::of::<layout::Layout>(),
    Entry::of::<region::Regions>(),
    Entry::of::<independence::Independence>(),
    Entry::of::<impulse_law::ImpulseLaw>(),
    Entry::of::<operating_point::OperatingPoint>(),
    Entry::of::<outcomes::Of<ride::Table>>(),
    Entry::of::<outcomes::Of<records::Table>>(),
    Entry::of::<outcomes::Of<floors::Table>>(),
    Entry::of::<outcomes::Of<trips::Table>>(),
    Entry::of::<outcomes::Of<gravity::Windows>>(),
    Entry::of::<outcomes::Of<quality::Table>>(),
    Entry::of::<outcomes::Of<phases::Table>>(),
    Entry::of::<outcomes::Of<height::Table>>(),
    Entry::of::<outcomes::Of<vibration::Table>>(),
    Entry::of::<outcomes::Of<air::Table>>(),
    Entry::of::<outcomes::Of<run_length::RunLengths>>(),
    Entry::of::<outcomes::Of<detectors::Detectors>>(),
];

/// An entry of the list of studies.
pub struct Entry {
    /// The name of its table.
    pub name: &'static str,
    /// The JSON Schema of its table.
    pub schema: fn(&mut SchemaGenerator) -> Value,
    load: fn(&Experiment) -> Result<Loaded, StudyError>,
}

impl Entry {
    const fn of<S: Study>() -> Self {
        Self {
            name: S::NAME,
            schema: S::schema,
            load: Loaded::of::<S>,
        }
    }
}

fn names() -> Vec<&'static str> {
    STUDIES.iter().map(|study| study.name).collect()
}

/// Reads the config of any study.
///
/// # Errors
/// As [`Experiment::load`].
pub fn load(path: &Path) -> Result<Experiment, ConfigError> {
    Experiment::load(path, &names())
}

/// Reads the text of any study's config. Messages call it `name`.
///
/// # Errors
/// As [`Experiment::load`].
pub fn parse(name: &str, text: &str) -> Result<Experiment, ConfigError> {
    Experiment::parse(name, text, &names())
}

impl Loaded {
    /// Plans the study that a config describes.
    ///
    /// # Errors
    /// If a parameter of a point is out of range, or no region or record can be made for it.
    pub fn new(config: Experiment) -> Result<Self, StudyError> {
        let mut studies = STUDIES.iter();
        let entry = studies.find(|entry| entry.name == config.study());
        (entry.expect("a config names a study").load)(&config)
    }

    /// The experiment behind results.
    ///
    /// # Errors
    /// If this version cannot read its config.
    pub fn again(origin: &Origin) -> Result<Self, StudyError> {
        let mut config = parse(&origin.config_name, &origin.config)?;
        config.header.set_trials(origin.trials);
        config.header.seed = origin.seed;
        config.header.pilot = origin.pilot;
        Self::new(config)
    }
}

/// The plane of W and T, for `threshold`.
pub mod plane {
    pub use super::region::boundary;
    pub use super::region::picture::{plot, title};
}

#[cfg(test)]
mod tests_of_pictures;

#[cfg(test)]
mod tests {
    use super::kind::{Context, Study};
    use super::outcomes::Outcomes;
    use super::parse;
    use crate::lift::Journey;
    use crate::run::whole;

    /// A trip up from 10 to 20 s.
    pub const UP: Journey = Journey {
        start: 10.0,
        uniform: 12.0,
        braking: 18.0,
        levelling: None,
        stop: 20.0,
        direction: 1,
        distance: 8.0,
        speed: 1.0,
        jammed: false,
    };

    /// The study of a config.
    pub fn read<S: Study>(text: &str) -> S {
        let experiment = parse("test", text).unwrap_or_else(|error| panic!("{error}"));
        let context = Context::of(&experiment, S::COUNTS_TRIALS);
        S::read(&experiment, context).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Why the table of a config is refused, if it is.
    pub fn refusal<T: Outcomes>(text: &str) -> Option<String> {
        let experiment = parse("test", text).unwrap_or_else(|error| panic!("{error}"));
        T::read(&experiment).err().map(|error| error.to_string())
    }

    /// Runs a study and returns its rows.
    pub fn rows<S: Study>(study: &S, trials: u64) -> Vec<S::Row> {
        let counts = study.trials().map(|all| whole(all, trials, &()).unwrap());
        study.rows(&counts.unwrap_or_default())
    }
}
