//! The saved state of a monitor, as written by `detect --save-state`.

use super::reference::MOST_RANKED;
use super::running::Running;
use super::{DecisionRule, Design, Knowledge, MOST_ORDER, Settings, SettingsError};
use crate::explain::STRONGEST;
use crate::files;
use crate::recording::Sample;
use serde::{Deserialize, Serialize};
use std::io::{self, Read};
use std::ops::RangeInclusive;
use std::path::Path;

/// The largest size of a state, bytes.
const LONGEST: u64 = 64 << 20;

/// The settings and the knowledge of a monitor, at one sampling rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a saved state")]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub struct SavedState {
    pub settings: Settings,
    /// Samples per second.
    pub rate: f64,
    /// The time, s, and the acceleration, m/s², of the first sample of the record it was learnt from. It
    /// identifies that record, since the knowledge of its beginning applies to no other.
    pub first_sample: Option<(f64, f64)>,
    pub knowledge: Knowledge,
    /// The monitor that wrote it, as it ran.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub running: Option<Running>,
}

/// Why a file cannot be used as a state.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct SavedStateError {
    path: String,
    problem: Problem,
}

#[derive(Debug, thiserror::Error)]
enum Problem {
    #[error("cannot be read: {0} (`liftsim detect RECORDING --save-state FILE` writes one)")]
    Unreadable(#[from] io::Error),
    #[error("not what `--save-state` of detect or monitor writes: {0}")]
    Format(#[from] serde_json::Error),
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error("level must lie within {STRONGEST} m/s^2, got {0}")]
    Level(f64),
    #[error(
        "coefficients must be at most {MOST_ORDER}, none beyond 70 in size and their sum at most 1, \
         as those of a fit to rest are, got {0:?}"
    )]
    Filter(Vec<f64>),
    #[error("X must have {expected} finite blocks as settings.samples.reference says, got {got}")]
    Sample { expected: usize, got: usize },
    #[error(
        "ranked must have {} to {} blocks under settings.detector.rule = \"{rule}\", got {got} (`liftsim detect RECORDING \
         --rule {rule} --save-state FILE` writes a state of this rule)",
        .needed.start(), .needed.end()
    )]
    Ranked {
        rule: DecisionRule,
        needed: RangeInclusive<usize>,
        got: usize,
    },
    #[error("longer than {} MiB, which no state is that `--save-state` writes", LONGEST >> 20)]
    TooLong,
}

impl SavedState {
    /// Reads a file.
    ///
    /// # Errors
    /// If it cannot be read, or its parts cannot be used together.
    pub fn load(path: &Path) -> Result<Self, SavedStateError> {
        let read = || {
            let (file, mut text) = (files::open(path)?, String::new());
            let length = file.take(LONGEST + 1).read_to_string(&mut text)?;
            if length as u64 > LONGEST {
                return Err(Problem::TooLong);
            }
            Self::checked(&text)
        };
        read().map_err(|problem| SavedStateError {
            path: path.display().to_string(),
            problem,
        })
    }

    /// Reads and checks a file's text; messages call the file `name`.
    ///
    /// # Errors
    /// Same as [`SavedState::load`].
    pub fn from_json(name: &str, text: &str) -> Result<Self, SavedStateError> {
        Self::checked(text).map_err(|problem| SavedStateError {
            path: name.to_owned(),
            problem,
        })
    }

    fn checked(text: &str) -> Result<Self, Problem> {
        let saved: Self = serde_json::from_str(text)?;
        let in_file = |path: &str| match path {
            "rate" => path.to_owned(),
            path => format!("settings.{path}"),
        };
        saved.design().map_err(|error| error.called(in_file))?;
        if let Some(reference) = &saved.knowledge.reference {
            let (expected, got) = (saved.settings.samples.reference, reference.sample.len());
            if got != expected {
                return Err(Problem::Sample { expected, got });
            }
            let (needed, got) = (saved.ranked(), reference.ranked.len());
            if !needed.contains(&got) {
                let rule = saved.settings.detector.rule;
                return Err(Problem::Ranked { rule, needed, got });
            }
            if reference.level.abs() > STRONGEST {
                return Err(Problem::Level(reference.level));
            }
            if !is_fitted(&reference.coefficients) {
                return Err(Problem::Filter(reference.coefficients.clone()));
            }
        }
        Ok(saved)
    }

    /// With how many blocks the ranks may begin.
    fn ranked(&self) -> RangeInclusive<usize> {
        match self.settings.detector.rule {
            DecisionRule::ThreeSample => 0..=0,
            DecisionRule::Sequential => 1..=MOST_RANKED.max(self.settings.learnt_from()),
        }
    }

    /// The knowledge of a record that begins with this sample.
    pub fn knowledge_of(&self, first: &Sample) -> Knowledge {
        let is_same = self.first_sample == Some((first.time, first.acceleration));
        Knowledge {
            begins_at_rest: self.knowledge.begins_at_rest && is_same,
            ..self.knowledge.clone()
        }
    }

    /// The text of the file.
    pub fn to_json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        json.expect("numbers and names can be written") + "\n"
    }

    /// The settings at the rate.
    ///
    /// # Errors
    /// Same as [`Settings::at`].
    pub fn design(&self) -> Result<Design, SettingsError> {
        self.settings.at(self.rate)
    }
}

/// Whether these coefficients can come from a fit. The zeros of a fitted filter lie in the unit circle, so
/// that no |aₚ| exceeds C(m, p) ≤ C(8, 4), and the response to a constant, 1 − Σ a, is not negative; both up to
/// rounding.
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
            training: settings.whitening.training,
            span: None,
            sample: vec![0.01; settings.samples.reference],
            ranked: vec![0.01; settings.learnt_from()],
        };
        SavedState {
            settings,
            rate: 100.0,
            first_sample: Some((0.0, 9.81)),
            knowledge: Knowledge {
                reference: Some(reference),
                ..Knowledge::default()
            },
            running: None,
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let saved = saved();
        let again = SavedState::from_json("lift.json", &saved.to_json()).unwrap();
        assert_eq!(again, saved);
    }

    type Change<'a> = &'a dyn Fn(&mut SavedState, &mut Reference);

    /// Files that would exhaust the memory or reverse the sign of every start.
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
        let cases: [(&str, Change); 13] = [
            (
                "settings.samples.gap: must lie in [0, 200] blocks, got 18446744073709551615",
                &|saved, _| saved.settings.samples.gap = usize::MAX,
            ),
            (
                "settings.whitening.training: must lie in [24, 100000] blocks, got 1000000",
                &|saved, _| saved.settings.whitening.training = 1_000_000,
            ),
            (
                "settings.samples.shift: must lie in [1, 200] blocks, got 3000",
                &|saved, _| saved.settings.samples.shift = 3000,
            ),
            (
                "settings.monitor.block: must lie in [0.001, 0.5] s, got 0.000001",
                &|saved, _| saved.settings.monitor.block = 1e-6,
            ),
            ("rate: must lie in [2, 1000000] Hz, got 0", &|saved, _| {
                saved.rate = 0.0;
            }),
            ("X must have 24 finite blocks", &|_, reference| {
                reference.sample.truncate(3);
            }),
            ("ranked must have 1 to 768 blocks", &|_, reference| {
                reference.ranked.clear();
            }),
            ("ranked must have 0 to 0 blocks", &|saved, _| {
                saved.settings.detector.rule = DecisionRule::ThreeSample;
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
