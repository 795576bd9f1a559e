//! `run.json`: how a run came about.

use super::Origin;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// How a run came about: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Manifest {
    /// Of which experiment.
    #[serde(flatten)]
    pub origin: Origin,
    /// SHA-256 of the config's text.
    pub config_sha256: String,
    /// Of its source, where it was known when liftsim was built.
    pub revision: String,
    /// What makes the same results again.
    pub command: String,
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

    /// What made a picture, for whoever finds it alone.
    pub fn provenance(&self) -> String {
        let Origin {
            version,
            config_name,
            seed,
            trials,
            ..
        } = &self.origin;
        let hash = self.short_hash();
        format!(
            "liftsim {version}, config {config_name} ({hash}), seed {seed}, {trials} trials per point"
        )
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
