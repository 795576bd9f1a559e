//! Configs as text: a tree of keys and values with their places, laid over each other, read by serde into
//! whatever the domain has, refused with a file, a line and a column. Nothing here knows what a key means.

mod axis;
mod read;
mod source;
mod tree;

pub use axis::{Axis, AxisValue};
pub use read::Refusal;
pub use source::{ConfigError, Conflict, Source};
pub use tree::{Node, Table, Value};

use serde::de::DeserializeOwned;
use std::path::Path;

/// Reads a file that describes no experiment.
///
/// # Errors
/// Where it cannot be read, is no TOML, or holds something that does not belong there.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<T, ConfigError> {
    let source = Source::load(path)?;
    source.read(&source.parse()?, "")
}
