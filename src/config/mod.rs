//! Configs as text: trees of keys and values with their positions, merged, read by serde into the types of the
//! domain, and refused with file, line and column. Nothing here depends on the meaning of a key.

mod axis;
mod read;
mod refusal;
mod shipped;
mod source;
mod tree;

pub use axis::{Axis, AxisValue};
pub use refusal::Refusal;
pub use shipped::{SHIPPED, Shipped};
pub use source::{ConfigError, Conflict, Source, decoded};
pub use tree::{Node, Table, Value};
