//! The identity of an experiment's results, known before it is run.

use crate::experiment::DEFAULT_PILOT_TRIALS;
use crate::format::shorten;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The version of the results. Raise it in the first change after a release by which the same config and seed give different
/// bytes, so that results of the release do not count as complete.
pub const RESULTS: u32 = 2;

/// An experiment and the version of liftsim that runs it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The config's file name.
    pub config_name: String,
    /// The config's text.
    pub config: String,
    /// The seed of all draws.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Trials of each pilot run.
    pub pilot: u64,
    /// Whether points share their noise.
    pub common_random_numbers: bool,
    /// The version of liftsim.
    pub version: String,
    /// The value of [`RESULTS`] at the time of the run.
    pub results: u32,
}

impl Origin {
    /// Whether results with the origin `there` belong to this experiment and have the same bytes.
    pub fn made(&self, there: &Self) -> bool {
        let other = Self {
            version: self.version.clone(),
            common_random_numbers: self.common_random_numbers,
            ..there.clone()
        };
        *self == other
    }

    /// The first difference that prevents two runs from being shards of one, in words.
    pub fn difference(&self, there: &Self) -> Option<String> {
        let differs = |name, here: &dyn ToString, there: &dyn ToString| {
            let (here, there) = (here.to_string(), there.to_string());
            (here != there).then(|| format!("{name} is {} and {}", shorten(&here), shorten(&there)))
        };
        differs("config", &self.config_name, &there.config_name)
            .or_else(|| differs("version", &self.version, &there.version))
            .or_else(|| differs("results version", &self.results, &there.results))
            .or_else(|| differs("seed", &self.seed, &there.seed))
            .or_else(|| differs("trials", &self.trials, &there.trials))
            .or_else(|| differs("pilot", &self.pilot, &there.pilot))
            .or_else(|| (self.config != there.config).then(|| self.first_line(there)))
    }

    /// The command that gives the same results, independent of where the files are.
    pub fn command_line(&self) -> String {
        let Self { seed, trials, .. } = self;
        let name = &self.config_name;
        let command = format!("liftsim sweep {name} --seed {seed} --trials {trials}");
        match self.pilot {
            DEFAULT_PILOT_TRIALS => command,
            pilot => format!("{command} --pilot {pilot}"),
        }
    }

    /// The first line in which the configs differ, in words.
    fn first_line(&self, there: &Self) -> String {
        let (here, there): (Vec<&str>, Vec<&str>) = (
            self.config.lines().collect(),
            there.config.lines().collect(),
        );
        let at = (0..).find(|&line| here.get(line) != there.get(line));
        let at = at.expect("the texts differ");
        let line = |text: &[&str]| text.get(at).copied().unwrap_or_default().to_owned();
        let (here, there, number) = (line(&here), line(&there), at + 1);
        let (here, there) = (shorten(&here), shorten(&there));
        format!("line {number} of the config is `{here}` and `{there}`")
    }
}

/// The file name of a path.
pub fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or(path.to_owned(), |name| name.to_string_lossy().into_owned())
}
