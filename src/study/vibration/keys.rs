//! The keys of `[vibration]`.

use crate::rule::{OutOfRange, Rule};
use crate::track::vibration::{Guard, Stop};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The keys of a point, with their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Keys {
    /// How the car shakes at full speed, m/s²: the deviation in each direction, on average along the shaft.
    pub vibration: f64,
    /// How unlike places of the shaft are: the deviation of the logarithm of the energy.
    pub uneven: f64,
    /// The knock at a joint of the rails, every 5 m, at full speed, m/s²; each differs.
    pub joints: f64,
    /// How unlike trips are: the deviation of the logarithm of the energy; its mean is that of trips alike.
    pub unlike: f64,
    /// The rule by which learning stops.
    pub stop: Stop,
    /// So many trips are learnt in place of the rule.
    pub trips: Option<usize>,
    /// The guard line.
    pub guard: Guard,
    /// The rate of false alarms that is asked for, a window.
    pub alarm_rate: f64,
    /// The knock that is to be found, m/s².
    pub size: f64,
}

impl Default for Keys {
    fn default() -> Self {
        Self {
            vibration: 0.05,
            uneven: 0.5,
            joints: 0.3,
            unlike: 0.0,
            stop: Stop::default(),
            trips: None,
            guard: Guard::default(),
            alarm_rate: 1e-3,
            size: 1.0,
        }
    }
}

/// More trips are not learnt.
pub const MOST_TRIPS: usize = 500;

impl Keys {
    /// Checks the values.
    ///
    /// # Errors
    /// If one breaks its rule.
    pub fn check(&self) -> Result<(), OutOfRange> {
        Rule::Within(0.0, 1.0, "m/s²").check("vibration", &self.vibration)?;
        Rule::Within(0.0, 3.0, "").check("uneven", &self.uneven)?;
        Rule::Within(0.0, 10.0, "m/s²").check("joints", &self.joints)?;
        Rule::Within(0.0, 3.0, "").check("unlike", &self.unlike)?;
        Rule::Within(1e-6, 0.1, "").check("alarm_rate", &self.alarm_rate)?;
        Rule::Within(0.0, 100.0, "m/s²").check("size", &self.size)?;
        let trips = self.trips.unwrap_or(2);
        Rule::Within(2.0, MOST_TRIPS as f64, "").check("trips", &trips)
    }
}
