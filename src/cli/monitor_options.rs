//! What `detect` and `monitor` share: how the monitor is set up.

use super::threshold::{Choice, one_of};
use super::{Failure, completions};
use anyhow::anyhow;
use clap::{Args, ValueEnum};
use liftsim::detection::{MonitorOptions, SLOW};
use liftsim::explain::STRONGEST;
use liftsim::monitor::{DecisionRule, MOST_ORDER, SavedState, Settings};
use liftsim::whiten::Order;
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// How the monitor is set up. Flags go over the config, the config over the defaults.
#[derive(Debug, Args)]
#[command(next_help_heading = "The monitor")]
pub struct MonitorArguments {
    /// Settings, a TOML file; `liftsim keys` prints its keys.
    #[arg(long, value_name = "CONFIG", add = completions::configs(&[]))]
    config: Option<PathBuf>,
    /// Start from a state that `detect --save-state` wrote, settings included.
    #[arg(long, value_name = "FILE", conflicts_with = "config")]
    state: Option<PathBuf>,
    /// What lift it is: for slow, such as a platform of 0.1 m/s, the slowest motion is 0.06 m/s.
    #[arg(long, value_name = "LIFT", value_enum, conflicts_with_all = ["state", "least_speed"])]
    lift: Option<Lift>,
    #[command(flatten)]
    flags: SettingFlags,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Lift {
    /// Passenger and goods lifts, mine cages.
    Usual,
    /// Platforms and hydraulic lifts below 0.2 m/s.
    Slow,
}

/// The settings that have a flag, named as the ends of their keys.
#[derive(Debug, Args, Serialize)]
struct SettingFlags {
    #[arg(long, value_name = "RULE", conflicts_with = "state", value_parser = one_of(&RULES))]
    #[arg(help = help("What must see a motion before it is told", |usual| usual.detector.rule))]
    rule: Option<DecisionRule>,
    #[arg(long, value_name = "A", conflicts_with = "state")]
    #[arg(help = help("The level of each decision; of ranks, false alarms per block", |usual| usual.detector.alpha))]
    alpha: Option<f64>,
    #[arg(long, value_name = "M", conflicts_with = "state", value_parser = order)]
    #[arg(help = help(
        format_args!("The order of the whitening filter, 0 to {MOST_ORDER}, or `auto`: by BIC"),
        |usual| usual.whitening.order,
    ))]
    order: Option<Order>,
    #[arg(long, value_name = "SECONDS", conflicts_with = "state")]
    #[arg(help = help("Seconds that a block mean spans", |usual| usual.monitor.block))]
    block: Option<f64>,
    #[arg(long, value_name = "V", conflicts_with = "state")]
    #[arg(help = help("The speed of the slowest motion, m/s", |usual| usual.monitor.least_speed))]
    least_speed: Option<f64>,
}

static RULES: [Choice<DecisionRule>; 2] = [
    (
        "sequential",
        DecisionRule::Sequential,
        "CUSUMs of sequential ranks",
    ),
    (
        "three-sample",
        DecisionRule::ThreeSample,
        "The three-sample rule on (W, T)",
    ),
];

/// How a record begins.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum Beginning {
    /// The cage stands.
    Rest,
    /// It moves.
    Motion,
    /// It may do either.
    Unknown,
}

impl Beginning {
    /// Whether it stands, if that is known.
    pub fn is_rest(self) -> Option<bool> {
        match self {
            Self::Rest => Some(true),
            Self::Motion => Some(false),
            Self::Unknown => None,
        }
    }
}

/// How the recording is read and the monitor set up.
pub struct Setup {
    /// From the config and the flags.
    pub config: MonitorOptions,
    /// Its settings replace those of the config.
    pub saved: Option<SavedState>,
}

/// Refuses an acceleration beyond what a monitor counts.
pub fn check_strength(acceleration: f64) -> anyhow::Result<()> {
    if acceleration.abs() > STRONGEST {
        return Err(anyhow!(
            "accelerations must lie within {STRONGEST} m/s^2, got {acceleration} (give the unit: --unit g, mg, or \
             counts with --scale)"
        ));
    }
    Ok(())
}

/// What a flag says, with the default of its setting.
fn help<T: Display>(says: impl Display, default: fn(Settings) -> T) -> String {
    format!("{says} [default: {}]", default(Settings::default()))
}

fn order(text: &str) -> Result<Order, String> {
    match text.parse() {
        Ok(order @ 0..=MOST_ORDER) => Ok(Order::Fixed(order)),
        _ if text == "auto" => Ok(Order::Auto),
        _ => Err(format!(
            "must be a whole number up to {MOST_ORDER}, or auto"
        )),
    }
}

impl MonitorArguments {
    /// The file of --state.
    pub fn state(&self) -> Option<&Path> {
        self.state.as_deref()
    }

    /// Reads the config and the state, and lays the flags over them.
    pub fn setup(&self) -> Result<Setup, Failure> {
        let mut config = match &self.config {
            Some(path) => MonitorOptions::load(path).map_err(Failure::input)?,
            None => MonitorOptions::default(),
        };
        let mut given = toml::Table::try_from(&self.flags).map_err(Failure::run)?;
        if self.lift == Some(Lift::Slow) {
            given.insert("least_speed".to_owned(), SLOW.into());
        }
        let flag = |key: &str| format!("--{}", key.replace('_', "-"));
        config.settings = (config.settings.with(&given, flag)).map_err(Failure::input)?;
        let saved = self.state.as_deref().map(SavedState::load);
        Ok(Setup {
            config,
            saved: saved.transpose().map_err(Failure::input)?,
        })
    }
}
