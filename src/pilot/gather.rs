//! What a pilot looks at, and what it keeps of it: a histogram of (W, T), or the largest scores.

use crate::chain::{Observation, Score, View};
use crate::detect::{Histogram, Region, Ties};
use crate::schedule::Gather;
use std::sync::Arc;

/// What a pilot looks at.
#[derive(Clone, Debug)]
pub(super) enum Gauge {
    Statistics(Ties),
    /// A score, and how many of its largest values matter.
    Score(Arc<Score>, usize),
}

/// What it has seen.
#[derive(Clone, Debug)]
pub(super) enum Gathered {
    Statistics(Histogram),
    Scores(Largest),
}

/// The largest so many of the values that have come by.
#[derive(Clone, Debug)]
pub(super) struct Largest {
    keep: usize,
    values: Vec<f64>,
}

impl Gauge {
    pub fn nothing(&self) -> Gathered {
        match self {
            Self::Statistics(_) => Gathered::Statistics(Histogram::default()),
            Self::Score(_, keep) => Gathered::Scores(Largest {
                keep: *keep,
                values: Vec::new(),
            }),
        }
    }
}

impl Gathered {
    /// False alarms of a region.
    pub fn count(&self, region: &Region) -> u64 {
        match self {
            Self::Statistics(histogram) => {
                histogram.count(|statistics| region.contains(statistics))
            }
            Self::Scores(_) => unreachable!("a region of W and T"),
        }
    }

    /// The smallest of the largest that were kept: what as many as are allowed exceed, or fewer where
    /// some are equal.
    pub fn threshold(&self) -> f64 {
        match self {
            Self::Statistics(_) => unreachable!("a threshold of a score"),
            Self::Scores(largest) => largest.smallest(),
        }
    }
}

impl Largest {
    fn add(&mut self, value: f64) {
        self.values.push(value);
        // Sorted out now and then, so that the cost of a value stays small and so does the memory.
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

/// Gathers what the gauges show.
pub(super) struct Gatherer<'a> {
    pub gauges: &'a [Gauge],
    pub gathered: Vec<Gathered>,
}

impl View for Gatherer<'_> {
    fn look(&mut self, place: usize, observation: &mut Observation) {
        match (&self.gauges[place], &mut self.gathered[place]) {
            (Gauge::Statistics(ties), Gathered::Statistics(histogram)) => {
                histogram.add(observation.statistics(*ties));
            }
            (Gauge::Score(score, _), Gathered::Scores(largest)) => {
                largest.add(score.of(observation))
            }
            _ => unreachable!("what is gathered is what the gauge shows"),
        }
    }
}

impl Gather for Gatherer<'_> {
    fn merge(&mut self, other: Self) {
        for (sum, more) in self.gathered.iter_mut().zip(other.gathered) {
            match (sum, more) {
                (Gathered::Statistics(sum), Gathered::Statistics(more)) => sum.merge(&more),
                (Gathered::Scores(sum), Gathered::Scores(more)) => {
                    more.values.into_iter().for_each(|value| sum.add(value));
                }
                _ => unreachable!("both come from the same gauges"),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is kept of many values are the largest, whatever their order.
    #[test]
    fn largest_are_kept() {
        let mut largest = Largest {
            keep: 5,
            values: Vec::new(),
        };
        (0..9000u64).for_each(|i| largest.add((i * 7919 % 9000) as f64));
        assert_eq!(largest.smallest(), 8995.0);
    }
}
