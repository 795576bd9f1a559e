//! The outcomes of a measure, from the sums of the trials.

use super::measure::Measure;
use super::sums::RideSums;
use crate::counts::Values;
use crate::stats::tally::Tally;
use crate::study::estimate::{self, Estimate};

const HOUR: f64 = 3600.0;

/// All outcomes of a measure.
pub(super) fn of(measure: Measure, sums: &RideSums, trials: u64, confidence: f64) -> Vec<Estimate> {
    let all = All {
        sums,
        trials,
        confidence,
    };
    match measure {
        Measure::Rides => [
            all.trips(),
            all.rest(),
            vec![all.false_alarms()],
            all.rule(),
        ]
        .concat(),
        Measure::Rest => {
            let disturbed = all.share("disturbed", sums.disturbed);
            let alarms = vec![disturbed, all.false_alarms(), all.rule_alarms()];
            [all.rest(), alarms].concat()
        }
        Measure::Tradeoff => [all.trips(), all.rest(), all.rule()].concat(),
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

    fn share(&self, outcome: &str, hits: u64) -> Estimate {
        let trials = self.trials;
        estimate::share(outcome, Tally { hits, trials }, "trials", self.confidence)
    }

    fn rate(&self, outcome: &str, count: u64, exposure: f64, unit: &'static str) -> Estimate {
        estimate::rate(outcome, count, exposure, unit, self.confidence)
    }

    fn false_motions(&self) -> Estimate {
        let hours = self.sums.stood.value() / HOUR;
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

    fn rule(&self) -> Vec<Estimate> {
        let delays = self.delays("rule_delay", &self.sums.rule_delays);
        [vec![self.rule_alarms()], delays].concat()
    }

    fn rule_alarms(&self) -> Estimate {
        let hours = self.sums.stood.value() / HOUR;
        self.rate("rule_alarms", self.sums.rule_alarms, hours, "hours")
    }

    fn false_alarms(&self) -> Estimate {
        let count = self.sums.false_alarms;
        self.rate("false_alarms", count, self.trials as f64, "trials")
    }

    fn delays(&self, outcome: &str, delays: &Values) -> Vec<Estimate> {
        estimate::delays(outcome, delays, self.confidence)
    }
}
