//! The baseline on disk.

use super::baseline::Baseline;
use crate::track::kept::{KeptError, Kind, Problem};
use serde::{Deserialize, Serialize};
use std::path::Path;

static KIND: Kind = Kind {
    format: "liftsim vibration baseline",
    version: 1,
    // Of the most windows it is 2 MB, and the last trip may be long.
    longest: 1 << 23,
    what: "baseline of vibration",
    made: "`liftsim track RECORDING --baseline FILE` writes one",
    anew: "restore it, or remove it and begin anew",
};

/// The file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct BaselineFile {
    /// Of the records, Hz.
    rate: f64,
    /// The energies of windows, m²/s⁴.
    trips: Vec<Vec<f64>>,
}

impl Baseline {
    /// Reads a baseline from a file.
    ///
    /// # Errors
    /// If it cannot be read, is no baseline of this version, or holds numbers that no baseline has.
    pub fn load(path: &Path) -> Result<Self, KeptError> {
        Self::from_json(&path.display().to_string(), &KIND.read(path)?)
    }

    /// Reads and checks a file's text; messages call the file `name`.
    ///
    /// # Errors
    /// Same as [`Baseline::load`].
    pub fn from_json(name: &str, text: &[u8]) -> Result<Self, KeptError> {
        let file = KIND.parse(text);
        let known = file.and_then(|BaselineFile { rate, trips }| {
            Self::known(rate, trips).map_err(|error| Problem::Wrong(error.into()))
        });
        known.map_err(|problem| problem.of(name))
    }

    /// Writes the baseline to a file, over whatever is there.
    ///
    /// # Errors
    /// If it cannot be written; what was there is then whole.
    pub fn save(&self, path: &Path) -> Result<(), KeptError> {
        Kind::write(path, &self.to_json())
    }

    /// The text of the file.
    pub fn to_json(&self) -> String {
        KIND.text(BaselineFile {
            rate: self.rate(),
            trips: self.trips().to_vec(),
        })
    }
}
