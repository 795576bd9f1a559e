//! Configs as text: a tree of keys and values with their places, laid over each other, read by serde into
//! whatever the domain has, refused with a file, a line and a column. Nothing here knows what a key means.

mod axis;
mod read;
mod source;
mod tree;

pub use axis::{Axis, AxisValue};
pub use read::Refusal;
pub use source::{ConfigError, Conflict, Source, Unfit};
pub use tree::{Node, Table, Value};
