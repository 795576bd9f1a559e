//! Rates and quantiles with exact intervals, and means with that of the normal law.

use crate::counts::{Sums, Values};
use crate::results::eight_digits;
use crate::stats::normal::two_sided_quantile;
use crate::stats::poisson;
use crate::stats::quantile::Quantile;
use crate::stats::tally::Tally;
use libm::sqrt;

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

impl Estimate {
    /// As it is written.
    pub fn rounded(self) -> Self {
        Self {
            exposure: eight_digits(self.exposure),
            value: eight_digits(self.value),
            low: eight_digits(self.low),
            high: eight_digits(self.high),
            ..self
        }
    }
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
    let named = QUANTILES.iter();
    let each =
        named.map(|(name, p)| quantile(&format!("{outcome}_{name}"), delays, *p, confidence));
    each.collect()
}

/// The `p`-quantile of a number that trips have. The count is that of finite ones.
pub fn quantile(outcome: &str, values: &Values, p: f64, confidence: f64) -> Estimate {
    let Quantile { value, low, high } = Quantile::of(&values.ascending(), p, confidence);
    Estimate {
        outcome: outcome.to_owned(),
        count: values.count(f64::is_finite),
        exposure: values.count(|_| true) as f64,
        unit: "trips",
        value,
        low,
        high,
    }
}

/// A number that is computed, not counted.
pub fn computed(outcome: &str, value: f64) -> Estimate {
    Estimate {
        outcome: outcome.to_owned(),
        count: 0,
        exposure: 0.0,
        unit: "computed",
        value,
        low: value,
        high: value,
    }
}

/// A mean with its interval.
#[derive(Clone, Copy)]
pub struct Mean {
    pub value: f64,
    low: f64,
    high: f64,
}

impl Mean {
    /// Of a quantity whose sum and sum of squares are a pair of lengths, in so many cases.
    pub fn new(sums: &Sums, pair: usize, cases: u64, confidence: f64) -> Self {
        let n = cases.max(1) as f64;
        let [value, square] = [0, 1].map(|at| sums.lengths[2 * pair + at].value() / n);
        let deviation = sqrt((square - value * value).max(0.0) / (n - 1.0).max(1.0));
        // One case says nothing of others.
        let half = if cases < 2 {
            f64::INFINITY
        } else {
            two_sided_quantile(confidence) * deviation
        };
        Self {
            value,
            low: value - half,
            high: value + half,
        }
    }

    /// The root of a mean square.
    pub fn root(self) -> Self {
        self.map(|value| if value < 0.0 { 0.0 } else { sqrt(value) })
    }

    /// Over another mean of the same cases, where the mean of their products is known; the relative errors by the delta
    /// method.
    pub fn ratio(self, other: Self, product: f64, cases: u64, confidence: f64) -> Self {
        let value = self.value / other.value;
        let [one, another] = [self, other].map(|mean| (mean.value - mean.low) / mean.value);
        let z = two_sided_quantile(confidence);
        let expected = self.value * other.value;
        let shared = z * z * (product / expected - 1.0) / (cases.max(2) - 1) as f64;
        let half = value * sqrt((one * one + another * another - 2.0 * shared).max(0.0));
        Self {
            value,
            low: value - half,
            high: value + half,
        }
    }

    /// In a unit of this size.
    pub fn over(self, unit: f64) -> Self {
        self.map(|value| value / unit)
    }

    fn map(self, of: impl Fn(f64) -> f64) -> Self {
        Self {
            value: of(self.value),
            low: of(self.low),
            high: of(self.high),
        }
    }

    pub fn named(self, outcome: &str, cases: u64, unit: &'static str) -> Estimate {
        Estimate {
            outcome: outcome.to_owned(),
            count: cases,
            exposure: cases as f64,
            unit,
            value: self.value,
            low: self.low,
            high: self.high,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::{Fixed, Shape};

    /// y = 2x + c of random x and c: the interval of ȳ/x̄ is that of a jackknife.
    #[test]
    fn ratio_of_paired_means() {
        let number = |k: u64| (k as f64 * 0.618_033_988_75).fract();
        let pairs: Vec<[f64; 2]> = (0..200)
            .map(|k| {
                [
                    2.0 + number(k),
                    4.0 + 2.0 * number(k) + 0.3 * number(7 * k + 3),
                ]
            })
            .collect();
        let sum = |of: fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>();
        let lengths = [
            sum(|it| it[0]),
            sum(|it| it[0] * it[0]),
            sum(|it| it[1]),
            sum(|it| it[1] * it[1]),
        ];
        let shape = Shape {
            most: vec![],
            lengths: 4,
            values: vec![],
        };
        let mut sums = shape.empty().sums;
        sums.lengths = lengths.map(Fixed::new).to_vec();
        let [x, y] = [0, 1].map(|pair| Mean::new(&sums, pair, 200, 0.95));
        let product = sum(|it| it[0] * it[1]) / 200.0;
        let ratio = y.ratio(x, product, 200, 0.95);
        let left_out = pairs
            .iter()
            .map(|it| (lengths[2] - it[1]) / (lengths[0] - it[0]));
        let squares: f64 = left_out.map(|one| (one - ratio.value).powi(2)).sum();
        let half = two_sided_quantile(0.95) * sqrt(squares * 199.0 / 200.0);
        let found = ratio.high - ratio.value;
        assert!((found / half - 1.0).abs() < 0.02, "{found} {half}");
    }
}
