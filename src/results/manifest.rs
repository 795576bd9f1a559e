//! `run.json`: the provenance of a run.

use super::Origin;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The provenance of a run, as written to `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Manifest {
    /// The experiment.
    #[serde(flatten)]
    pub origin: Origin,
    /// SHA-256 of the config's text.
    pub config_sha256: String,
    /// The source revision of liftsim, if it was known at build time.
    pub revision: String,
    /// The command that gives the same results again.
    pub command: String,
    /// Wall clock of the simulation.
    pub seconds: f64,
    /// The number of threads.
    pub threads: usize,
    /// Processor family and the features that change code paths.
    pub architecture: String,
    /// How the figure is drawn, by the keys of `[figure]`, unless as any is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figure: Option<Value>,
    /// SHA-256 of the files beside this one.
    pub files: BTreeMap<String, String>,
}

impl Manifest {
    /// The text of the file.
    pub fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec_pretty(self).expect("a manifest is plain data");
        json.push(b'\n');
        json
    }

    /// The provenance in one line, for embedding in a picture.
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

    /// The first digits of the config's hash.
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
