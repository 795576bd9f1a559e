//! What adds up over the trials of a point: integers alone, so that any split of the trials adds to the same.

use super::account::Account;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::AddAssign;

/// Counts over trials.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(
    missing_docs,
    reason = "the outcomes of the same names say what they are"
)]
pub struct RideSums {
    pub trials: u64,
    pub found: u64,
    pub disturbed: u64,
    pub alarmed: u64,
    pub misled: u64,
    pub knew_soon: u64,
    pub knew: u64,
    pub false_motions: u64,
    pub false_alarms: u64,
    /// For how long the monitor said `rest` of a cage at rest, ns.
    pub at_rest: u64,
    pub start_delays: Delays,
    pub stop_delays: Delays,
    pub alarm_delays: Delays,
}

/// How often each delay came, in s, by bits that are ordered as the numbers are.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Delays(BTreeMap<u64, u64>);

const SIGN: u64 = 1 << 63;

impl Delays {
    fn push(&mut self, delay: f64) {
        let bits = delay.to_bits();
        let ordered = if bits & SIGN == 0 { bits | SIGN } else { !bits };
        *self.0.entry(ordered).or_default() += 1;
    }

    /// Each as often as it came.
    pub fn ascending(&self) -> Vec<f64> {
        self.0
            .iter()
            .flat_map(|(&ordered, &count)| {
                let is_negative = ordered & SIGN == 0;
                let bits = if is_negative {
                    !ordered
                } else {
                    ordered & !SIGN
                };
                std::iter::repeat_n(f64::from_bits(bits), count as usize)
            })
            .collect()
    }
}

impl RideSums {
    /// Takes a trial.
    pub(super) fn count(&mut self, trial: &Account) {
        self.trials += 1;
        self.found += u64::from(trial.trips.iter().all(|trip| trip.is_found));
        self.disturbed += u64::from(trial.false_motions > 0);
        self.alarmed += u64::from(trial.trips.iter().any(|trip| trip.is_alarmed()));
        self.misled += u64::from(trial.misled);
        self.knew_soon += u64::from(trial.knew_soon);
        self.knew += u64::from(trial.knew);
        self.false_motions += trial.false_motions;
        self.false_alarms += trial.false_alarms;
        self.at_rest += (1e9 * trial.at_rest).round() as u64;
        for trip in &trial.trips {
            self.start_delays.push(trip.start_delay);
            self.stop_delays.push(trip.stop_delay);
            trip.alarm_delay
                .into_iter()
                .for_each(|delay| self.alarm_delays.push(delay));
        }
    }
}

impl AddAssign for RideSums {
    fn add_assign(&mut self, other: Self) {
        self.trials += other.trials;
        self.found += other.found;
        self.disturbed += other.disturbed;
        self.alarmed += other.alarmed;
        self.misled += other.misled;
        self.knew_soon += other.knew_soon;
        self.knew += other.knew;
        self.false_motions += other.false_motions;
        self.false_alarms += other.false_alarms;
        self.at_rest += other.at_rest;
        self.start_delays += other.start_delays;
        self.stop_delays += other.stop_delays;
        self.alarm_delays += other.alarm_delays;
    }
}

impl AddAssign for Delays {
    fn add_assign(&mut self, other: Self) {
        for (delay, count) in other.0 {
            *self.0.entry(delay).or_default() += count;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_keep_their_order_and_every_bit() {
        let delays = [-0.5, -0.0, 0.0, 1e-9, 0.1, 0.1, 1.5, f64::INFINITY];
        let mut counted = Delays::default();
        for index in [3, 7, 0, 5, 1, 6, 2, 4] {
            counted.push(delays[index]);
        }
        let bits = |delays: &[f64]| {
            delays
                .iter()
                .map(|delay| delay.to_bits())
                .collect::<Vec<_>>()
        };
        assert_eq!(bits(&counted.ascending()), bits(&delays));
        let text = serde_json::to_string(&counted).unwrap();
        assert_eq!(serde_json::from_str::<Delays>(&text).unwrap(), counted);
    }
}
