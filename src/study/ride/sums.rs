//! What came of many trials, added up.

use super::account::{Account, Trip};
use crate::counts::{Fixed, Shape, Sums, Values};

/// What came of the trials of a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct RideSums {
    /// Trials in which every trip was found.
    pub found: u64,
    /// Those with a false motion.
    pub disturbed: u64,
    /// Those with an alarm of their jam.
    pub alarmed: u64,
    /// Those in which the monitor said `rest` in the first trip.
    pub misled: u64,
    /// Those in which it said so when the rest after the first trip ended.
    pub knew_soon: u64,
    /// Those in which it said so in the end.
    pub knew: u64,
    pub false_motions: u64,
    pub false_alarms: u64,
    /// For how long the cage stood and the monitor said so, s.
    pub at_rest: Fixed,
    /// Of every trip, s.
    pub start_delays: Values,
    pub stop_delays: Values,
    /// Of every jam, s.
    pub alarm_delays: Values,
}

impl RideSums {
    /// One more trial.
    pub fn add(&mut self, account: &Account) {
        let alarmed = |trip: &Trip| trip.alarm_delay.is_some_and(f64::is_finite);
        self.found += u64::from(account.trips.iter().all(|trip| trip.is_found));
        self.disturbed += u64::from(account.false_motions > 0);
        self.alarmed += u64::from(account.trips.iter().any(alarmed));
        self.misled += u64::from(account.misled);
        self.knew_soon += u64::from(account.knew_soon);
        self.knew += u64::from(account.knew);
        self.false_motions += account.false_motions;
        self.false_alarms += account.false_alarms;
        self.at_rest += Fixed::new(account.at_rest);
        for trip in &account.trips {
            self.start_delays.push(trip.start_delay);
            self.stop_delays.push(trip.stop_delay);
            trip.alarm_delay
                .into_iter()
                .for_each(|delay| self.alarm_delays.push(delay));
        }
    }

    /// Six events, two counts without a limit, a time and three kinds of delays.
    pub fn shape() -> Shape {
        Shape {
            most: [vec![Some(1); 6], vec![None; 2]].concat(),
            lengths: 1,
            values: 3,
        }
    }
}

impl From<RideSums> for Sums {
    fn from(sums: RideSums) -> Self {
        Self {
            counts: vec![
                sums.found,
                sums.disturbed,
                sums.alarmed,
                sums.misled,
                sums.knew_soon,
                sums.knew,
                sums.false_motions,
                sums.false_alarms,
            ],
            lengths: vec![sums.at_rest],
            values: vec![sums.start_delays, sums.stop_delays, sums.alarm_delays],
        }
    }
}

impl From<Sums> for RideSums {
    /// Sums of [`RideSums::shape`].
    fn from(sums: Sums) -> Self {
        let counts = sums.counts;
        let mut values = sums.values.into_iter();
        let mut next = || values.next().unwrap_or_default();
        Self {
            found: counts[0],
            disturbed: counts[1],
            alarmed: counts[2],
            misled: counts[3],
            knew_soon: counts[4],
            knew: counts[5],
            false_motions: counts[6],
            false_alarms: counts[7],
            at_rest: sums.lengths[0],
            start_delays: next(),
            stop_delays: next(),
            alarm_delays: next(),
        }
    }
}
