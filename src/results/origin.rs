//! What an experiment's results are known by before it is run.

use super::{Manifest, RESULTS};
use crate::config::{Config, ConfigError, DEFAULT_PILOT_TRIALS, ExhibitConfig};
use serde::{Deserialize, Serialize};
use std::path::Path;

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

impl From<&Config> for Origin {
    fn from(config: &Config) -> Self {
        Self {
            config_name: file_name(config.name()),
            config: config.text().to_owned(),
            seed: config.seed,
            trials: config.trials,
            pilot: config.pilot,
            common_random_numbers: config.common_random_numbers,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            results: RESULTS,
        }
    }
}

impl From<&ExhibitConfig> for Origin {
    fn from(config: &ExhibitConfig) -> Self {
        Self {
            config_name: file_name(config.name()),
            config: config.text().to_owned(),
            seed: config.seed,
            trials: config.trials,
            pilot: DEFAULT_PILOT_TRIALS,
            common_random_numbers: true,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            results: RESULTS,
        }
    }
}

impl From<&Manifest> for Origin {
    fn from(manifest: &Manifest) -> Self {
        Self {
            config_name: manifest.config_name.clone(),
            config: manifest.config.clone(),
            seed: manifest.seed,
            trials: manifest.trials,
            pilot: manifest.pilot,
            common_random_numbers: manifest.common_random_numbers,
            version: manifest.version.clone(),
            results: manifest.results,
        }
    }
}

impl Origin {
    /// Whether results with this manifest are those of this experiment, by a version that gives the same
    /// bytes.
    pub fn made(&self, manifest: &Manifest) -> bool {
        let other = Self {
            version: self.version.clone(),
            common_random_numbers: self.common_random_numbers,
            ..Self::from(manifest)
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

    /// The first line of the config that reads differently.
    fn first_line(&self, there: &Self) -> String {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        let (here, there) = (lines(&self.config), lines(&there.config));
        let at = (0..).find(|&line| here.get(line) != there.get(line));
        let at = at.expect("the texts differ");
        let line = |text: &[String]| text.get(at).cloned().unwrap_or_default();
        let (here, there, number) = (line(&here), line(&there), at + 1);
        format!("line {number} of the config is `{here}` and `{there}`")
    }

    /// The config of a sweep, with the numbers of this run in place of its own.
    ///
    /// # Errors
    /// Where the text is none.
    pub fn sweep(&self) -> Result<Config, ConfigError> {
        let mut config = Config::parse(&self.config_name, &self.config)?;
        config.seed = self.seed;
        config.trials = self.trials;
        config.pilot = self.pilot;
        Ok(config)
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
}

/// Without the way to it.
pub fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or(path.to_owned(), |name| name.to_string_lossy().into_owned())
}
