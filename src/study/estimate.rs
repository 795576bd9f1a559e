//! Rates and quantiles with exact intervals.

use crate::counts::Values;
use crate::stats::poisson;
use crate::stats::quantile::Quantile;
use crate::stats::tally::Tally;

/// One outcome: a count and the estimate that follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
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

/// The share of cases, with the Clopper–Pearson interval; without cases it lies anywhere in [0, 1].
pub fn share(outcome: &str, tally: Tally, unit: &'static str, confidence: f64) -> Estimate {
    let (low, high) = tally.interval(confidence);
    Estimate {
        outcome: outcome.to_owned(),
        count: tally.hits,
        exposure: tally.trials as f64,
        unit,
        value: if tally.trials > 0 { tally.rate() } else { 0.0 },
        low,
        high,
    }
}

/// Events per unit of exposure, with Garwood's interval. Without exposure the rate is unknown.
pub fn rate(
    outcome: &str,
    count: u64,
    exposure: f64,
    unit: &'static str,
    confidence: f64,
) -> Estimate {
    let (low, high) = poisson::interval(count, confidence);
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

/// Quantiles of a delay. The count is the number of reported events.
pub fn delays(outcome: &str, delays: &Values, confidence: f64) -> Vec<Estimate> {
    let ascending = delays.ascending();
    let told = delays.count(f64::is_finite);
    let all = delays.count(|_| true);
    let quantile = |(name, p)| {
        let Quantile { value, low, high } = Quantile::of(&ascending, p, confidence);
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
