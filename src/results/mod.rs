//! The files of a run, in one directory: `points.csv`, `figure.png`, `figure.svg`, `run.json`, and
//! `comparisons.csv` or `quantities.csv` if there are comparisons or quantities.
//!
//! The CSV holds counts and the resolved parameters (of rides all but two limits of the monitor), but no clock
//! or host, so that the same config and seed give the same bytes anywhere. After the last trial each file is written under a temporary
//! name and renamed. Until then the counts are in `counts.json`, see [`Checkpoint`]; a shard has only
//! that file.

mod checkpoint;
mod directory;
mod error;
mod lock;
mod manifest;
mod origin;
mod row;

pub use crate::claim::{Comparison, Place, Quantity};
pub use crate::format::eight_digits;
pub use checkpoint::{Checkpoint, NoShard, Shard};
pub use directory::Directory;
pub use error::ResultsError;
pub use lock::Lock;
pub use manifest::{Manifest, sha256};
pub use origin::{Origin, RESULTS, file_name};
pub use row::{Row, csv_bytes, parameters};
