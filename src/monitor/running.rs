//! A monitor as it runs, in a saved state: everything it holds, so that it goes on as if it had never stopped.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Everything that a program holds of a running monitor. Only the build that wrote it can read it: another may hold other
/// parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Running {
    /// The build that wrote it.
    build: String,
    /// RON, as its numbers may be infinite.
    parts: String,
    /// Of both. What was changed by hand could be anything.
    sha256: String,
}

/// Why a running monitor cannot go on.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum RunningError {
    #[error("was written by another build of liftsim, {0}")]
    Build(String),
    #[error(
        "running: was damaged or changed by hand (take `running` out, to begin with what is known of rest)"
    )]
    Damaged,
}

impl Running {
    /// What `build` holds.
    pub fn new(build: &str, parts: &impl Serialize) -> Self {
        let parts = ron::to_string(parts).expect("numbers and names can be written");
        let (build, sha256) = (build.to_owned(), seal(build, &parts));
        Self {
            build,
            parts,
            sha256,
        }
    }

    /// What it was made from.
    ///
    /// # Errors
    /// If another build wrote it, or it is not as it was written.
    pub fn parts<T: DeserializeOwned>(&self, build: &str) -> Result<T, RunningError> {
        if seal(&self.build, &self.parts) != self.sha256 {
            return Err(RunningError::Damaged);
        }
        if self.build != build {
            return Err(RunningError::Build(self.build.clone()));
        }
        // Builds of changed sources may have one name.
        ron::from_str(&self.parts).map_err(|_| RunningError::Build(self.build.clone()))
    }
}

fn seal(build: &str, parts: &str) -> String {
    let mut seal = Sha256::new();
    seal.update(build.as_bytes());
    seal.update(parts.as_bytes());
    let bytes = seal.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
