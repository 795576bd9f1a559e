//! From what came of each trial to rates and quantiles with exact intervals.

use super::account::{Account, Trip};
use crate::config::Measure;
use crate::stats::poisson;
use crate::stats::quantile::Quantile;
use crate::stats::tally::Tally;

/// One outcome: a count and what it says.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Estimate {
    pub outcome: String,
    /// How often it happened.
    pub count: u64,
    /// Out of so many, or in so much time.
    pub exposure: f64,
    /// Of the exposure.
    pub unit: &'static str,
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// The quantiles told of delays.
const QUANTILES: [(&str, f64); 3] = [("05", 0.05), ("50", 0.5), ("95", 0.95)];

const HOUR: f64 = 3600.0;

/// All outcomes that a measurement is about.
pub(super) fn of(measure: Measure, accounts: &[Account], confidence: f64) -> Vec<Estimate> {
    let all = All {
        accounts,
        confidence,
    };
    let of_trips = || {
        let trips = |trip: &Trip| trip.is_found;
        let found = |account: &Account| account.trips.iter().all(trips);
        let mut estimates = vec![all.share("found", found)];
        estimates.extend(all.delays("start_delay", |trip| Some(trip.start_delay)));
        estimates.extend(all.delays("stop_delay", |trip| Some(trip.stop_delay)));
        estimates
    };
    let of_rest = || vec![all.false_motions(), all.hours_between()];
    match measure {
        Measure::Rides => [of_trips(), of_rest(), vec![all.false_alarms()]].concat(),
        Measure::Rest => {
            let disturbed = all.share("disturbed", |account| account.false_motions > 0);
            [of_rest(), vec![disturbed, all.false_alarms()]].concat()
        }
        Measure::Tradeoff => [of_trips(), of_rest()].concat(),
        Measure::Jam => {
            let alarmed = |trip: &Trip| trip.alarm_delay.is_some_and(f64::is_finite);
            let alarmed = all.share("alarmed", |account| account.trips.iter().any(alarmed));
            let delays = all.delays("alarm_delay", |trip| trip.alarm_delay);
            [vec![alarmed], delays, vec![all.false_alarms()]].concat()
        }
        Measure::SwitchedOn => vec![
            all.share("misled", |account| account.misled),
            all.share("knew_soon", |account| account.knew_soon),
            all.share("knew", |account| account.knew),
        ],
    }
}

/// The trials of one point.
struct All<'a> {
    accounts: &'a [Account],
    confidence: f64,
}

impl All<'_> {
    /// The share of trials, with the interval of Clopper and Pearson.
    fn share(&self, outcome: &str, is_hit: impl Fn(&Account) -> bool) -> Estimate {
        let hits = self
            .accounts
            .iter()
            .filter(|account| is_hit(account))
            .count() as u64;
        let trials = self.accounts.len() as u64;
        let tally = Tally { hits, trials };
        let (low, high) = tally.interval(self.confidence);
        Estimate {
            outcome: outcome.to_owned(),
            count: hits,
            exposure: trials as f64,
            unit: "trials",
            value: tally.rate(),
            low,
            high,
        }
    }

    /// Events per unit of exposure, with the interval of Garwood. Where there was no exposure, nothing is known.
    fn rate(&self, outcome: &str, count: u64, exposure: f64, unit: &'static str) -> Estimate {
        let (low, high) = poisson::interval(count, self.confidence);
        let [value, low] = [count as f64, low].map(|number| match number {
            0.0 => 0.0,
            number => number / exposure,
        });
        Estimate {
            outcome: outcome.to_owned(),
            count,
            exposure,
            unit,
            value,
            low,
            high: high / exposure,
        }
    }

    fn sum(&self, number: impl Fn(&Account) -> u64) -> u64 {
        self.accounts.iter().map(number).sum()
    }

    fn false_motions(&self) -> Estimate {
        let seconds: f64 = self.accounts.iter().map(|account| account.at_rest).sum();
        let count = self.sum(|account| account.false_motions);
        self.rate("false_motions", count, seconds / HOUR, "hours")
    }

    fn hours_between(&self) -> Estimate {
        let rate = self.false_motions();
        Estimate {
            outcome: "hours_between".to_owned(),
            value: 1.0 / rate.value,
            low: 1.0 / rate.high,
            high: 1.0 / rate.low,
            ..rate
        }
    }

    fn false_alarms(&self) -> Estimate {
        let count = self.sum(|account| account.false_alarms);
        self.rate("false_alarms", count, self.accounts.len() as f64, "trials")
    }

    /// Quantiles of a delay, counting those that were told.
    fn delays(&self, outcome: &str, delay: impl Fn(&Trip) -> Option<f64>) -> Vec<Estimate> {
        let trips = self.accounts.iter().flat_map(|account| &account.trips);
        let mut delays: Vec<f64> = trips.filter_map(delay).collect();
        delays.sort_by(f64::total_cmp);
        let told = delays.iter().filter(|delay| delay.is_finite()).count() as u64;
        let quantile = |(name, p)| {
            let Quantile { value, low, high } = Quantile::of(&delays, p, self.confidence);
            Estimate {
                outcome: format!("{outcome}_{name}"),
                count: told,
                exposure: delays.len() as f64,
                unit: "trips",
                value,
                low,
                high,
            }
        };
        QUANTILES.map(quantile).into()
    }
}
