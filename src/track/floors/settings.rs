//! The rule by which stops are judged.

use crate::rule::{OutOfRange, Rule};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The rule by which stops are judged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// γ_s: a larger ξ is an alarm.
    pub threshold: f64,
    /// σ_s, the deviation of stops from their floor, m. EN 81-20 asks for ±10 mm.
    pub level: f64,
    /// The floor that a stop belongs to.
    pub association: Association,
    /// Whether other courses of events are kept than the likeliest: after an alarm, that the trip was wrong.
    pub branches: bool,
    /// The stops over whose median ξ is scaled; 0 does not scale.
    pub window: usize,
    /// The cost of a missed trip; none takes every trip as measured.
    pub missed: Option<f64>,
    /// How far beyond the outermost floors a car can go, m.
    pub overtravel: f64,
    /// A car off by at most so much is out of level; farther off it is in the pit, above the top or between floors, m.
    pub levelling: f64,
    /// The least distance of two floors, m: a stop nearer to a floor than this never becomes another.
    pub least_storey: f64,
}

/// The floor that a stop belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Association {
    /// Least ξ.
    Nearest,
    /// Least ξ + ln S.
    Likeliest,
}

impl Settings {
    /// The patent by its words: 10.83 is the 0.1 % point of χ²₁.
    pub const PRINTED: Self = Self {
        threshold: 10.83,
        association: Association::Nearest,
        branches: false,
        window: 0,
        missed: None,
        ..Self::MENDED
    };

    /// The rule that keeps one false alarm in a thousand stops.
    pub const MENDED: Self = Self {
        threshold: 12.0,
        level: 0.005,
        association: Association::Likeliest,
        branches: true,
        window: 200,
        missed: Some(22.0),
        overtravel: 1.0,
        levelling: 0.2,
        least_storey: 0.5,
    };

    /// Checks the values.
    ///
    /// # Errors
    /// If one breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Positive.check("threshold", &self.threshold)?;
        Rule::Within(1e-5, 0.1, "m").check("level", &self.level)?;
        Rule::Within(0.0, 10_000.0, "stops").check("window", &self.window)?;
        Rule::Positive.check("missed", &self.missed)?;
        Rule::Within(0.0, 100.0, "m").check("overtravel", &self.overtravel)?;
        Rule::Within(0.0, 10.0, "m").check("levelling", &self.levelling)?;
        Rule::Within(0.1, 10.0, "m").check("least_storey", &self.least_storey)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::MENDED
    }
}
