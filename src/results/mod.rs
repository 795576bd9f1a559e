//! What a run leaves behind: `points.csv`, `figure.png`, `figure.svg`, `run.json` in one directory, and
//! `comparisons.csv` or `quantities.csv` where claims or an experiment have any.
//!
//! The CSV holds counts and the resolved parameters (of rides all but two limits of the monitor), and no clock
//! or host, so that the same config and seed give the same bytes anywhere. Files are written beside their place and renamed into it,
//! all after the last trial. Until then the counts so far are in `counts.json`, see [`Checkpoint`]; a
//! shard of a run has that file alone.

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
