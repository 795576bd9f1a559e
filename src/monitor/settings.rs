//! The settings of a monitor, used by the TOML of `detect --config`, `[ride]` studies, flags and saved states. A
//! setting is one line of the table below.
//!
//! Times are in seconds and sizes in *blocks*: means of a whole number of samples, about `monitor.block` long.
//! Twelve samples at 100 Hz are 0.12 s, while a lift takes 0.5 to 1.5 s to gain speed; twelve blocks are about 0.6 s
//! at any rate that gives a block more than a sample or two. A block mean is the best estimate of a constant
//! level in white noise, and the first zero of its frequency response lies at the block rate, which is enough
//! anti-aliasing for ranks of levels.

use crate::detect::{NullLawError, RegionError};
use crate::rule::{Checked, Explained, OutOfRange, Rule};
pub use crate::whiten::MOST_ORDER;
use crate::whiten::Order;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The fewest blocks that a filter is fitted to; they still allow a choice among a few orders.
pub(crate) const LEAST_TRAINING: usize = 24;

/// The longest block, s: a lift gains speed in about a second.
pub(super) const LONGEST_BLOCK: f64 = 0.5;

pub(super) const WHY_SHORT: &str = " (a lift gains speed in about a second)";

const BLOCK: Explained = Explained(Rule::Within(0.001, LONGEST_BLOCK, "s"), WHY_SHORT);

/// The exact laws of larger samples take hours.
const SIZE: Rule = Rule::Within(1.0, 200.0, "blocks");

/// The most blocks last more than an hour and need a few megabytes.
const TRAINING: Rule = Rule::Within(LEAST_TRAINING as f64, 1e5, "blocks");

/// The tables with their keys: meaning, type, default and rule.
macro_rules! settings {
    ($(
        $(#[$about:meta])*
        $table:ident: $type:ident {
            $($(#[$meaning:meta])* $key:ident: $kind:ty = $default:expr, $rule:expr;)*
        }
    )*) => {
        /// All of them, by the tables of the file.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub struct Settings {
            $($(#[$about])* pub $table: $type,)*
        }

        $(
            $(#[$about])*
            #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
            #[serde(deny_unknown_fields, default)]
            pub struct $type {
                $($(#[$meaning])* pub $key: $kind,)*
            }

            impl Default for $type {
                fn default() -> Self {
                    Self { $($key: $default),* }
                }
            }
        )*

        impl Settings {
            /// Every key as a path; the last words are unique.
            pub const KEYS: &[&'static str] =
                &[$($(concat!(stringify!($table), ".", stringify!($key))),*),*];

            pub(super) fn check_each(&self) -> Result<(), OutOfRange> {
                $($($rule.check(
                    concat!(stringify!($table), ".", stringify!($key)),
                    &self.$table.$key,
                )?;)*)*
                Ok(())
            }
        }
    };
}

settings! {
    /// The three samples of a decision.
    samples: Sizes {
        /// N, the size of X.
        reference: usize = 24, SIZE;
        /// M₁, the size of Y₁.
        shift: usize = 12, SIZE;
        /// M₂, the size of Y₂.
        scale: usize = 12, SIZE;
        /// Blocks skipped between Y₁ and Y₂.
        gap: usize = 0, Rule::Within(0.0, 200.0, "blocks");
    }
    /// The filter that is learnt from rest.
    whitening: Whitening {
        /// Order of the filter, or "auto": by BIC.
        order: Order = Order::Auto, Rule::Within(0.0, MOST_ORDER as f64, "");
        /// Blocks of rest before X, when the filter is learnt anew.
        training: usize = 72, TRAINING;
    }
    /// What decides between rest and motion, for Δ of either sign.
    detector: Level {
        /// The rule.
        rule: DecisionRule = DecisionRule::Sequential, Any;
        /// The level of each decision; of `sequential`, the rate of false alarms per block.
        alpha: f64 = 0.001, Rule::Level;
    }
    /// What a motion is.
    monitor: Limits {
        /// Length of a block, s.
        block: f64 = 0.05, BLOCK;
        /// The slowest motion there is, m/s: a pulse of acceleration changes the speed by that much.
        least_speed: f64 = 0.2, Rule::Positive;
        /// The weakest acceleration of a start or a stop, m/s².
        least_acceleration: f64 = 0.1, Rule::Positive;
        /// The strongest, m/s²: what exceeds it is a shock, a jam or a sensor being carried about.
        most_acceleration: f64 = 2.5, Rule::Positive;
        /// The longest motion, s: after that the state is unknown.
        longest_motion: f64 = 900.0, Rule::Positive;
        /// For how long the drum may turn while the cage stands, s.
        longest_slack: f64 = 3.0, Rule::Positive;
    }
}

impl Settings {
    /// The path of the key with this last word.
    pub fn path(key: &str) -> Option<&'static str> {
        let mut keys = Self::KEYS.iter().copied();
        keys.find(|path| last_word(path) == key)
    }

    /// The last words of all keys.
    pub fn names() -> impl Iterator<Item = &'static str> + Clone {
        Self::KEYS.iter().map(|path| last_word(path))
    }

    /// These settings with some values replaced, by the last words of their keys.
    ///
    /// # Errors
    /// If a value breaks its rule; `called` turns the last word of its key into the name in the message.
    ///
    /// # Panics
    /// If a value has the wrong type for its key.
    pub fn with(
        &self,
        values: &toml::Table,
        called: impl Fn(&str) -> String,
    ) -> Result<Self, SettingsError> {
        let mut tables = toml::Table::try_from(self).expect("settings are plain data");
        for (key, value) in values {
            let (table, _) =
                (Self::path(key).and_then(|path| path.split_once('.'))).expect("a known key");
            tables[table][key] = value.clone();
        }
        let changed: Self = tables.try_into().expect("values of their types");
        match changed.check() {
            Ok(()) => Ok(changed),
            Err(error) => Err(error.called(|path| called(last_word(path)))),
        }
    }
}

/// What decides at every block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DecisionRule {
    /// `product` on (W, T).
    ThreeSample,
    /// CUSUMs of sequential ranks, up and down.
    #[default]
    Sequential,
}

impl fmt::Display for DecisionRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// The rule of what is right by its type.
struct Any;

impl Any {
    fn check<T>(&self, _: &str, _: &T) -> Result<(), OutOfRange> {
        Ok(())
    }
}

/// Why settings were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum SettingsError {
    #[error(transparent)]
    Value(#[from] OutOfRange),
    #[error(transparent)]
    Law(#[from] NullLawError),
    #[error(transparent)]
    Region(#[from] RegionError),
}

impl SettingsError {
    /// The path of the setting to change, or `rate`.
    pub fn key(&self) -> &str {
        match self {
            Self::Value(error) => &error.key,
            Self::Law(_) => "samples.reference",
            Self::Region(_) => "detector.alpha",
        }
    }

    /// The same error for a key that the user does not write as a path.
    #[must_use]
    pub fn called(mut self, name: impl Fn(&str) -> String) -> Self {
        if let Self::Value(error) = &mut self {
            error.key = name(&error.key);
        }
        self
    }
}

impl Checked for Order {
    fn written(&self) -> Option<(f64, String)> {
        match self {
            Self::Fixed(order) => order.written(),
            Self::Auto => None,
        }
    }
}

/// `alpha` of `detector.alpha`.
pub(super) fn last_word(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_known_by_its_last_word() {
        for path in Settings::KEYS {
            assert_eq!(Settings::path(last_word(path)), Some(*path));
        }
    }

    #[test]
    fn values_by_last_words() {
        let values = "alpha = 0.5\norder = 2\n".parse().unwrap();
        let changed = Settings::default().with(&values, str::to_owned).unwrap();
        assert_eq!(
            (changed.detector.alpha, changed.whitening.order),
            (0.5, Order::Fixed(2))
        );
        let far = "least_speed = -1.0".parse().unwrap();
        let refused = Settings::default().with(&far, |key| format!("--{key}"));
        assert_eq!(
            refused.unwrap_err().to_string(),
            "--least_speed: must be positive and finite, got -1"
        );
    }
}
