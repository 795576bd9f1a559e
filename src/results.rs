//! What a run leaves behind: `points.csv`, `figure.png`, `figure.svg`, `run.json` in one directory.
//!
//! The CSV holds counts and every resolved parameter, and no clock or host, so that the same config
//! and seed give the same bytes anywhere. Files are written beside their place and renamed into it,
//! all after the last trial: a run that fails leaves what was there before.

use crate::plan::{Hypothesis, Plan, Point};
use crate::tally::Tally;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// One row of `points.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub curve: usize,
    pub label: String,
    pub hypothesis: String,
    pub delta: f64,
    pub nu: f64,
    pub theta: f64,
    pub noise: String,
    pub order: usize,
    pub training: usize,
    pub reference: usize,
    pub shift: usize,
    pub scale: usize,
    pub rule: String,
    pub alpha: f64,
    pub size: f64,
    pub trials: u64,
    pub detections: u64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
    pub confidence: f64,
    pub alternative: String,
    pub sensor: String,
    pub quantum: Option<f64>,
    pub range: Option<f64>,
    pub fit: String,
    pub includes_reference: bool,
    pub gap: usize,
    pub decimation: usize,
    pub delta_at: String,
    pub profile: String,
    pub duration: usize,
    pub offset: usize,
    pub during: String,
}

/// How a run came about: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Manifest {
    /// What messages call the config.
    pub config_name: String,
    /// The config's text.
    pub config: String,
    /// SHA-256 of the text.
    pub config_sha256: String,
    /// Of liftsim.
    pub version: String,
    /// Of its source, where it was known when liftsim was built.
    pub revision: String,
    /// As typed.
    pub command: String,
    /// Where every draw started from.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Whether points shared their noise.
    pub common_random_numbers: bool,
    /// Wall clock of the simulation.
    pub seconds: f64,
    /// Threads it ran on.
    pub threads: usize,
    /// Processor family and the features that change code paths.
    pub architecture: String,
    /// SHA-256 of the files beside this one.
    pub files: BTreeMap<String, String>,
}

/// A directory that holds, or is to hold, the results of one experiment.
#[derive(Clone, Debug)]
pub struct Directory {
    path: PathBuf,
}

/// What a run must know about the results it may replace.
#[derive(Clone, Copy, Debug)]
pub struct Identity<'a> {
    /// Where every draw starts from.
    pub seed: u64,
    /// Whether points share their noise.
    pub common_random_numbers: bool,
    /// Every point.
    pub plan: &'a Plan,
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
         (give another --out, or --fresh to replace it)",
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
         (give another --out, or --fresh to replace them)",
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
    #[error("{}: cannot be written: {error} (give another --out)", path.display())]
    Unwritable {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl Row {
    /// What a point came to.
    pub fn new(point: &Point, tally: Tally, confidence: f64) -> Self {
        let scenario = &point.scenario;
        let (samples, whitening) = (&scenario.samples, &scenario.whitening);
        let (low, high) = tally.interval(confidence);
        Self {
            curve: point.curve + 1,
            label: point.label.clone(),
            hypothesis: match point.hypothesis {
                Hypothesis::H0 => "H0".to_owned(),
                Hypothesis::H1 => "H1".to_owned(),
            },
            delta: scenario.motion.delta,
            nu: scenario.impulses.nu(),
            theta: scenario.impulses.theta(),
            noise: scenario.noise.to_string(),
            order: whitening.order(),
            training: whitening.training(),
            reference: samples.reference(),
            shift: samples.shift(),
            scale: samples.scale(),
            rule: scenario.detector.rule.to_string(),
            alpha: scenario.detector.alpha,
            size: point.region.size(),
            trials: tally.trials,
            detections: tally.hits,
            rate: tally.rate(),
            low: eight_digits(low),
            high: eight_digits(high),
            confidence,
            alternative: scenario.detector.alternative.to_string(),
            sensor: scenario.sensor.to_string(),
            quantum: scenario.digitiser.quantum(),
            range: scenario.digitiser.range(),
            fit: whitening.fit().to_string(),
            includes_reference: whitening.includes_reference(),
            gap: samples.gap(),
            decimation: samples.decimation(),
            delta_at: scenario.motion.delta_at.to_string(),
            profile: scenario.motion.profile.to_string(),
            duration: scenario.motion.duration,
            offset: scenario.motion.offset,
            during: scenario.impulses.during().to_string(),
        }
    }

    /// Whether this is the point at rest.
    pub fn is_at_rest(&self) -> bool {
        self.hypothesis == "H0"
    }

    /// The parameters alone, by column, as the CSV writes them.
    fn parameters(&self) -> Vec<(String, String)> {
        let derived = [
            "label",
            "trials",
            "detections",
            "rate",
            "low",
            "high",
            "confidence",
            "size",
        ];
        let table = csv_bytes(std::slice::from_ref(self));
        let mut lines = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(&table[..])
            .into_records();
        let mut cells = || lines.next().and_then(Result::ok).unwrap_or_default();
        let (names, values) = (cells(), cells());
        names
            .iter()
            .zip(&values)
            .filter(|(name, _)| !derived.contains(name))
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect()
    }
}

/// Eight significant digits: more than any count supports, fewer than the last bits of a bisection.
fn eight_digits(value: f64) -> f64 {
    format!("{value:.7e}").parse().unwrap_or(value)
}

/// The rows as the CSV has them.
pub fn csv_bytes(rows: &[Row]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("a row is plain data");
    }
    writer.into_inner().expect("a vector takes every byte")
}

/// SHA-256 in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

impl Directory {
    /// The directory at `path`, whether it exists or not.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Finds out, before anything is simulated, whether the results of `identity` may go here:
    /// the place can be written, and holds no other experiment and no more trials, unless a `fresh`
    /// start was asked for.
    ///
    /// # Errors
    /// Where not.
    pub fn admit(&self, identity: &Identity, fresh: bool) -> Result<(), ResultsError> {
        self.check_writable()?;
        if fresh || !self.holds_anything() {
            return Ok(());
        }
        let held = self.manifest()?;
        let rows = self.rows()?;
        if let Some(difference) = difference(&held, &rows, identity) {
            let path = self.path.clone();
            return Err(ResultsError::Different { path, difference });
        }
        let asked = identity.plan.trials;
        if held.trials > asked {
            return Err(ResultsError::FewerTrials {
                path: self.path.clone(),
                held: held.trials,
                asked,
            });
        }
        Ok(())
    }

    fn holds_anything(&self) -> bool {
        ["points.csv", "run.json"]
            .iter()
            .any(|name| self.path.join(name).exists())
    }

    /// Whether a file can be made here, or a directory where this one is to be.
    fn check_writable(&self) -> Result<(), ResultsError> {
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
        let (path, bytes) = self.read("run.json")?;
        serde_json::from_slice(&bytes).map_err(|error| ResultsError::Damaged {
            path,
            error: error.to_string(),
        })
    }

    /// The rows of `points.csv`.
    ///
    /// # Errors
    /// Where it is missing or damaged.
    pub fn rows(&self) -> Result<Vec<Row>, ResultsError> {
        let (path, bytes) = self.read("points.csv")?;
        csv::Reader::from_reader(&bytes[..])
            .deserialize()
            .collect::<Result<_, csv::Error>>()
            .map_err(|error| ResultsError::Damaged {
                path,
                error: error.to_string(),
            })
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

/// The first thing that keeps held results from being those of `identity`; labels, captions and
/// the number of trials do not count.
fn difference(held: &Manifest, rows: &[Row], identity: &Identity) -> Option<String> {
    if held.seed != identity.seed {
        return Some(format!(
            "seed is {} there, {} here",
            held.seed, identity.seed
        ));
    }
    if held.common_random_numbers != identity.common_random_numbers {
        let (there, here) = (held.common_random_numbers, identity.common_random_numbers);
        return Some(format!(
            "common_random_numbers is {there} there, {here} here"
        ));
    }
    let points = &identity.plan.points;
    if rows.len() != points.len() {
        return Some(format!(
            "{} points there, {} here",
            rows.len(),
            points.len()
        ));
    }
    let nothing = Tally { hits: 0, trials: 1 };
    rows.iter().zip(points).find_map(|(row, point)| {
        let here = Row::new(point, nothing, row.confidence).parameters();
        let mut cells = row.parameters().into_iter().zip(here);
        let ((name, there), (_, here)) = cells.find(|((_, there), (_, here))| there != here)?;
        Some(format!(
            "{name} is {there} there, {here} here, in curve {}",
            row.curve
        ))
    })
}
