//! What a monitor is told, and what that comes to at one sampling rate.
//!
//! Times are in seconds and sizes in *blocks*: means of a whole number of samples, about
//! [`Settings::block`] long. Twelve samples at 100 Hz are 0.12 s, while a lift takes 0.5 to 1.5 s to gain
//! speed; twelve blocks are about 0.6 s wherever a block has more than a sample or two. A block mean is the
//! best estimate of a constant level in white noise, and the first zero of its frequency response lies at
//! the block rate, which is all the anti-aliasing that ranks of levels need.

use crate::detect::{
    Alternative, NullLawError, NullLaws, Region, RegionError, Rule, Samples, SamplesError,
};
pub use crate::whiten::MOST_ORDER;
use crate::whiten::Order;
use serde::{Deserialize, Serialize};

/// What a monitor is told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// Length of a block, s.
    pub block: f64,
    /// N, blocks.
    pub reference: usize,
    /// M₁, blocks.
    pub shift: usize,
    /// M₂, blocks.
    pub scale: usize,
    /// Blocks skipped between Y₁ and Y₂.
    pub gap: usize,
    /// The level of each decision.
    pub alpha: f64,
    /// Blocks of rest that the whitening filter is fitted to.
    pub training: usize,
    /// Its order.
    pub order: Order,
    /// The slowest motion there is, m/s: a pulse of acceleration changes the speed by that much.
    pub least_speed: f64,
    /// The weakest acceleration of a start or a stop, m/s².
    pub least_acceleration: f64,
    /// The strongest, m/s²: what exceeds it is a shock, a jam or a sensor being carried about.
    pub most_acceleration: f64,
    /// The longest motion, s: after that the state is unknown.
    pub longest_motion: f64,
    /// For how long the drum may turn while the cage stands, s.
    pub longest_slack: f64,
}

/// Blocks that a filter needs: the choice of its order is then among few.
pub(super) const LEAST_TRAINING: usize = 24;

/// Blocks in a sample, or between two: the exact laws take seconds there, and hours at ten times as many.
const MOST_BLOCKS: usize = 200;

/// Blocks that a filter may be fitted to: more than an hour, in a few megabytes.
const MOST_TRAINING: usize = 100_000;

/// s: a lift gains speed in about a second.
const LONGEST_BLOCK: f64 = 0.5;

/// Settings at one sampling rate.
#[derive(Clone, Debug)]
pub struct Design {
    /// As told.
    pub settings: Settings,
    /// Sizes, with as many samples in a block as its length comes to.
    pub samples: Samples,
    /// ϑ, for Δ of either sign.
    pub region: Region,
    /// Seconds from one block to the next.
    pub block: f64,
    /// Samples per second.
    pub rate: f64,
}

/// Why settings were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// The sampling rate is none.
    #[error("rate must lie in [1, 1e6] Hz, got {0}")]
    Rate(f64),
    /// A quantity is not positive.
    #[error("{name} must be positive and finite, got {value}")]
    NotPositive {
        /// Which.
        name: &'static str,
        /// As given.
        value: f64,
    },
    /// A sample takes longer than half a start.
    #[error("rate must be at least 2 Hz, got {0} (a lift gains speed in about a second)")]
    TooSlow(f64),
    /// A block takes longer than a start, or no time at all.
    #[error("block must lie in [0.001, 0.5] s, got {0} s (a lift gains speed in about a second)")]
    Block(f64),
    /// More blocks than a monitor has the time and the memory for.
    #[error("{name} must be at most {most} blocks, got {got}")]
    TooMany {
        /// Which.
        name: &'static str,
        /// As many as are allowed.
        most: usize,
        /// As given.
        got: usize,
    },
    /// No acceleration is between the weakest and the strongest.
    #[error("most_acceleration must exceed least_acceleration = {least}, got {most}")]
    Accelerations {
        /// The weakest.
        least: f64,
        /// The strongest.
        most: f64,
    },
    /// A filter of an order that cannot be fitted.
    #[error("order must be at most {MOST_ORDER}, got {0}")]
    Order(usize),
    /// Too few blocks to fit a filter to.
    #[error("training must be at least {needed} blocks, got {got}")]
    Training {
        /// As many as the filter needs.
        needed: usize,
        /// As given.
        got: usize,
    },
    /// Sizes.
    #[error(transparent)]
    Samples(#[from] SamplesError),
    /// The exact laws.
    #[error(transparent)]
    Law(#[from] NullLawError),
    /// The region.
    #[error(transparent)]
    Region(#[from] RegionError),
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            block: 0.05,
            reference: 24,
            shift: 12,
            scale: 12,
            gap: 0,
            alpha: 0.001,
            training: 72,
            order: Order::Auto,
            least_speed: 0.2,
            least_acceleration: 0.1,
            most_acceleration: 2.5,
            longest_motion: 900.0,
            longest_slack: 3.0,
        }
    }
}

impl SettingsError {
    /// The setting to change.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Rate(_) | Self::TooSlow(_) => "rate",
            Self::NotPositive { name, .. } | Self::TooMany { name, .. } => name,
            Self::Block(_) => "block",
            Self::Accelerations { .. } => "most_acceleration",
            Self::Order(_) => "order",
            Self::Training { .. } => "training",
            Self::Samples(SamplesError::Reference) | Self::Law(_) => "reference",
            Self::Samples(SamplesError::Shift) => "shift",
            Self::Samples(SamplesError::Scale) => "scale",
            Self::Samples(SamplesError::Decimation) => "block",
            Self::Region(_) => "alpha",
        }
    }
}

impl Settings {
    /// Whether they can be used, whatever the rate.
    ///
    /// # Errors
    /// As [`Settings::at`].
    pub fn check(&self) -> Result<(), SettingsError> {
        self.at(1.0 / self.block.clamp(1e-6, 1.0)).map(drop)
    }

    /// The same at `rate` samples per second.
    ///
    /// # Errors
    /// Where a value is out of its range, or no region has the level asked for.
    pub fn at(&self, rate: f64) -> Result<Design, SettingsError> {
        self.check_values(rate)?;
        // Rounded down up to three quarters, so that 10, 30 and 50 Hz are not on the edge between two lengths.
        let decimation = (self.block * rate + 0.25).floor().max(1.0) as usize;
        if decimation as f64 / rate > LONGEST_BLOCK {
            return Err(SettingsError::TooSlow(rate));
        }
        let samples = Samples::new(self.reference, self.shift, self.scale, self.gap, decimation)?;
        let laws = NullLaws::new(Alternative::TwoSided, &samples)?;
        Ok(Design {
            region: laws.region(&Rule::Product, self.alpha)?,
            block: decimation as f64 / rate,
            settings: self.clone(),
            samples,
            rate,
        })
    }

    fn check_values(&self, rate: f64) -> Result<(), SettingsError> {
        for (name, value) in [
            ("block", self.block),
            ("least_speed", self.least_speed),
            ("least_acceleration", self.least_acceleration),
            ("most_acceleration", self.most_acceleration),
            ("longest_motion", self.longest_motion),
            ("longest_slack", self.longest_slack),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SettingsError::NotPositive { name, value });
            }
        }
        if !(0.001..=LONGEST_BLOCK).contains(&self.block) {
            return Err(SettingsError::Block(self.block));
        }
        if !(1.0..=1e6).contains(&rate) {
            return Err(SettingsError::Rate(rate));
        }
        for (name, most, got) in [
            ("reference", MOST_BLOCKS, self.reference),
            ("shift", MOST_BLOCKS, self.shift),
            ("scale", MOST_BLOCKS, self.scale),
            ("gap", MOST_BLOCKS, self.gap),
            ("training", MOST_TRAINING, self.training),
        ] {
            if got > most {
                return Err(SettingsError::TooMany { name, most, got });
            }
        }
        let (least, most) = (self.least_acceleration, self.most_acceleration);
        if most <= least {
            return Err(SettingsError::Accelerations { least, most });
        }
        if let Order::Fixed(order) = self.order
            && order > MOST_ORDER
        {
            return Err(SettingsError::Order(order));
        }
        let needed = LEAST_TRAINING;
        match self.training < needed {
            true => Err(SettingsError::Training {
                needed,
                got: self.training,
            }),
            false => Ok(()),
        }
    }
}
