//! What an experiment's results are known by before it is run.

use crate::experiment::DEFAULT_PILOT_TRIALS;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Raised whenever the same config and seed come to give other bytes than before, so that results of
/// before are not taken for complete.
pub const RESULTS: u32 = 2;

/// An experiment, and the version that runs it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The config's file name.
    pub config_name: String,
    /// The config's text.
    pub config: String,
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Trials of each pilot run.
    pub pilot: u64,
    /// Whether points share their noise.
    pub common_random_numbers: bool,
    /// Of liftsim.
    pub version: String,
    /// Of the bytes that a config and a seed give: [`RESULTS`] at the time.
    pub results: u32,
}

impl Origin {
    /// Whether results of `there` are those of this experiment, by a version that gives the same bytes.
    pub fn made(&self, there: &Self) -> bool {
        let other = Self {
            version: self.version.clone(),
            common_random_numbers: self.common_random_numbers,
            ..there.clone()
        };
        *self == other
    }

    /// The first thing that keeps two runs from being shares of one, here and there.
    pub fn difference(&self, there: &Self) -> Option<String> {
        let differs = |name, here: &dyn ToString, there: &dyn ToString| {
            let (here, there) = (here.to_string(), there.to_string());
            (here != there).then(|| format!("{name} is {here} and {there}"))
        };
        differs("config", &self.config_name, &there.config_name)
            .or_else(|| differs("version", &self.version, &there.version))
            .or_else(|| differs("results version", &self.results, &there.results))
            .or_else(|| differs("seed", &self.seed, &there.seed))
            .or_else(|| differs("trials", &self.trials, &there.trials))
            .or_else(|| differs("pilot", &self.pilot, &there.pilot))
            .or_else(|| (self.config != there.config).then(|| self.first_line(there)))
    }

    /// The command that makes the same results, wherever the files are.
    pub fn command_line(&self) -> String {
        let Self { seed, trials, .. } = self;
        let name = &self.config_name;
        let command = format!("liftsim sweep {name} --seed {seed} --trials {trials}");
        match self.pilot {
            DEFAULT_PILOT_TRIALS => command,
            pilot => format!("{command} --pilot {pilot}"),
        }
    }

    /// The first line of the config that reads differently.
    fn first_line(&self, there: &Self) -> String {
        let (here, there): (Vec<&str>, Vec<&str>) = (
            self.config.lines().collect(),
            there.config.lines().collect(),
        );
        let at = (0..).find(|&line| here.get(line) != there.get(line));
        let at = at.expect("the texts differ");
        let line = |text: &[&str]| text.get(at).copied().unwrap_or_default().to_owned();
        let (here, there, number) = (line(&here), line(&there), at + 1);
        format!("line {number} of the config is `{here}` and `{there}`")
    }
}

/// Without the way to it.
pub fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or(path.to_owned(), |name| name.to_string_lossy().into_owned())
}
