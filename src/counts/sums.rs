//! The sums of a counter: integers only, so that the order of additions does not matter.

use super::ranges::Ranges;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Sums and the trials they were taken over.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counter {
    /// The counted trials.
    pub trials: Ranges,
    /// The sums over all of them.
    pub sums: Sums,
}

/// Sums over trials.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Sums {
    /// How often each kind of event happened.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub counts: Vec<u64>,
    /// Sums of real numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lengths: Vec<Fixed>,
    /// Collections of real numbers, for quantiles.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Values>,
}

/// The number of sums of each kind in a counter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Shape {
    /// The most that one trial can add to each count, if there is a limit.
    pub most: Vec<Option<u64>>,
    /// The number of sums of real numbers.
    pub lengths: usize,
    /// The most real numbers that one trial can add to each collection.
    pub values: Vec<u64>,
}

impl Sums {
    /// Counts without other sums.
    pub fn of(counts: &[u64]) -> Self {
        Self {
            counts: counts.to_vec(),
            ..Self::default()
        }
    }

    /// Notes a value of which mean and interval are asked: it and its square are a pair of lengths.
    pub fn note(&mut self, pair: usize, value: f64) {
        let lengths = [value, value * value].map(Fixed::new);
        self.lengths[2 * pair..][..2].copy_from_slice(&lengths);
    }

    /// Adds the sums of other trials. Sums saturate: a file may hold any number, and the largest number is
    /// refused later because no trials can give it.
    pub fn add(&mut self, more: &Self) {
        let counts = self.counts.iter_mut().zip(&more.counts);
        counts.for_each(|(sum, more)| *sum = sum.saturating_add(*more));
        let lengths = self.lengths.iter_mut().zip(&more.lengths);
        lengths.for_each(|(sum, more)| sum.0 = sum.0.saturating_add(more.0));
        let values = self.values.iter_mut().zip(&more.values);
        values.for_each(|(sum, more)| sum.add(more));
    }

    /// The number of counts, of sums of real numbers and of collections.
    pub(super) fn lengths(&self) -> [usize; 3] {
        [self.counts.len(), self.lengths.len(), self.values.len()]
    }

    /// The number of sums of each kind.
    pub fn shape(&self) -> Shape {
        Shape {
            most: vec![None; self.counts.len()],
            lengths: self.lengths.len(),
            values: vec![u64::MAX; self.values.len()],
        }
    }
}

impl Shape {
    /// `count` counts, each raised by at most one in a trial.
    pub fn events(count: usize) -> Self {
        Self {
            most: vec![Some(1); count],
            ..Self::default()
        }
    }

    /// A counter of no trials.
    pub fn empty(&self) -> Counter {
        Counter {
            trials: Ranges::default(),
            sums: Sums {
                counts: vec![0; self.most.len()],
                lengths: vec![Fixed::default(); self.lengths],
                values: vec![Values::default(); self.values.len()],
            },
        }
    }

    pub(super) fn fits(&self, sums: &Sums) -> bool {
        [self.most.len(), self.lengths, self.values.len()] == sums.lengths()
    }

    /// A count, or a number of values, that is too large for so many trials, and the largest possible.
    pub(super) fn excess(&self, sums: &Sums, trials: u64) -> Option<[u64; 2]> {
        let counts = sums.counts.iter().zip(&self.most);
        let counts = counts.filter_map(|(count, most)| Some((*count, (*most)?)));
        let values = sums.values.iter().zip(&self.values);
        let values = values.map(|(values, most)| (values.count(|_| true), *most));
        counts
            .chain(values)
            .map(|(count, most)| [count, most.saturating_mul(trials)])
            .find(|[count, most]| count > most)
    }
}

/// A real number as a multiple of 2⁻⁶⁰: sums up to 10²⁰, with an error of 10⁻¹⁸ for each term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Fixed(i128);

const ONE: f64 = (1u64 << 60) as f64;

impl Fixed {
    /// The nearest multiple.
    pub fn new(value: f64) -> Self {
        Self((value * ONE).round() as i128)
    }

    /// As a floating-point number.
    pub fn value(self) -> f64 {
        self.0 as f64 / ONE
    }
}

impl std::ops::AddAssign for Fixed {
    fn add_assign(&mut self, more: Self) {
        self.0 += more.0;
    }
}

/// As a string, because JSON has no integers of this size.
impl From<Fixed> for String {
    fn from(fixed: Fixed) -> Self {
        fixed.0.to_string()
    }
}

impl TryFrom<String> for Fixed {
    type Error = std::num::ParseIntError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse().map(Self)
    }
}

/// Real numbers, possibly infinite, and how often each occurred.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Values {
    /// Keyed by the bits of the number, so that nothing is lost.
    times: BTreeMap<u64, u64>,
}

impl Values {
    /// Adds one number.
    pub fn push(&mut self, value: f64) {
        *self.times.entry(value.to_bits()).or_default() += 1;
    }

    /// Adds the numbers of other trials.
    pub fn add(&mut self, more: &Self) {
        for (bits, times) in &more.times {
            let sum = self.times.entry(*bits).or_default();
            *sum = sum.saturating_add(*times);
        }
    }

    /// How many numbers satisfy a condition.
    pub fn count(&self, is_one: impl Fn(f64) -> bool) -> u64 {
        let each = self.each().filter(|(value, _)| is_one(*value));
        each.fold(0, |sum, (_, times)| sum.saturating_add(times))
    }

    /// The distinct numbers in ascending order, each with the number of values up to it.
    pub fn ascending(&self) -> Vec<(f64, u64)> {
        let mut values: Vec<(f64, u64)> = self.each().collect();
        values.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut sum = 0u64;
        for (_, times) in &mut values {
            sum = sum.saturating_add(*times);
            *times = sum;
        }
        values
    }

    fn each(&self) -> impl Iterator<Item = (f64, u64)> {
        let each = self.times.iter();
        each.map(|(bits, times)| (f64::from_bits(*bits), *times))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With wrapping, two impossible counts could add up to a possible one.
    #[test]
    fn no_sum_wraps() {
        let mut sum = Sums::of(&[u64::MAX - 5]);
        sum.add(&Sums::of(&[1000]));
        let shape = Shape::events(1);
        assert_eq!(shape.excess(&sum, 3000), Some([u64::MAX, 3000]));
    }

    /// A file may claim any number of occurrences of a value, because they are stored as a count.
    #[test]
    fn values_are_bounded_by_the_trials() {
        let file = format!("[{{\"{}\":1000000000000000000,\"0\":3}}]", 1f64.to_bits());
        let mut sums = Sums {
            values: serde_json::from_str(&file).unwrap(),
            ..Sums::default()
        };
        let shape = Shape {
            values: vec![2],
            ..Shape::default()
        };
        let number = 1_000_000_000_000_000_003;
        assert_eq!(sums.values[0].ascending(), [(0.0, 3), (1.0, number)]);
        assert_eq!(shape.excess(&sums, 3000), Some([number, 6000]));
        for _ in 0..10 {
            let more = sums.clone();
            sums.add(&more);
        }
        assert_eq!(sums.values[0].ascending()[1], (1.0, u64::MAX));
        assert_eq!(shape.excess(&sums, 3000), Some([u64::MAX, 6000]));
        sums.values = vec![Values::default()];
        (0..6000).for_each(|i| sums.values[0].push(f64::from(i % 7)));
        assert_eq!(shape.excess(&sums, 3000), None);
    }

    #[test]
    fn a_file_loses_nothing() {
        let mut values = Values::default();
        for value in [f64::INFINITY, 0.1, -0.0, 0.1, -3.5e-7] {
            values.push(value);
        }
        let ascending = [(-3.5e-7, 1), (-0.0, 2), (0.1, 4), (f64::INFINITY, 5)];
        assert_eq!(values.ascending(), ascending);
        let sums = Sums {
            counts: vec![u64::MAX],
            lengths: vec![Fixed::new(-1e12 / 3.0), Fixed::new(1e-17)],
            values: vec![values],
        };
        let json = serde_json::to_string(&sums).unwrap();
        assert_eq!(serde_json::from_str::<Sums>(&json).unwrap(), sums);
    }

    #[test]
    fn sums_are_of_any_order() {
        let numbers = [0.1, 1e9, -1e9, 1e-9, 0.7];
        let sum = |numbers: &mut dyn Iterator<Item = &f64>| {
            let mut sum = Fixed::default();
            numbers.for_each(|number| sum += Fixed::new(*number));
            sum
        };
        assert_eq!(sum(&mut numbers.iter()), sum(&mut numbers.iter().rev()));
        assert!((sum(&mut numbers.iter()).value() - 0.800_000_001).abs() < 1e-15);
    }
}
