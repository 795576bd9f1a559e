//! From results to files: what every verb that writes a result directory shares.

use super::Failure;
use anyhow::anyhow;
use liftsim::results::{self, Directory, Manifest, Origin};
use liftsim::study::Loaded;
use std::collections::BTreeMap;

/// How results came about that took `seconds`; no file is vouched for yet.
pub fn manifest(origin: &Origin, seconds: f64) -> Manifest {
    Manifest {
        origin: origin.clone(),
        config_sha256: results::sha256(origin.config.as_bytes()),
        revision: env!("LIFTSIM_REVISION").to_owned(),
        command: origin.command_line(),
        seconds,
        threads: rayon::current_num_threads(),
        architecture: architecture(),
        files: BTreeMap::new(),
    }
}

/// What has been written.
pub struct Written {
    /// A line per file.
    pub files: String,
    /// Whether a file other than the manifest has new bytes.
    pub is_new: bool,
    /// Wall clock of the simulation.
    pub seconds: f64,
}

impl Written {
    /// Nothing yet.
    pub fn new(seconds: f64) -> Self {
        Self {
            files: String::new(),
            is_new: false,
            seconds,
        }
    }

    /// One more file.
    pub fn add(&mut self, directory: &Directory, name: &str, is_new: bool) {
        self.files += &line(directory, name, is_new);
        self.is_new |= is_new;
    }

    /// In a word.
    pub fn note(&self) -> &'static str {
        if self.is_new { "written" } else { "unchanged" }
    }
}

/// The study of a config that is stored in a directory.
pub fn stored(directory: &Directory, origin: &Origin) -> Result<Loaded, Failure> {
    Loaded::again(origin).map_err(|error| {
        Failure::Input(anyhow!(
            "{}: its stored config cannot be read (choose another directory): {error}",
            directory.path().display()
        ))
    })
}

/// Writes a file, lets the manifest vouch for it, and says whether it is new.
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

/// A file and whether it is new.
pub fn line(directory: &Directory, name: &str, is_new: bool) -> String {
    let note = if is_new { "written" } else { "unchanged" };
    format!("{}  {note}\n", directory.path().join(name).display())
}

/// The processor family, and which vector instructions it offers.
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
