//! Rates and quantiles with exact intervals, from the sums of the trials.

use super::measure::Measure;
use super::sums::RideSums;
use crate::counts::Values;
use crate::stats::poisson;
use crate::stats::quantile::Quantile;
use crate::stats::tally::Tally;

/// One outcome: a count and the estimate that follows from it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Estimate {
    pub outcome: String,
    /// How often the event happened.
    pub count: u64,
    /// The number of cases, or the time, in which it could happen.
    pub exposure: f64,
    /// Unit of the exposure.
    pub unit: &'static str,
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// The quantiles of delays, by name.
const QUANTILES: [(&str, f64); 3] = [("05", 0.05), ("50", 0.5), ("95", 0.95)];

const HOUR: f64 = 3600.0;

/// All outcomes of a measure.
pub(super) fn of(measure: Measure, sums: &RideSums, trials: u64, confidence: f64) -> Vec<Estimate> {
    let all = All {
        sums,
        trials,
        confidence,
    };
    match measure {
        Measure::Rides => [all.trips(), all.rest(), vec![all.false_alarms()]].concat(),
        Measure::Rest => {
            let disturbed = all.share("disturbed", sums.disturbed);
            [all.rest(), vec![disturbed, all.false_alarms()]].concat()
        }
        Measure::Tradeoff => [all.trips(), all.rest()].concat(),
        Measure::Jam => {
            let alarmed = all.share("alarmed", sums.alarmed);
            let delays = all.delays("alarm_delay", &sums.alarm_delays);
            [vec![alarmed], delays, vec![all.false_alarms()]].concat()
        }
        Measure::SwitchedOn => vec![
            all.share("misled", sums.misled),
            all.share("knew_soon", sums.knew_soon),
            all.share("knew", sums.knew),
        ],
    }
}

/// The trials of one point.
struct All<'a> {
    sums: &'a RideSums,
    trials: u64,
    confidence: f64,
}

impl All<'_> {
    fn trips(&self) -> Vec<Estimate> {
        let mut estimates = vec![self.share("found", self.sums.found)];
        estimates.extend(self.delays("start_delay", &self.sums.start_delays));
        estimates.extend(self.delays("stop_delay", &self.sums.stop_delays));
        estimates
    }

    fn rest(&self) -> Vec<Estimate> {
        vec![self.false_motions(), self.hours_between()]
    }

    /// The share of trials, with the Clopper–Pearson interval.
    fn share(&self, outcome: &str, hits: u64) -> Estimate {
        let trials = self.trials;
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

    /// Events per unit of exposure, with Garwood's interval. Without exposure the rate is unknown.
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

    fn false_motions(&self) -> Estimate {
        let hours = self.sums.at_rest.value() / HOUR;
        self.rate("false_motions", self.sums.false_motions, hours, "hours")
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
        let count = self.sums.false_alarms;
        self.rate("false_alarms", count, self.trials as f64, "trials")
    }

    /// Quantiles of a delay. The count is the number of reported events.
    fn delays(&self, outcome: &str, delays: &Values) -> Vec<Estimate> {
        let ascending = delays.ascending();
        let told = delays.count(f64::is_finite);
        let all = delays.count(|_| true);
        let quantile = |(name, p)| {
            let Quantile { value, low, high } = Quantile::of(&ascending, p, self.confidence);
            Estimate {
                outcome: format!("{outcome}_{name}"),
                count: told,
                exposure: all as f64,
                unit: "trips",
                value,
                low,
                high,
            }
        };
        QUANTILES.map(quantile).into()
    }
}
