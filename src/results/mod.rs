//! What a run leaves behind: `points.csv`, `figure.png`, `figure.svg`, `run.json` in one directory, and
//! `comparisons.csv` or `quantities.csv` where claims or an experiment have any.
//!
//! The CSV holds counts and every resolved parameter, and no clock or host, so that the same config
//! and seed give the same bytes anywhere. Files are written beside their place and renamed into it,
//! all after the last trial: a run that fails leaves what was there before.

mod comparison;
mod directory;
mod manifest;
mod quantity;
mod row;

pub use comparison::{Comparison, Place};
pub use directory::{Directory, ResultsError};
pub use manifest::{Manifest, RESULTS, sha256};
pub use quantity::Quantity;
pub use row::{Row, csv_bytes, eight_digits};
