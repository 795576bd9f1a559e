//! What a pilot records: a histogram of (W, T), or the largest scores.

use crate::chain::{Observation, Score, View};
use crate::detect::{Histogram, Region, Ties};
use crate::schedule::Gather;
use std::sync::Arc;

/// The observations of a pilot.
#[derive(Clone, Debug)]
pub(super) enum Gauge {
    Statistics(Ties, Histogram),
    Score(Arc<Score>, Largest),
}

/// The largest values seen, up to a fixed number.
#[derive(Clone, Debug)]
pub(super) struct Largest {
    keep: usize,
    values: Vec<f64>,
}

impl Gauge {
    /// The number of false alarms of a region.
    pub fn count(&self, region: &Region) -> u64 {
        self.histogram()
            .count(|statistics| region.contains(statistics))
    }

    pub fn histogram(&self) -> &Histogram {
        match self {
            Self::Statistics(_, histogram) => histogram,
            Self::Score(..) => unreachable!("regions and likelihood ratios are of W and T"),
        }
    }

    /// The smallest of the kept values: no more values than allowed exceed it, fewer if some are equal.
    pub fn threshold(&self) -> f64 {
        match self {
            Self::Statistics(..) => unreachable!("a threshold is of a score"),
            Self::Score(_, largest) => largest.smallest(),
        }
    }
}

impl Largest {
    /// An empty collection of at most `keep` values.
    pub fn new(keep: usize) -> Self {
        let values = Vec::new();
        Self { keep, values }
    }

    fn add(&mut self, value: f64) {
        self.values.push(value);
        // Pruned only now and then, which keeps both the cost per value and the memory small.
        if self.values.len() > 2 * self.keep + 1024 {
            self.sort_out();
        }
    }

    fn sort_out(&mut self) {
        self.values.sort_unstable_by(|a, b| b.total_cmp(a));
        self.values.truncate(self.keep);
    }

    fn smallest(&self) -> f64 {
        let mut sorted = self.clone();
        sorted.sort_out();
        sorted.values.last().copied().unwrap_or(f64::NEG_INFINITY)
    }
}

/// The gauge of each point.
pub(super) struct Gauges(pub Vec<Gauge>);

impl View for Gauges {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        match &mut self.0[place] {
            Gauge::Statistics(ties, histogram) => histogram.add(observation.statistics(*ties)),
            Gauge::Score(score, largest) => largest.add(score.of(observation)),
        }
    }
}

impl Gather for Gauges {}

impl Gauges {
    /// What both have seen.
    pub fn merged(mut self, other: Self) -> Self {
        for (sum, more) in self.0.iter_mut().zip(other.0) {
            match (sum, more) {
                (Gauge::Statistics(_, sum), Gauge::Statistics(_, more)) => sum.merge(&more),
                (Gauge::Score(_, sum), Gauge::Score(_, more)) => {
                    more.values.into_iter().for_each(|value| sum.add(value));
                }
                _ => unreachable!("both began as the same gauges"),
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest of many values are kept, whatever their order.
    #[test]
    fn largest_are_kept() {
        let mut largest = Largest::new(5);
        (0..9000u64).for_each(|i| largest.add((i * 7919 % 9000) as f64));
        assert_eq!(largest.smallest(), 8995.0);
    }
}
