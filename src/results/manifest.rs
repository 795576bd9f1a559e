//! `run.json`: how a run came about.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Raised whenever the same config and seed come to give other bytes than before, so that results of
/// before are not taken for complete.
pub const RESULTS: u32 = 2;

/// How a run came about: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Manifest {
    /// The config's file name.
    pub config_name: String,
    /// The config's text.
    pub config: String,
    /// SHA-256 of the text.
    pub config_sha256: String,
    /// Of liftsim.
    pub version: String,
    /// Of the bytes that a config and a seed give: [`RESULTS`] at the time.
    pub results: u32,
    /// Of its source, where it was known when liftsim was built.
    pub revision: String,
    /// What makes the same results again.
    pub command: String,
    /// Where every draw started from.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Trials of each pilot run, where there was any.
    pub pilot: u64,
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

impl Manifest {
    /// As the file has it.
    pub fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec_pretty(self).expect("a manifest is plain data");
        json.push(b'\n');
        json
    }

    /// Enough of the config's hash to tell it from others.
    pub fn short_hash(&self) -> &str {
        self.config_sha256.get(..12).unwrap_or(&self.config_sha256)
    }
}

/// SHA-256 in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}
