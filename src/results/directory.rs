//! The directory of one experiment: its files, what may replace them, and how they are written.

use super::{Checkpoint, Comparison, Manifest, Origin, Quantity, ResultsError, sha256};
use crate::figure::OVERLAY;
use crate::files;
use serde::de::DeserializeOwned;
use std::io;
use std::path::{Path, PathBuf};

/// A directory for the results of one experiment.
#[derive(Clone, Debug)]
pub struct Directory {
    path: PathBuf,
}

const MANIFEST: &str = "run.json";
const POINTS: &str = "points.csv";
const COMPARISONS: &str = "comparisons.csv";
const QUANTITIES: &str = "quantities.csv";
const COUNTS: &str = "counts.json";
/// The files that a run may write beside its manifest.
const FILES: [&str; 8] = [
    POINTS,
    COMPARISONS,
    QUANTITIES,
    "figure.png",
    "figure.svg",
    "figure.pdf",
    OVERLAY,
    COUNTS,
];

impl Directory {
    /// The directory at `path`, which need not exist.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The path of the directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Checks that the files a run would replace were written by liftsim.
    ///
    /// # Errors
    /// If a file is of unknown origin.
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

    /// Whether the directory has finished results.
    pub fn is_finished(&self) -> bool {
        self.holds(MANIFEST)
    }

    /// The counts of an unfinished run, if there are any.
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

    /// Saves the counts atomically: at any moment the file has either the old or the new counts. Returns whether
    /// they differ.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn save(&self, checkpoint: &Checkpoint) -> Result<bool, ResultsError> {
        let json = checkpoint.to_json();
        let is_new = !self.has(COUNTS, &json);
        // The same bytes are written again, so that a full disk is noticed before anything is counted.
        let saved = self.replace(COUNTS, &json);
        (saved.map(|()| is_new)).map_err(|error| self.unsaved(COUNTS, error))
    }

    /// Checks that files can be created here, or the directory itself if it does not exist.
    ///
    /// # Errors
    /// If they cannot.
    pub fn check_writable(&self) -> Result<(), ResultsError> {
        let existing = self.path.ancestors().find(|path| path.exists());
        let place = existing.unwrap_or(Path::new("."));
        // An unnamed temporary file leaves nothing behind, even if the process is killed.
        tempfile::tempfile_in(place)
            .map(drop)
            .map_err(|error| self.unwritable(error))
    }

    /// Reads `run.json`.
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

    /// Whether every file listed in `manifest` exists with the listed hash.
    pub fn is_intact(&self, manifest: &Manifest) -> bool {
        let is_whole = |(name, hash): (&String, &String)| {
            std::fs::read(self.path.join(name)).is_ok_and(|bytes| *hash == sha256(&bytes))
        };
        !manifest.files.is_empty() && manifest.files.iter().all(is_whole)
    }

    /// The rows of `comparisons.csv`; empty if `manifest` does not list it.
    ///
    /// # Errors
    /// Same as [`Directory::points`].
    pub fn comparisons(&self, manifest: &Manifest) -> Result<Vec<Comparison>, ResultsError> {
        self.table(COMPARISONS, manifest)
    }

    /// The rows of `quantities.csv`; empty if `manifest` does not list it.
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

    /// The manifest of complete results of this experiment, if they are here and no later run is unfinished.
    pub fn complete(&self, origin: &Origin) -> Option<Manifest> {
        let manifest = self.manifest().ok()?;
        let is_over = !self.holds(COUNTS);
        let is_complete = is_over && origin.made(&manifest.origin) && self.is_intact(&manifest);
        is_complete.then_some(manifest)
    }

    /// The bytes of `points.csv`, which must have the hash listed in `manifest`.
    ///
    /// # Errors
    /// If it is missing or changed.
    pub fn points(&self, manifest: &Manifest) -> Result<Vec<u8>, ResultsError> {
        self.vouched(POINTS, manifest)
    }

    /// The curves of one's own that lie over the figure, which must have the hash listed in `manifest`.
    ///
    /// # Errors
    /// If they are missing or changed.
    pub fn overlay(&self, manifest: &Manifest) -> Result<String, ResultsError> {
        let bytes = self.vouched(OVERLAY, manifest)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// The error for a `points.csv` that cannot be parsed.
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

    /// The error for implausible saved counts.
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

    /// Writes a file atomically. Returns whether its bytes are new.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<bool, ResultsError> {
        if self.has(name, bytes) {
            return Ok(false);
        }
        let replaced = self.replace(name, bytes);
        (replaced.map(|()| true)).map_err(|error| self.unsaved(name, error))
    }

    fn unsaved(&self, name: &str, error: io::Error) -> ResultsError {
        let path = self.path.join(name);
        ResultsError::Unsaved { path, error }
    }

    fn has(&self, name: &str, bytes: &[u8]) -> bool {
        std::fs::read(self.path.join(name)).is_ok_and(|held| held == bytes)
    }

    fn replace(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        std::fs::create_dir_all(&self.path)?;
        files::replace(&self.path.join(name), bytes)
    }

    /// Removes the files of earlier runs that `manifest` does not list, and returns which; counts are not named, as what they
    /// hold is in the results.
    ///
    /// # Errors
    /// If a file cannot be removed.
    pub fn remove_stale(&self, manifest: &Manifest) -> Result<Vec<&'static str>, ResultsError> {
        let mut removed = Vec::new();
        let is_stale = |name: &&str| !manifest.files.contains_key(*name);
        for name in FILES.into_iter().filter(is_stale) {
            match std::fs::remove_file(self.path.join(name)) {
                Ok(()) if name != COUNTS => removed.push(name),
                Ok(()) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(self.unwritable(error)),
            }
        }
        Ok(removed)
    }

    pub(super) fn unwritable(&self, error: io::Error) -> ResultsError {
        let path = self.path.clone();
        ResultsError::Unwritable { path, error }
    }
}
