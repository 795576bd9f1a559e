//! What a norm allows.

use super::{Figure, Measure, Quality};
use serde::Serialize;
use std::fmt;

/// A limit of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Of which figure.
    pub measure: Measure,
    /// The least that is allowed.
    pub least: Option<f64>,
    /// The most.
    pub most: Option<f64>,
}

/// How a figure stands to a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It keeps it.
    Pass,
    /// It does not.
    Fail,
    /// It is beyond it, but may be noise.
    Noise,
}

/// The limits of all figures that have one, for a lift of a rated speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits(Vec<Limit>);

/// Accelerations may be no larger, m/s², and what 95 % do not exceed no smaller, above a speed, m/s, up to another.
const MOST_ACCELERATION: f64 = 1.5;
const LEAST_95: [(f64, f64, f64); 2] = [(1.0, 2.0, 0.5), (2.0, 6.0, 0.7)];

/// Vibration, m/s².
const VIBRATION: [(Measure, f64); 4] = [
    (Measure::Vertical, 0.30),
    (Measure::Vertical95, 0.20),
    (Measure::Horizontal, 0.20),
    (Measure::Horizontal95, 0.15),
];

impl Limits {
    /// Those of GB/T 10058-2009, from memory, for a rated speed, m/s.
    pub fn gb_t_10058(rated_speed: f64) -> Self {
        let most = |measure, most| Limit {
            measure,
            least: None,
            most: Some(most),
        };
        let accelerations = [Measure::Acceleration, Measure::Deceleration];
        let mut limits: Vec<Limit> = accelerations.map(|it| most(it, MOST_ACCELERATION)).into();
        let is_of = |range: &&(f64, f64, f64)| range.0 < rated_speed && rated_speed <= range.1;
        if let Some((_, _, least)) = LEAST_95.iter().find(is_of) {
            let usual = [Measure::Acceleration95, Measure::Deceleration95];
            limits.extend(usual.map(|measure| Limit {
                measure,
                least: Some(*least),
                most: None,
            }));
        }
        limits.extend(VIBRATION.map(|(measure, limit)| most(measure, limit)));
        Self(limits)
    }

    /// All of them.
    pub fn all(&self) -> &[Limit] {
        &self.0
    }

    /// The verdict on a figure of a ride, if it has the figure and that a limit.
    pub fn verdict(&self, quality: &Quality, measure: Measure) -> Option<Verdict> {
        let limit = self.0.iter().find(|limit| limit.measure == measure)?;
        quality.figure(measure).map(|figure| limit.verdict(&figure))
    }

    /// The verdict on a ride: that of its worst figure; none if all that it has pass, and the record lacks one.
    pub fn overall(&self, quality: &Quality) -> Option<Verdict> {
        let verdicts = self.0.iter().map(|it| self.verdict(quality, it.measure));
        let verdicts: Vec<Option<Verdict>> = verdicts.collect();
        [Some(Verdict::Fail), Some(Verdict::Noise), None]
            .into_iter()
            .find(|worst| verdicts.contains(worst))
            .unwrap_or(Some(Verdict::Pass))
    }
}

impl Limit {
    fn verdict(&self, figure: &Figure) -> Verdict {
        let is_short = self.least.is_some_and(|least| figure.value < least);
        let is_beyond = self.most.is_some_and(|most| figure.value > most);
        if is_beyond && figure.is_noise() {
            Verdict::Noise
        } else if is_short || is_beyond {
            Verdict::Fail
        } else {
            Verdict::Pass
        }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let limits = self.0.iter().map(
            |Limit {
                 measure,
                 least,
                 most,
             }| {
                let least = least.map(|it| format!("at least {it:.2}"));
                let most = most.map(|it| format!("at most {it:.2}"));
                format!("{} {}", measure.name(), least.or(most).unwrap_or_default())
            },
        );
        f.write_str(&limits.collect::<Vec<_>>().join(", "))
    }
}
