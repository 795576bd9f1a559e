//! Every study, by the name of its table.

use super::any::AnyStudy;
use super::kind::{Context, Study};
use super::{
    autocorrelation, impulse_law, independence, layout, operating_point, region, ride, sweep, trace,
};
use crate::experiment::{ConfigError, Experiment};
use crate::run::StudyError;
use schemars::SchemaGenerator;
use serde_json::Value;
use std::path::Path;

/// Every study. A further one is a file and a line here.
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
    pub(super) counts_trials: bool,
    pub(super) read: fn(&Experiment, Context) -> Result<Box<dyn AnyStudy>, StudyError>,
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
