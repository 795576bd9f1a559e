//! Reads a config strictly, as its author wrote it.
//!
//! A config consists of a [`Header`], the claims it tests, the sections of a scenario, and the table of one
//! study. `[axis]` with any `[[curve]]` is a sweep; any other table names its study. Every error points at
//! the value to change.

mod file;
mod header;
mod overlay;
pub mod schema;
mod sweep;
#[cfg(test)]
mod tests;

pub use crate::config::ConfigError;
pub use file::{Experiment, SWEEP};
pub use header::{DEFAULT_PILOT_TRIALS, Header, MOST_PILOT_TRIALS};
pub use overlay::{Keys, Laid, Overlay};
pub use sweep::{CurveHeader, SweepConfig};
