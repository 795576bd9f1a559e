//! All that a monitor starts from, as a file holds it.

use super::{Design, Knowledge, Settings, SettingsError};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::{fs, io};

/// What a monitor is told and what it knows, at one sampling rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Briefing {
    /// What it is told.
    pub settings: Settings,
    /// Samples per second.
    pub rate: f64,
    /// What it knows.
    pub knowledge: Knowledge,
}

/// Why a file is no briefing.
#[derive(Debug, thiserror::Error)]
pub enum BriefingError {
    /// It cannot be read.
    #[error(
        "{path}: cannot be read: {source} (`liftsim detect RECORDING --save-state FILE` writes one)"
    )]
    Unreadable {
        /// As given.
        path: String,
        /// What the system said.
        source: io::Error,
    },
    /// It holds something else.
    #[error("{path}: not what `liftsim detect --save-state` writes: {source}")]
    Format {
        /// As given.
        path: String,
        /// Where and why.
        source: serde_json::Error,
    },
    /// Its settings cannot be used.
    #[error("{path}: {source}")]
    Settings {
        /// As given.
        path: String,
        /// Why.
        source: SettingsError,
    },
    /// Its parts do not fit each other.
    #[error("{path}: X must have {expected} finite blocks as settings.reference says, got {got}")]
    Sample {
        /// As given.
        path: String,
        /// N.
        expected: usize,
        /// What there are.
        got: usize,
    },
}

impl Briefing {
    /// Reads a file.
    ///
    /// # Errors
    /// Where it cannot be read or holds no briefing that can be used.
    pub fn load(path: &Path) -> Result<Self, BriefingError> {
        let name = || path.display().to_string();
        let text = fs::read_to_string(path).map_err(|source| BriefingError::Unreadable {
            path: name(),
            source,
        })?;
        let briefing: Self =
            serde_json::from_str(&text).map_err(|source| BriefingError::Format {
                path: name(),
                source,
            })?;
        briefing
            .design()
            .map_err(|source| BriefingError::Settings {
                path: name(),
                source,
            })?;
        let expected = briefing.settings.reference;
        let reference = briefing.knowledge.reference.as_ref();
        match reference.map_or(expected, |reference| reference.sample.len()) {
            got if got != expected => Err(BriefingError::Sample {
                path: name(),
                expected,
                got,
            }),
            _ => Ok(briefing),
        }
    }

    /// As a file has it.
    pub fn to_json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        json.expect("numbers and names can be written") + "\n"
    }

    /// The settings at the rate.
    ///
    /// # Errors
    /// As [`Settings::at`].
    pub fn design(&self) -> Result<Design, SettingsError> {
        self.settings.at(self.rate)
    }
}
