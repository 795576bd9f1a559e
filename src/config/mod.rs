//! Configs as text: trees of keys and values with their positions, merged, read by serde into the types of the
//! domain, and refused with file, line and column. Nothing here depends on the meaning of a key.

mod axis;
mod read;
mod refusal;
mod source;
mod tree;

pub use axis::{Axis, AxisValue};
pub use refusal::Refusal;
pub use source::{ConfigError, Conflict, Source};
pub use tree::{Node, Table, Value};

use serde::de::DeserializeOwned;
use std::path::Path;

/// Reads a TOML file that is not an experiment.
///
/// # Errors
/// If the file cannot be read, is not TOML, or has an unknown key or a wrong value.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<T, ConfigError> {
    let source = Source::load(path)?;
    source.read(&source.parse()?, "")
}
