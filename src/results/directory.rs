//! The directory of one experiment: what it holds, what may replace it, how files get there.

use super::{Checkpoint, Comparison, Manifest, Origin, Quantity, ResultsError, sha256};
use crate::files;
use serde::de::DeserializeOwned;
use std::io;
use std::path::{Path, PathBuf};

/// A directory that holds, or is to hold, the results of one experiment.
#[derive(Clone, Debug)]
pub struct Directory {
    path: PathBuf,
}

const MANIFEST: &str = "run.json";
const POINTS: &str = "points.csv";
const COMPARISONS: &str = "comparisons.csv";
const QUANTITIES: &str = "quantities.csv";
const COUNTS: &str = "counts.json";
/// What a run may leave beside its manifest.
const FILES: [&str; 6] = [
    POINTS,
    COMPARISONS,
    QUANTITIES,
    "figure.png",
    "figure.svg",
    COUNTS,
];

impl Directory {
    /// The directory at `path`, whether it exists or not.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether what a run would replace has been made by one, so far as its files tell.
    ///
    /// # Errors
    /// If files are of unknown origin.
    pub fn admit_any(&self) -> Result<(), ResultsError> {
        match self.replaced() {
            Some(name) if !self.holds(MANIFEST) && !self.holds(COUNTS) => {
                let path = self.path.clone();
                Err(ResultsError::Foreign { path, name })
            }
            _ => Ok(()),
        }
    }

    /// A file that a run would replace.
    fn replaced(&self) -> Option<&'static str> {
        let mut names = [MANIFEST].into_iter().chain(FILES);
        names.find(|name| self.holds(name))
    }

    fn holds(&self, name: &str) -> bool {
        self.path.join(name).exists()
    }

    /// Whether there are finished results here.
    pub fn is_finished(&self) -> bool {
        self.holds(MANIFEST)
    }

    /// The counts so far of a run that is not over.
    ///
    /// # Errors
    /// If they are unreadable or damaged.
    pub fn checkpoint(&self) -> Result<Option<Checkpoint>, ResultsError> {
        if !self.holds(COUNTS) {
            return Ok(None);
        }
        let (path, bytes) = self.read(COUNTS)?;
        let checkpoint = Checkpoint::from_json(&bytes);
        checkpoint
            .map(Some)
            .map_err(|error| ResultsError::Checkpoint { path, error })
    }

    /// Saves the counts so far. Whatever happens, what was saved before or these are there. Says whether these are
    /// others.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn save(&self, checkpoint: &Checkpoint) -> Result<bool, ResultsError> {
        let json = checkpoint.to_json();
        let is_new = !self.has(COUNTS, &json);
        // Even the same bytes are written: a place that takes none is found out before anything is counted.
        let saved = self.replace(COUNTS, &json);
        (saved.map(|()| is_new)).map_err(|error| ResultsError::Unsaved {
            path: self.path.join(COUNTS),
            error,
        })
    }

    /// Whether a file can be made here, or a directory where this one is to be.
    ///
    /// # Errors
    /// If not.
    pub fn check_writable(&self) -> Result<(), ResultsError> {
        let existing = self.path.ancestors().find(|path| path.exists());
        let place = existing.unwrap_or(Path::new("."));
        // It has no name, so that nothing is left behind whenever the process ends.
        tempfile::tempfile_in(place)
            .map(drop)
            .map_err(|error| self.unwritable(error))
    }

    /// What made the results here.
    ///
    /// # Errors
    /// If `run.json` is missing or damaged.
    pub fn manifest(&self) -> Result<Manifest, ResultsError> {
        let (path, bytes) = self.read(MANIFEST)?;
        serde_json::from_slice(&bytes).map_err(|error| ResultsError::Damaged {
            path,
            error: error.to_string(),
        })
    }

    /// Whether every file that `manifest` vouches for is here with the bytes it vouches for.
    pub fn is_intact(&self, manifest: &Manifest) -> bool {
        let is_whole = |(name, hash): (&String, &String)| {
            std::fs::read(self.path.join(name)).is_ok_and(|bytes| *hash == sha256(&bytes))
        };
        !manifest.files.is_empty() && manifest.files.iter().all(is_whole)
    }

    /// The rows of `comparisons.csv`, none where `manifest` knows of no such file.
    ///
    /// # Errors
    /// Same as [`Directory::points`].
    pub fn comparisons(&self, manifest: &Manifest) -> Result<Vec<Comparison>, ResultsError> {
        self.table(COMPARISONS, manifest)
    }

    /// The rows of `quantities.csv`, none where `manifest` knows of no such file.
    ///
    /// # Errors
    /// Same as [`Directory::points`].
    pub fn quantities(&self, manifest: &Manifest) -> Result<Vec<Quantity>, ResultsError> {
        self.table(QUANTITIES, manifest)
    }

    fn table<R: DeserializeOwned>(
        &self,
        name: &str,
        manifest: &Manifest,
    ) -> Result<Vec<R>, ResultsError> {
        if !manifest.files.contains_key(name) {
            return Ok(Vec::new());
        }
        csv::Reader::from_reader(&self.vouched(name, manifest)?[..])
            .deserialize()
            .collect::<Result<_, csv::Error>>()
            .map_err(|error| self.damaged(name, error))
    }

    /// What made the results of an experiment that are here whole, and none more lately under way.
    pub fn complete(&self, origin: &Origin) -> Option<Manifest> {
        let manifest = self.manifest().ok()?;
        let is_over = !self.holds(COUNTS);
        let is_complete = is_over && origin.made(&manifest.origin) && self.is_intact(&manifest);
        is_complete.then_some(manifest)
    }

    /// The bytes of `points.csv`, which must be those that `manifest` vouches for.
    ///
    /// # Errors
    /// If it is missing or changed.
    pub fn points(&self, manifest: &Manifest) -> Result<Vec<u8>, ResultsError> {
        self.vouched(POINTS, manifest)
    }

    /// What is wrong with a `points.csv` that cannot be read as rows.
    pub fn damaged_points(&self, error: csv::Error) -> ResultsError {
        self.damaged(POINTS, error)
    }

    fn vouched(&self, name: &str, manifest: &Manifest) -> Result<Vec<u8>, ResultsError> {
        let (path, bytes) = self.read(name)?;
        if manifest.files.get(name) == Some(&sha256(&bytes)) {
            Ok(bytes)
        } else {
            let error = "its bytes are not those that run.json vouches for".to_owned();
            Err(ResultsError::Damaged { path, error })
        }
    }

    /// What is wrong with saved counts that cannot have been counted.
    pub fn impossible(&self, error: &impl std::fmt::Display) -> ResultsError {
        let name = if self.holds(COUNTS) { COUNTS } else { POINTS };
        ResultsError::Checkpoint {
            path: self.path.join(name),
            error: error.to_string(),
        }
    }

    fn damaged(&self, name: &str, error: csv::Error) -> ResultsError {
        ResultsError::Damaged {
            path: self.path.join(name),
            error: error.to_string(),
        }
    }

    fn read(&self, name: &str) -> Result<(PathBuf, Vec<u8>), ResultsError> {
        let path = self.path.join(name);
        match std::fs::read(&path) {
            Ok(bytes) => Ok((path, bytes)),
            Err(error) => Err(ResultsError::Unreadable { path, error }),
        }
    }

    /// Writes a file, whole or not at all. Says whether its bytes are new.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<bool, ResultsError> {
        if self.has(name, bytes) {
            return Ok(false);
        }
        let replaced = self.replace(name, bytes);
        replaced
            .map(|()| true)
            .map_err(|error| self.unwritable(error))
    }

    fn has(&self, name: &str, bytes: &[u8]) -> bool {
        std::fs::read(self.path.join(name)).is_ok_and(|held| held == bytes)
    }

    fn replace(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        std::fs::create_dir_all(&self.path)?;
        files::replace(&self.path.join(name), bytes)
    }

    /// Takes away what an earlier run left and `manifest` does not vouch for.
    ///
    /// # Errors
    /// If a file is there and cannot be taken away.
    pub fn remove_stale(&self, manifest: &Manifest) -> Result<(), ResultsError> {
        let is_stale = |name: &&str| !manifest.files.contains_key(*name);
        for name in FILES.into_iter().filter(is_stale) {
            match std::fs::remove_file(self.path.join(name)) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(self.unwritable(error));
                }
                _ => {}
            }
        }
        Ok(())
    }

    pub(super) fn unwritable(&self, error: io::Error) -> ResultsError {
        let path = self.path.clone();
        ResultsError::Unwritable { path, error }
    }
}
