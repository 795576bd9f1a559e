//! The keys at the top of every config.

use crate::config::Conflict;
use crate::plot::Options;
use crate::rule::OutOfRange;
use crate::stats::tally::{MOST_TRIALS, trials_for_half_width};
use crate::values::{Level, bounded_f64};
use schemars::JsonSchema;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};

/// The keys at the top of a config.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// What the experiment is for, one sentence.
    pub question: String,
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials per point.
    #[serde(default, deserialize_with = "trials")]
    #[schemars(range(min = 1, max = MOST_TRIALS))]
    trials: Option<u64>,
    /// Half of the widest interval; fixes the number of trials before the run.
    #[serde(default)]
    half_width: Option<HalfWidth>,
    /// Confidence of the intervals.
    #[serde(default = "usual_confidence")]
    pub confidence: Level,
    /// Whether one noise realisation serves every point that can share it.
    #[serde(default = "shared")]
    pub common_random_numbers: bool,
    /// Trials of each pilot run.
    #[serde(default = "usual_pilot", deserialize_with = "pilot")]
    #[schemars(range(min = 1, max = MOST_PILOT_TRIALS))]
    pub pilot: u64,
    /// Whether only the points at rest are run.
    #[serde(default)]
    pub at_rest: bool,
    /// How the figure is drawn.
    #[serde(default)]
    pub figure: Options,
}

bounded_f64! {
    /// Half of the widest interval.
    HalfWidth: "lie in [0.00001, 0.5)", |x| (1e-5..0.5).contains(&x),
        { "type": "number", "minimum": 1e-5, "exclusiveMaximum": 0.5 };
}

/// Trials per point if the file does not set them.
const DEFAULT_TRIALS: u64 = 200_000;

/// Trials of a pilot run if neither the file nor the command line sets them.
pub const DEFAULT_PILOT_TRIALS: u64 = 200_000;

/// The largest number of trials of a pilot run. It is limited because a pilot keeps its trials in memory.
pub const MOST_PILOT_TRIALS: u64 = 10_000_000;

fn usual_confidence() -> Level {
    Level::new(0.95).expect("it is in its range")
}

fn shared() -> bool {
    true
}

fn usual_pilot() -> u64 {
    DEFAULT_PILOT_TRIALS
}

fn trials<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u64>, D::Error> {
    match u64::deserialize(deserializer)? {
        0 => Err(D::Error::custom("must be at least 1, got 0")),
        trials if trials > MOST_TRIALS => {
            let message = format!("must be at most {MOST_TRIALS}, got {trials}");
            Err(D::Error::custom(message))
        }
        trials => Ok(Some(trials)),
    }
}

fn pilot<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
    match u64::deserialize(deserializer)? {
        trials @ 1..=MOST_PILOT_TRIALS => Ok(trials),
        trials => Err(D::Error::custom(format_args!(
            "must lie between 1 and {MOST_PILOT_TRIALS} trials, got {trials}"
        ))),
    }
}

impl Header {
    /// Trials per point.
    pub fn trials(&self) -> u64 {
        self.trials.unwrap_or(DEFAULT_TRIALS)
    }

    /// Sets the number of trials and overrides the file.
    pub fn set_trials(&mut self, trials: u64) {
        self.trials = Some(trials);
    }

    /// Computes the number of trials if the file gives the width of an interval instead.
    pub(super) fn settle(&mut self) -> Result<(), Conflict> {
        let Some(half_width) = self.half_width.map(HalfWidth::get) else {
            return Ok(());
        };
        if self.trials.is_some() {
            let rule = "be left out where trials is given";
            let remedy = " (both fix the number of trials: leave one of them out)";
            let unfit = OutOfRange::new("half_width", rule, half_width);
            return Err(unfit.explained(remedy).into());
        }
        let trials = trials_for_half_width(half_width, self.confidence.get());
        self.set_trials(trials);
        Ok(())
    }
}
