//! Studies: what a config's table describes. Each is a file, and two words here: its module, and its line in
//! [`STUDIES`].
//!
//! A study comes to rows of its own (`points.csv`), from which its picture is drawn, and where it has any to
//! single numbers (`quantities.csv`). What it counts in trials goes through [`run`](crate::run); what it computes
//! is a function of the config alone.

mod any;
pub(crate) mod autocorrelation;
pub(crate) mod impulse_law;
pub(crate) mod independence;
mod kind;
pub(crate) mod layout;
mod loaded;
pub(crate) mod operating_point;
pub mod reference;
pub(crate) mod region;
pub mod ride;
mod rules;
mod sweep;
pub(crate) mod trace;

pub use any::{DrawError, Output};
pub use kind::{Context, Study, Table, TooMany};
pub use loaded::Loaded;
pub use sweep::Sweep;

use crate::experiment::{ConfigError, Experiment};
use crate::run::StudyError;
use any::AnyStudy;
use schemars::SchemaGenerator;
use serde_json::Value;
use std::path::Path;

/// Every study.
pub const STUDIES: &[Entry] = &[
    Entry::of::<sweep::Sweep>(),
    Entry::of::<autocorrelation::Autocorrelation>(),
    Entry::of::<trace::Realisation>(),
    Entry::of::<layout::Layout>(),
    Entry::of::<region::Regions>(),
    Entry::of::<independence::Independence>(),
    Entry::of::<impulse_law::ImpulseLaw>(),
    Entry::of::<operating_point::OperatingPoint>(),
    Entry::of::<ride::Rides>(),
];

/// A study in the list of all.
pub struct Entry {
    /// The name of its table.
    pub name: &'static str,
    /// What its table may say, as a JSON Schema.
    pub schema: fn(&mut SchemaGenerator) -> Value,
    counts_trials: bool,
    read: fn(&Experiment, Context) -> Result<Box<dyn AnyStudy>, StudyError>,
}

impl Entry {
    const fn of<S: Study>() -> Self {
        Self {
            name: S::NAME,
            schema: S::schema,
            counts_trials: S::COUNTS_TRIALS,
            read: |experiment, context| {
                experiment.check_used(S::USES, S::COUNTS_TRIALS)?;
                Ok(Box::new(S::read(experiment, context)?))
            },
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

/// Reads the text of any study's config; `name` is what messages call it.
///
/// # Errors
/// As [`Experiment::load`].
pub fn parse(name: &str, text: &str) -> Result<Experiment, ConfigError> {
    Experiment::parse(name, text, &names())
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
    use super::parse;
    use crate::run::whole;

    /// The study of a config.
    pub fn read<S: Study>(text: &str) -> S {
        let experiment = parse("test", text).unwrap_or_else(|error| panic!("{error}"));
        let context = Context::of(&experiment, S::COUNTS_TRIALS);
        S::read(&experiment, context).unwrap_or_else(|error| panic!("{error}"))
    }

    /// What a study comes to.
    pub fn rows<S: Study>(study: &S, trials: u64) -> Vec<S::Row> {
        let counts = study.trials().map(|all| whole(all, trials, &()).unwrap());
        study.rows(&counts.unwrap_or_default())
    }
}
