//! The directory of one experiment: what it holds, what may replace it, how files get there.

use super::{Comparison, Manifest, Quantity, Row, sha256};
use crate::config::{ExhibitConfig, Experiment};
use crate::plan::Plan;
use crate::tally::Tally;
use serde::de::DeserializeOwned;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A directory that holds, or is to hold, the results of one experiment.
#[derive(Clone, Debug)]
pub struct Directory {
    path: PathBuf,
}

/// Why results cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// A file is missing or unreadable.
    #[error("{}: cannot be read: {error} (run `liftsim sweep` first)", path.display())]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// Files that no `sweep` has put there.
    #[error(
        "{}: holds {name}, but no run.json that tells where it comes from \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Foreign {
        /// Which directory.
        path: PathBuf,
        /// What it holds.
        name: &'static str,
    },
    /// A file is not what this program writes.
    #[error("{}: not a result of liftsim: {error} (simulate again with --fresh)", path.display())]
    Damaged {
        /// Which.
        path: PathBuf,
        /// Why.
        error: String,
    },
    /// Something else lives there.
    #[error(
        "{}: holds the result of a different experiment: {difference} \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Different {
        /// Which directory.
        path: PathBuf,
        /// The first thing that differs.
        difference: String,
    },
    /// More has been done than is asked for.
    #[error(
        "{}: holds {held} trials per point, more than the {asked} asked for \
         (choose another directory, or --fresh to replace them)",
        path.display()
    )]
    FewerTrials {
        /// Which directory.
        path: PathBuf,
        /// Trials there.
        held: u64,
        /// Trials asked for.
        asked: u64,
    },
    /// Nothing can be written there.
    #[error("{}: cannot be written: {error} (choose another place)", path.display())]
    Unwritable {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

const MANIFEST: &str = "run.json";
const POINTS: &str = "points.csv";
const COMPARISONS: &str = "comparisons.csv";
const QUANTITIES: &str = "quantities.csv";
/// What a run may leave beside its manifest.
const FILES: [&str; 5] = [POINTS, COMPARISONS, QUANTITIES, "figure.png", "figure.svg"];

impl Directory {
    /// The directory at `path`, whether it exists or not.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Finds out, before anything is simulated, whether the results of `plan` may go here:
    /// the place can be written, and holds no other experiment and no more trials, unless a `fresh`
    /// start was asked for.
    ///
    /// # Errors
    /// Where not.
    pub fn admit(&self, plan: &Plan, fresh: bool) -> Result<(), ResultsError> {
        self.check_writable()?;
        let Some(name) = self.held().filter(|_| !fresh) else {
            return Ok(());
        };
        self.check_origin(name)?;
        let held = self.manifest()?;
        if let Some(kind) = exhibit_in(&held) {
            let path = self.path.clone();
            let difference = format!("[{kind}] there, a sweep here");
            return Err(ResultsError::Different { path, difference });
        }
        let rows = self.rows(&held)?;
        if let Some(difference) = difference(&held, &rows, plan) {
            let path = self.path.clone();
            return Err(ResultsError::Different { path, difference });
        }
        let asked = plan.ensemble.trials;
        if held.trials > asked {
            return Err(ResultsError::FewerTrials {
                path: self.path.clone(),
                held: held.trials,
                asked,
            });
        }
        Ok(())
    }

    /// As [`Directory::admit`], but for a place that belongs to the experiment by its name: results of
    /// another version of it may be replaced, files of unknown origin may not.
    ///
    /// # Errors
    /// Where not.
    pub fn admit_any(&self) -> Result<(), ResultsError> {
        self.check_writable()?;
        self.held().map_or(Ok(()), |name| self.check_origin(name))
    }

    fn check_origin(&self, name: &'static str) -> Result<(), ResultsError> {
        match self.path.join(MANIFEST).exists() {
            true => Ok(()),
            false => {
                let path = self.path.clone();
                Err(ResultsError::Foreign { path, name })
            }
        }
    }

    /// The same as [`Directory::admit`] for an experiment that is no sweep.
    ///
    /// # Errors
    /// Where its results may not go here.
    pub fn admit_exhibit(&self, config: &ExhibitConfig, fresh: bool) -> Result<(), ResultsError> {
        self.check_writable()?;
        let Some(name) = self.held().filter(|_| !fresh) else {
            return Ok(());
        };
        self.check_origin(name)?;
        let path = self.path.clone();
        let held = self.manifest()?;
        self.points(&held)?;
        if let Some(difference) = exhibit_difference(&held, config) {
            return Err(ResultsError::Different { path, difference });
        }
        match held.trials > config.trials {
            true => Err(ResultsError::FewerTrials {
                path,
                held: held.trials,
                asked: config.trials,
            }),
            false => Ok(()),
        }
    }

    /// A file that a run would replace.
    fn held(&self) -> Option<&'static str> {
        let mut names = [MANIFEST].into_iter().chain(FILES);
        names.find(|name| self.path.join(name).exists())
    }

    /// Whether a file can be made here, or a directory where this one is to be.
    ///
    /// # Errors
    /// Where not.
    pub fn check_writable(&self) -> Result<(), ResultsError> {
        let existing = self.path.ancestors().find(|path| path.exists());
        let place = existing.unwrap_or(Path::new("."));
        tempfile::Builder::new()
            .prefix(".liftsim-")
            .tempfile_in(place)
            .map(drop)
            .map_err(|error| self.unwritable(error))
    }

    /// What made the results here.
    ///
    /// # Errors
    /// Where `run.json` is missing or damaged.
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

    /// The rows here, where they are whole and those of `plan` with as many trials.
    pub fn rows_of(&self, plan: &Plan, manifest: &Manifest) -> Option<Vec<Row>> {
        let rows = self.rows(manifest).ok()?;
        let is_same =
            manifest.trials == plan.ensemble.trials && difference(manifest, &rows, plan).is_none();
        is_same.then_some(rows)
    }

    /// The rows of `points.csv`, which must be the file that `manifest` vouches for.
    ///
    /// # Errors
    /// Where it is missing, damaged or changed.
    pub fn rows(&self, manifest: &Manifest) -> Result<Vec<Row>, ResultsError> {
        self.table(POINTS, manifest)
    }

    /// The rows of `comparisons.csv`, none where `manifest` knows of no such file.
    ///
    /// # Errors
    /// As [`Directory::rows`].
    pub fn comparisons(&self, manifest: &Manifest) -> Result<Vec<Comparison>, ResultsError> {
        self.table_if_any(COMPARISONS, manifest)
    }

    /// The rows of `quantities.csv`, none where `manifest` knows of no such file.
    ///
    /// # Errors
    /// As [`Directory::rows`].
    pub fn quantities(&self, manifest: &Manifest) -> Result<Vec<Quantity>, ResultsError> {
        self.table_if_any(QUANTITIES, manifest)
    }

    fn table_if_any<R: DeserializeOwned>(
        &self,
        name: &str,
        manifest: &Manifest,
    ) -> Result<Vec<R>, ResultsError> {
        match manifest.files.contains_key(name) {
            true => self.table(name, manifest),
            false => Ok(Vec::new()),
        }
    }

    fn table<R: DeserializeOwned>(
        &self,
        name: &str,
        manifest: &Manifest,
    ) -> Result<Vec<R>, ResultsError> {
        csv::Reader::from_reader(&self.vouched(name, manifest)?[..])
            .deserialize()
            .collect::<Result<_, csv::Error>>()
            .map_err(|error| self.damaged(name, error))
    }

    /// The bytes of `points.csv`, which must be those that `manifest` vouches for.
    ///
    /// # Errors
    /// Where it is missing or changed.
    pub fn points(&self, manifest: &Manifest) -> Result<Vec<u8>, ResultsError> {
        self.vouched(POINTS, manifest)
    }

    /// What is wrong with a `points.csv` that cannot be read as rows.
    pub fn damaged_points(&self, error: csv::Error) -> ResultsError {
        self.damaged(POINTS, error)
    }

    fn vouched(&self, name: &str, manifest: &Manifest) -> Result<Vec<u8>, ResultsError> {
        let (path, bytes) = self.read(name)?;
        match manifest.files.get(name) == Some(&sha256(&bytes)) {
            true => Ok(bytes),
            false => {
                let error = "its bytes are not those that run.json vouches for".to_owned();
                Err(ResultsError::Damaged { path, error })
            }
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
    /// Where it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<bool, ResultsError> {
        let path = self.path.join(name);
        if std::fs::read(&path).is_ok_and(|held| held == bytes) {
            return Ok(false);
        }
        let replace = || -> io::Result<()> {
            std::fs::create_dir_all(&self.path)?;
            let mut file = tempfile::Builder::new()
                .prefix(".liftsim-")
                .tempfile_in(&self.path)?;
            file.write_all(bytes)?;
            file.as_file().sync_all()?;
            make_readable(file.as_file())?;
            file.persist(&path)?;
            Ok(())
        };
        replace()
            .map(|()| true)
            .map_err(|error| self.unwritable(error))
    }

    /// Takes away what an earlier run left and `manifest` does not vouch for.
    ///
    /// # Errors
    /// Where a file is there and cannot be taken away.
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

    fn unwritable(&self, error: io::Error) -> ResultsError {
        let path = self.path.clone();
        ResultsError::Unwritable { path, error }
    }
}

/// A temporary file is its owner's alone; a result is for everybody.
#[cfg(unix)]
fn make_readable(file: &std::fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &std::fs::File) -> io::Result<()> {
    Ok(())
}

/// The exhibit that a manifest's config draws, if it is one.
fn exhibit_in(held: &Manifest) -> Option<&'static str> {
    match Experiment::parse(&held.config_name, &held.config) {
        Ok(Experiment::Exhibit(config)) => Some(config.kind.name()),
        _ => None,
    }
}

/// The first thing that keeps held results from being those of `config`; the question and the number
/// of trials do not count.
fn exhibit_difference(held: &Manifest, config: &ExhibitConfig) -> Option<String> {
    let here = config.kind.name();
    let there = match Experiment::parse(&held.config_name, &held.config) {
        Ok(Experiment::Exhibit(there)) => there,
        _ => return Some(format!("a sweep there, [{here}] here")),
    };
    if there.kind.name() != here {
        return Some(format!("[{}] there, [{here}] here", there.kind.name()));
    }
    if held.seed != config.seed {
        return Some(format!("seed is {} there, {} here", held.seed, config.seed));
    }
    if there.kind != config.kind {
        return Some(format!("[{here}] says something else there"));
    }
    (there.scenario != config.scenario).then(|| "the sections say something else there".to_owned())
}

/// The first thing that keeps held results from being those of `plan`; labels, captions and
/// the number of trials do not count.
fn difference(held: &Manifest, rows: &[Row], plan: &Plan) -> Option<String> {
    if held.seed != plan.seed {
        return Some(format!("seed is {} there, {} here", held.seed, plan.seed));
    }
    if held.common_random_numbers != plan.common_random_numbers {
        let (there, here) = (held.common_random_numbers, plan.common_random_numbers);
        return Some(format!(
            "common_random_numbers is {there} there, {here} here"
        ));
    }
    let points = &plan.points;
    if rows.len() != points.len() {
        return Some(format!(
            "{} points there, {} here",
            rows.len(),
            points.len()
        ));
    }
    let nothing = Tally { hits: 0, trials: 1 };
    rows.iter().zip(points).find_map(|(row, point)| {
        let here = Row::new(point, None, nothing, row.confidence).parameters();
        let mut cells = row.parameters().into_iter().zip(here);
        let ((name, there), (_, here)) = cells.find(|((_, there), (_, here))| there != here)?;
        Some(format!(
            "{name} is {there} there, {here} here, in curve {}",
            row.curve
        ))
    })
}
