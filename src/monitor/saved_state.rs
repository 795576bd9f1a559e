//! All that a monitor starts from, as a file holds it.

use super::{Design, Knowledge, MOST_ORDER, STRONGEST, Settings, SettingsError};
use crate::signal::recording::Sample;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// No saved is longer, bytes.
const LONGEST: u64 = 1 << 20;

/// What a monitor is told and what it knows, at one sampling rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a saved state")]
pub struct SavedState {
    /// What it is told.
    pub settings: Settings,
    /// Samples per second.
    pub rate: f64,
    /// The time, s, and the acceleration, m/s², of the first sample of the record that it was learnt from:
    /// how that record begins is known of no other.
    pub first_sample: Option<(f64, f64)>,
    /// What it knows.
    pub knowledge: Knowledge,
}

/// Why a file is no saved.
#[derive(Debug, thiserror::Error)]
pub enum SavedStateError {
    /// It cannot be read.
    #[error(
        "{path}: cannot be read: {error} (`liftsim detect RECORDING --save-state FILE` writes one)"
    )]
    Unreadable {
        /// As given.
        path: String,
        /// What the system said.
        error: io::Error,
    },
    /// It holds something else.
    #[error("{path}: not what `liftsim detect --save-state` writes: {error}")]
    Format {
        /// As given.
        path: String,
        /// Where and why.
        error: serde_json::Error,
    },
    /// Its settings cannot be used.
    #[error("{path}: {error}")]
    Settings {
        /// As given.
        path: String,
        /// Why.
        error: SettingsError,
    },
    /// A level that no rest has.
    #[error("{path}: level must lie within {STRONGEST} m/s^2, got {got}")]
    Level {
        /// As given.
        path: String,
        /// m/s².
        got: f64,
    },
    /// A filter that no rest gives.
    #[error(
        "{path}: coefficients must be at most {MOST_ORDER}, none beyond 70 in size and their sum at most 1, \
         as those of a fit to rest are, got {got:?}"
    )]
    Filter {
        /// As given.
        path: String,
        /// a₁ … a_m.
        got: Vec<f64>,
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

impl SavedState {
    /// Reads a file.
    ///
    /// # Errors
    /// Where it cannot be read or holds no saved that can be used.
    pub fn load(path: &Path) -> Result<Self, SavedStateError> {
        let name = path.display().to_string();
        let mut text = String::new();
        let read = File::open(path).and_then(|file| file.take(LONGEST).read_to_string(&mut text));
        match read {
            Ok(_) => Self::from_json(&name, &text),
            Err(error) => Err(SavedStateError::Unreadable { path: name, error }),
        }
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`SavedState::load`].
    pub fn from_json(name: &str, text: &str) -> Result<Self, SavedStateError> {
        let path = name.to_owned();
        let saved: Self = match serde_json::from_str(text) {
            Ok(saved) => saved,
            Err(error) => return Err(SavedStateError::Format { path, error }),
        };
        if let Err(error) = saved.design() {
            return Err(SavedStateError::Settings { path, error });
        }
        let Some(reference) = &saved.knowledge.reference else {
            return Ok(saved);
        };
        let (expected, got) = (saved.settings.reference, reference.sample.len());
        match () {
            () if got != expected => Err(SavedStateError::Sample {
                path,
                expected,
                got,
            }),
            () if reference.level.abs() > STRONGEST => Err(SavedStateError::Level {
                path,
                got: reference.level,
            }),
            () if !is_fitted(&reference.coefficients) => Err(SavedStateError::Filter {
                path,
                got: reference.coefficients.clone(),
            }),
            () => Ok(saved),
        }
    }

    /// What it knows of a record that begins with this sample.
    pub fn knowledge_of(&self, first: &Sample) -> Knowledge {
        let is_same = self.first_sample == Some((first.time, first.acceleration));
        Knowledge {
            begins_at_rest: self.knowledge.begins_at_rest && is_same,
            ..self.knowledge.clone()
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

/// Whether a fit can have given these coefficients. Its zeros lie in the unit circle, so that no aₚ exceeds
/// C(m, p) ≤ C(8, 4), and the response to a constant, 1 − Σ a, keeps the sign of a start; both but for rounding.
fn is_fitted(coefficients: &[f64]) -> bool {
    let is_bounded = coefficients.iter().all(|a| a.abs() <= 70.0 + 1e-9);
    let sum: f64 = coefficients.iter().sum();
    coefficients.len() <= MOST_ORDER && is_bounded && sum <= 1.0 + 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Reference;

    fn saved() -> SavedState {
        let settings = Settings::default();
        let reference = Reference {
            level: 9.8,
            coefficients: vec![0.5, -0.25],
            deviation: 0.01,
            whiteness: None,
            training: settings.training,
            span: None,
            sample: vec![0.01; settings.reference],
        };
        SavedState {
            settings,
            rate: 100.0,
            first_sample: Some((0.0, 9.81)),
            knowledge: Knowledge {
                reference: Some(reference),
                ..Knowledge::default()
            },
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let saved = saved();
        let again = SavedState::from_json("lift.json", &saved.to_json()).unwrap();
        assert_eq!(again, saved);
    }

    type Change<'a> = &'a dyn Fn(&mut SavedState, &mut Reference);

    /// Files that would take all memory, or turn the sign of every start.
    #[test]
    fn what_no_rest_gives_is_refused() {
        let refusal = |change: Change| {
            let mut saved = saved();
            let mut reference = saved.knowledge.reference.take().unwrap();
            change(&mut saved, &mut reference);
            saved.knowledge.reference = Some(reference);
            let refused = SavedState::from_json("lift.json", &saved.to_json());
            refused.unwrap_err().to_string()
        };
        let cases: [(&str, Change); 11] = [
            (
                "gap must be at most 200 blocks, got 18446744073709551615",
                &|saved, _| saved.settings.gap = usize::MAX,
            ),
            (
                "training must be at most 100000 blocks, got 1000000",
                &|saved, _| saved.settings.training = 1_000_000,
            ),
            ("shift must be at most 200 blocks, got 3000", &|saved, _| {
                saved.settings.shift = 3000
            }),
            (
                "block must lie in [0.001, 0.5] s, got 0.000001 s",
                &|saved, _| saved.settings.block = 1e-6,
            ),
            ("rate must lie in [1, 1e6] Hz, got 0", &|saved, _| {
                saved.rate = 0.0;
            }),
            ("X must have 24 finite blocks", &|_, reference| {
                reference.sample.truncate(3);
            }),
            ("level must lie within 10000 m/s^2", &|_, reference| {
                reference.level = 1e300;
            }),
            ("coefficients must be at most 8", &|_, reference| {
                reference.coefficients = vec![0.0; 9];
            }),
            ("got [0.75, 0.5]", &|_, reference| {
                reference.coefficients = vec![0.75, 0.5];
            }),
            ("got [-1000.0]", &|_, reference| {
                reference.coefficients = vec![-1000.0];
            }),
            ("expected f64 at line", &|_, reference| {
                reference.deviation = f64::NAN;
            }),
        ];
        for (sentence, change) in cases {
            let refusal = refusal(change);
            assert!(
                refusal.starts_with("lift.json: ") && refusal.contains(sentence),
                "{refusal}"
            );
        }
    }
}
