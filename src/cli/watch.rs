//! What `detect` and `monitor` share: how the monitor is set up.

use super::Failure;
use anyhow::anyhow;
use clap::Args;
use liftsim::config::WatchConfig;
use liftsim::monitor::{Briefing, MOST_ORDER, STRONGEST, Settings};
use std::path::PathBuf;

/// How the monitor is set up. Flags go over the config, the config over the defaults.
#[derive(Debug, Args)]
#[command(next_help_heading = "The monitor")]
pub struct Watch {
    /// Settings, a TOML file; see configs/README.md for its keys.
    #[arg(long, value_name = "CONFIG")]
    config: Option<PathBuf>,
    /// Start from a state that `detect --save-state` wrote, settings included.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["config", "alpha", "order", "block", "least_speed"])]
    state: Option<PathBuf>,
    /// The level of each decision [default: 0.001].
    #[arg(long, value_name = "A")]
    alpha: Option<f64>,
    /// The order of the whitening filter, 0 to 8 [default: by BIC].
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u8).range(0..=MOST_ORDER as i64))]
    order: Option<u8>,
    /// Seconds that a block mean spans [default: 0.05].
    #[arg(long, value_name = "SECONDS")]
    block: Option<f64>,
    /// The slowest motion there is, m/s [default: 0.2].
    #[arg(long, value_name = "V")]
    least_speed: Option<f64>,
}

/// What the command line, the config or a saved state come to.
pub struct Told {
    /// From the config and the flags.
    pub config: WatchConfig,
    /// From a saved state, which goes before the settings of the config.
    pub briefing: Option<Briefing>,
}

/// Refuses an acceleration that a monitor would take for a weaker one.
pub fn check_strength(acceleration: f64) -> anyhow::Result<()> {
    match acceleration.abs() > STRONGEST {
        true => Err(anyhow!(
            "accelerations must lie within {STRONGEST} m/s^2, got {acceleration} (are they in another unit?)"
        )),
        false => Ok(()),
    }
}

impl Watch {
    /// Reads what it names.
    pub fn told(&self) -> Result<Told, Failure> {
        let mut config = match &self.config {
            Some(path) => WatchConfig::load(path).map_err(Failure::input)?,
            None => WatchConfig::default(),
        };
        let settings = &mut config.settings;
        *settings = Settings {
            alpha: self.alpha.unwrap_or(settings.alpha),
            order: self.order.map(usize::from).or(settings.order),
            block: self.block.unwrap_or(settings.block),
            least_speed: self.least_speed.unwrap_or(settings.least_speed),
            ..settings.clone()
        };
        settings.check().map_err(Failure::input)?;
        let briefing = self.state.as_deref().map(Briefing::load);
        Ok(Told {
            config,
            briefing: briefing.transpose().map_err(Failure::input)?,
        })
    }
}
