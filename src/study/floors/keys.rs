//! The keys of `[floors]`.

use super::building::Traffic;
use super::measure::Measure;
use crate::rule::{OutOfRange, Rule};
use crate::track::floors::{Association, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The keys of a point, with their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Keys {
    /// Floors of the building.
    pub floors: usize,
    /// Height of a storey, m.
    pub storey: f64,
    /// Deviation of the storeys' heights, m; drawn anew for each building.
    pub uneven: f64,
    /// σ_s: deviation of a stop from its floor, in truth and for the map, m.
    pub level: f64,
    /// True deviation of a trip over the claimed one.
    pub noise: f64,
    /// Where trips go.
    pub traffic: Traffic,
    /// Trips between the first sweep and what is measured.
    pub trips: usize,
    /// Storeys of the trip that ends beside its floor.
    pub storeys: usize,
    /// Storeys of the trip after it.
    pub next_storeys: usize,
    /// How far from its floor it ends, m, up or down.
    pub offset: f64,
    /// Trips since one was missed.
    pub since: usize,
    /// Deviation of the height of the middle floor, as if from a plan, m; 0 leaves it as swept.
    pub vague: f64,
    /// The rule by which stops are judged.
    pub rule: JudgingRule,
    /// γ_s, in place of the rule's own.
    pub threshold: Option<f64>,
    /// In place of the rule's own.
    pub association: Option<Association>,
    /// The stops over whose median ξ is scaled, in place of the rule's own; 0 does not scale.
    pub window: Option<usize>,
}

/// The rule by which stops are judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JudgingRule {
    /// The patent by its words: γ_s = 10.83, nearest by ξ, one course of events.
    Printed,
    /// γ_s = 12, nearest by ξ + ln S, every course of events, ξ scaled.
    #[default]
    Mended,
}

impl Default for Keys {
    fn default() -> Self {
        Self {
            floors: 10,
            storey: 3.0,
            uneven: 0.0,
            level: 0.002,
            noise: 1.0,
            traffic: Traffic::default(),
            trips: 1000,
            storeys: 1,
            next_storeys: 1,
            offset: 0.0,
            since: 25,
            vague: 0.0,
            rule: JudgingRule::default(),
            threshold: None,
            association: None,
            window: None,
        }
    }
}

/// More trips make a trial of minutes.
const MOST_TRIPS: f64 = 100_000.0;

impl Keys {
    /// The settings of the map.
    pub fn settings(&self) -> Settings {
        let rule = match self.rule {
            JudgingRule::Printed => Settings::PRINTED,
            JudgingRule::Mended => Settings::MENDED,
        };
        Settings {
            level: self.level,
            threshold: self.threshold.unwrap_or(rule.threshold),
            association: self.association.unwrap_or(rule.association),
            window: self.window.unwrap_or(rule.window),
            ..rule
        }
    }

    /// Checks the values.
    ///
    /// # Errors
    /// If one breaks its rule, or they do not fit each other.
    pub fn check(&self, measure: Measure) -> Result<(), OutOfRange> {
        Rule::Within(2.0, 60.0, "").check("floors", &self.floors)?;
        Rule::Within(0.6, 100.0, "m").check("storey", &self.storey)?;
        Rule::Within(0.0, 0.05 * self.storey, "m").check("uneven", &self.uneven)?;
        Rule::Within(0.1, 100.0, "").check("noise", &self.noise)?;
        Rule::Within(0.0, MOST_TRIPS, "").check("trips", &self.trips)?;
        let most = (self.floors - 1) as f64;
        Rule::Within(1.0, most, "").check("storeys", &self.storeys)?;
        Rule::Within(1.0, most, "").check("next_storeys", &self.next_storeys)?;
        Rule::Within(0.0, 0.45 * self.storey, "m").check("offset", &self.offset)?;
        Rule::Within(1.0, 10_000.0, "").check("since", &self.since)?;
        Rule::Within(0.0, 10.0, "m").check("vague", &self.vague)?;
        if measure == Measure::Stops {
            Rule::Within(1.0, MOST_TRIPS, "").check("trips", &self.trips)?;
        }
        self.settings().check()
    }
}
