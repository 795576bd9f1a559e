//! The spacing of samples in time, from a histogram of fixed size.
//!
//! A bin is one of 512 equal parts between two powers of two, so it is less than 0.2 % wide at every
//! length; the mean of what fell into the median's bin is the median, exactly so where the sampling is
//! regular.

/// Bits of the mantissa that tell bins apart.
const FINENESS: u32 = 9;

/// The powers of two between which intervals are told apart: 2⁻³⁰ s to 2²⁰ s, a nanosecond to twelve days.
const SHORTEST: i32 = -30;
const LONGEST: i32 = 20;

/// How many times the median an interval must exceed to be called a gap: four samples or more are missing.
pub(super) const GAP: f64 = 5.0;

/// A histogram of intervals.
#[derive(Clone, Debug)]
pub(super) struct Intervals {
    counts: Vec<u64>,
    sums: Vec<f64>,
    total: u64,
    longest: Gap,
}

/// A time without samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// s, of the sample before it.
    pub start: f64,
    /// s.
    pub length: f64,
}

impl Default for Intervals {
    fn default() -> Self {
        let bins = ((LONGEST - SHORTEST) as usize) << FINENESS;
        Self {
            counts: vec![0; bins],
            sums: vec![0.0; bins],
            total: 0,
            longest: Gap::default(),
        }
    }
}

impl Intervals {
    /// Counts the interval from one sample to the next.
    #[inline]
    pub fn add(&mut self, from: f64, to: f64) {
        let length = to - from;
        let bin = bin(length).min(self.counts.len() - 1);
        self.counts[bin] += 1;
        self.sums[bin] += length;
        self.total += 1;
        if length > self.longest.length {
            self.longest = Gap {
                start: from,
                length,
            };
        }
    }

    /// s; zero where nothing was counted.
    pub fn median(&self) -> f64 {
        let mut below = 0;
        for (count, sum) in self.counts.iter().zip(&self.sums) {
            below += count;
            if *count > 0 && 2 * below >= self.total {
                return sum / *count as f64;
            }
        }
        0.0
    }

    /// The standard deviation of the intervals over their median. Those below half of it or above one and a
    /// half are left out: they are nearer to no interval or to two, so a sample came double or was lost.
    pub fn jitter(&self) -> f64 {
        let median = self.median();
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (length, number) in self.means() {
            if (0.5 * median..=1.5 * median).contains(&length) {
                let deviation = length - median;
                count += number;
                sum += number * deviation;
                squares += number * deviation * deviation;
            }
        }
        if count == 0.0 {
            return 0.0;
        }
        let mean = sum / count;
        (squares / count - mean * mean).max(0.0).sqrt() / median
    }

    /// The longest interval.
    pub fn longest(&self) -> Gap {
        self.longest
    }

    /// How many gaps there are.
    pub fn gaps(&self) -> u64 {
        let gap = GAP * self.median();
        self.means()
            .filter(|(length, _)| *length > gap)
            .map(|(_, count)| count as u64)
            .sum()
    }

    /// The mean of each bin that holds something, and how much.
    fn means(&self) -> impl Iterator<Item = (f64, f64)> {
        let bins = self.counts.iter().zip(&self.sums);
        bins.filter(|(count, _)| **count > 0)
            .map(|(count, sum)| (sum / *count as f64, *count as f64))
    }
}

/// The bin of a positive length: its exponent and the first bits of its mantissa.
fn bin(length: f64) -> usize {
    let lowest = 2f64.powi(SHORTEST).to_bits() >> (52 - FINENESS);
    let place = length.to_bits() >> (52 - FINENESS);
    place.saturating_sub(lowest) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lengths: &[f64]) -> Intervals {
        let mut intervals = Intervals::default();
        let mut time = 0.0;
        for length in lengths {
            intervals.add(time, time + length);
            time += length;
        }
        intervals
    }

    #[test]
    fn median_jitter_and_gaps() {
        let mut lengths = vec![0.25; 100];
        lengths[50] = 8.0;
        lengths[70] = 0.03125;
        let intervals = of(&lengths);
        assert_eq!(intervals.median(), 0.25);
        assert_eq!(intervals.jitter(), 0.0);
        assert_eq!(intervals.gaps(), 1);
        let longest = Gap {
            start: 12.5,
            length: 8.0,
        };
        assert_eq!(intervals.longest(), longest);
    }

    /// Half at 0.75 and half at 1.25: deviation 0.25. The bins' width, 0.2 %, is the tolerance.
    #[test]
    fn jitter_is_relative() {
        let lengths: Vec<f64> = (0..99)
            .map(|i| if i % 2 == 0 { 0.75 } else { 1.25 })
            .collect();
        let jitter = of(&lengths).jitter();
        assert!((jitter - 0.25 / 0.75).abs() < 0.25, "{jitter}");
        let even: Vec<f64> = (0..999)
            .map(|i| 1.0 + 0.01 * f64::from(i % 3 - 1))
            .collect();
        let jitter = of(&even).jitter();
        assert!(
            (jitter - 0.01 * (2.0f64 / 3.0).sqrt()).abs() < 1e-4,
            "{jitter}"
        );
    }

    #[test]
    fn extremes_have_bins() {
        let intervals = of(&[1e-300, 1e300, f64::MIN_POSITIVE]);
        assert_eq!(intervals.total, 3);
        assert_eq!(of(&[]).median(), 0.0);
        assert_eq!(of(&[]).jitter(), 0.0);
    }
}
