//! Writes results to files. Every command that writes a result directory uses these functions.

use super::Failure;
use anyhow::anyhow;
use liftsim::results::{self, Directory, Manifest, Origin};
use liftsim::study::Loaded;
use std::collections::BTreeMap;

/// The manifest of results that took `seconds`. It lists no files yet.
pub fn manifest(origin: &Origin, seconds: f64) -> Manifest {
    Manifest {
        origin: origin.clone(),
        config_sha256: results::sha256(origin.config.as_bytes()),
        revision: env!("LIFTSIM_REVISION").to_owned(),
        command: origin.command_line(),
        seconds,
        threads: rayon::current_num_threads(),
        architecture: architecture(),
        figure: None,
        files: BTreeMap::new(),
    }
}

/// A record of the files that have been written.
pub struct Written {
    /// The text for the user, with one line per file.
    pub files: String,
    /// Whether a file other than the manifest has new bytes.
    pub is_new: bool,
    /// Wall-clock time of the simulation, in seconds.
    pub seconds: f64,
}

impl Written {
    /// A record with no files yet.
    pub fn new(seconds: f64) -> Self {
        Self {
            files: String::new(),
            is_new: false,
            seconds,
        }
    }

    /// Adds one more file to the record.
    pub fn add(&mut self, directory: &Directory, name: &str, is_new: bool) {
        self.files += &line(directory, name, is_new);
        self.is_new |= is_new;
    }

    /// The outcome in one word.
    pub fn note(&self) -> &'static str {
        if self.is_new { "written" } else { "unchanged" }
    }
}

/// Loads the study of a config that is stored in a directory.
pub fn stored(directory: &Directory, origin: &Origin) -> Result<Loaded, Failure> {
    Loaded::again(origin).map_err(|error| {
        Failure::Input(anyhow!(
            "{}: its stored config cannot be read (choose another directory): {error}",
            directory.path().display()
        ))
    })
}

/// Writes a file, enters its hash in the manifest, and returns whether its bytes are new.
pub fn store(
    directory: &Directory,
    manifest: &mut Manifest,
    name: &str,
    bytes: &[u8],
) -> Result<bool, Failure> {
    let is_new = directory.write(name, bytes).map_err(Failure::run)?;
    manifest
        .files
        .insert(name.to_owned(), results::sha256(bytes));
    Ok(is_new)
}

/// A line that names a file and says whether its bytes are new.
pub fn line(directory: &Directory, name: &str, is_new: bool) -> String {
    let note = if is_new { "written" } else { "unchanged" };
    format!("{}  {note}\n", directory.path().join(name).display())
}

/// Removes what earlier runs have left and the manifest does not list. Returns a line for each file.
pub fn remove_stale(directory: &Directory, manifest: &Manifest) -> Result<String, Failure> {
    let removed = directory.remove_stale(manifest).map_err(Failure::run)?;
    let line = |name| format!("{}  removed\n", directory.path().join(name).display());
    Ok(removed.into_iter().map(line).collect())
}

/// The processor family and its vector instructions.
fn architecture() -> String {
    #[cfg(target_arch = "x86_64")]
    let features = [
        ("avx2", std::is_x86_feature_detected!("avx2")),
        ("fma", std::is_x86_feature_detected!("fma")),
        ("avx512f", std::is_x86_feature_detected!("avx512f")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let features: [(&str, bool); 0] = [];
    let present = features
        .iter()
        .filter(|(_, present)| *present)
        .map(|(name, _)| *name);
    [std::env::consts::ARCH]
        .into_iter()
        .chain(present)
        .collect::<Vec<_>>()
        .join(" ")
}
