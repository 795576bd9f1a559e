//! The tables that say what to draw, as they stand in the file: one of them takes the place of
//! `[axis]` and `[[curve]]`.

use super::file::RuleKind;
use super::value::{Number, Whole};
use serde::Deserialize;
use toml::Spanned;

/// `[autocorrelation]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AutocorrelationTable {
    pub lags: Option<Spanned<Whole>>,
    pub length: Option<Spanned<Whole>>,
}

/// `[trace]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TraceTable {
    pub phases: Spanned<Vec<Spanned<PhaseTable>>>,
    pub rate: Option<Spanned<Number>>,
    pub sigma: Option<Spanned<Number>>,
    pub unit: Option<Spanned<String>>,
    pub vibration: Option<Spanned<Number>>,
    pub whitened: Option<Spanned<bool>>,
    pub drawn_from: Option<Spanned<Whole>>,
}

/// One of `trace.phases`, its length in samples.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum PhaseTable {
    Rest(Whole),
    Acceleration(Whole),
    Inertial(Whole),
    Braking(Whole),
}

/// `[layout]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LayoutTable {}

/// `[region]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionTable {
    pub rules: Spanned<Vec<Spanned<RuleKind>>>,
}

/// `[independence]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IndependenceTable {
    pub sizes: Spanned<Vec<Spanned<[Whole; 3]>>>,
}

/// `[impulse_law]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImpulseLawTable {
    pub nu: Spanned<Vec<Spanned<Number>>>,
    pub length: Option<Spanned<Whole>>,
}
