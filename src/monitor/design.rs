//! Settings at one sampling rate: blocks of whole samples, the region of the decisions.

use super::settings::{DecisionRule, LONGEST_BLOCK, Settings, SettingsError, WHY_SHORT};
use crate::detect::sequential::{Chart, Detector, Score, Side};
use crate::detect::{Alternative, Exceedances, NullLaws, Region, Rule, Samples};
use crate::rule::{Explained, OutOfRange, Rule as Bounds};
use serde::{Deserialize, Serialize};

/// k of the sequential ranks.
const ALLOWANCE: f64 = 0.8;

/// Settings at one sampling rate.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub struct Design {
    pub settings: Settings,
    /// The sizes, with the number of samples in a block as decimation.
    pub samples: Samples,
    /// ϑ, for Δ of either sign.
    pub region: Region,
    /// The detector of sequential ranks, if it decides.
    pub ranks: Option<Detector>,
    /// Seconds from one block to the next.
    pub block: f64,
    /// Samples per second.
    pub rate: f64,
}

impl Design {
    /// The same settings at another rate, at which region and ranks are those that they are.
    ///
    /// # Errors
    /// If the rate is too low.
    pub fn at(&self, rate: f64) -> Result<Self, SettingsError> {
        let (samples, block) = self.settings.blocks(rate)?;
        Ok(Self {
            samples,
            block,
            rate,
            ..self.clone()
        })
    }
}

impl Settings {
    /// Checks the settings independently of the rate.
    ///
    /// # Errors
    /// Same as [`Settings::at`].
    pub fn check(&self) -> Result<(), SettingsError> {
        self.nominal().map(drop)
    }

    /// The settings at the rate of one sample in each block.
    ///
    /// # Errors
    /// Same as [`Settings::at`].
    pub fn nominal(&self) -> Result<Design, SettingsError> {
        self.at(1.0 / self.monitor.block.clamp(1e-6, 1.0))
    }

    /// The settings at `rate` samples per second.
    ///
    /// # Errors
    /// If a value is out of its range, or no region has the level asked for.
    pub fn at(&self, rate: f64) -> Result<Design, SettingsError> {
        self.check_each()?;
        let (least, most) = (
            self.monitor.least_acceleration,
            self.monitor.most_acceleration,
        );
        if most <= least {
            let rule = format_args!("exceed least_acceleration = {least}");
            return Err(OutOfRange::new("monitor.most_acceleration", rule, most).into());
        }
        let (samples, block) = self.blocks(rate)?;
        let laws = NullLaws::new(Exceedances::Scale, Alternative::TwoSided, &samples)?;
        Ok(Design {
            region: laws.region(&Rule::Product, self.detector.alpha)?,
            ranks: match self.detector.rule {
                DecisionRule::ThreeSample => None,
                DecisionRule::Sequential => Some(self.ranks()?),
            },
            block,
            settings: self.clone(),
            samples,
            rate,
        })
    }

    /// The sizes in blocks of whole samples, and the length of such a block, s.
    fn blocks(&self, rate: f64) -> Result<(Samples, f64), OutOfRange> {
        let least = 1.0 / LONGEST_BLOCK;
        // A measured rate is hardly ever exact.
        if !(0.99 * least..least).contains(&rate) {
            let rule = Explained(Bounds::Within(least, 1e6, "Hz"), WHY_SHORT);
            rule.check("rate", &rate)?;
        }
        // Fractions below three quarters are rounded down, so that 10, 30 and 50 Hz are not on the edge between
        // two lengths.
        let decimation = (self.monitor.block * rate + 0.25).floor().max(1.0) as usize;
        let sizes = &self.samples;
        let samples = Samples::new(
            sizes.reference,
            sizes.shift,
            sizes.scale,
            sizes.gap,
            decimation,
        );
        let samples = samples.expect("each size has been checked");
        Ok((samples, decimation as f64 / rate))
    }

    /// The detector that alarms at most once in 1/α blocks of rest, on average.
    fn ranks(&self) -> Result<Detector, SettingsError> {
        let sides = [Side::Up, Side::Down];
        let chart = Chart::new(Score::Normal, &sides, ALLOWANCE, self.learnt_from())?;
        let threshold = chart.threshold(1.0 / self.detector.alpha);
        let keys = ["detector.alpha", "whitening.training"];
        let threshold = threshold.map_err(|error| error.per_hour(keys, 1.0))?;
        Ok(chart.detector(threshold))
    }

    /// The fewest blocks of rest that a reference is learnt from.
    pub(crate) fn learnt_from(&self) -> usize {
        self.whitening.training + self.samples.reference
    }
}
