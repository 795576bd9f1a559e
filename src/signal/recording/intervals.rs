//! The spacing of samples in time, from a histogram of fixed size.
//!
//! A bin is one of 512 equal parts between two powers of two, so its relative width is less than 0.2 %. The
//! mean of the intervals in the median's bin is taken as the median, which is exact for regular sampling.
//! Sums and squares about the lower edge of each bin make the standard deviation exact.

/// Bits of the mantissa in the index of a bin.
const FINENESS: u32 = 9;

/// The range of the histogram as powers of two: 2⁻³⁰ s to 2²⁰ s, a nanosecond to twelve days.
const SHORTEST: i32 = -30;
const LONGEST: i32 = 20;

/// An interval above this many medians is a gap: four samples or more are missing.
pub(super) const GAP: f64 = 5.0;

/// A histogram of intervals.
#[derive(Clone, Debug)]
pub(super) struct Intervals {
    bins: Vec<Bin>,
    total: u64,
    longest: Gap,
}

/// Intervals of nearly one length.
#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    count: u64,
    /// Sum of the excesses over the lower edge.
    sum: f64,
    squares: f64,
}

/// A time without samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Time of the sample before it, s.
    pub start: f64,
    /// s.
    pub length: f64,
}

impl Default for Intervals {
    fn default() -> Self {
        let bins = ((LONGEST - SHORTEST) as usize) << FINENESS;
        Self {
            bins: vec![Bin::default(); bins],
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
        let place = place(length).min(self.bins.len() - 1);
        let excess = length - edge(place);
        let bin = &mut self.bins[place];
        bin.count += 1;
        bin.sum += excess;
        bin.squares += excess * excess;
        self.total += 1;
        if length > self.longest.length {
            self.longest = Gap {
                start: from,
                length,
            };
        }
    }

    /// The median interval, s; 0 without intervals.
    pub fn median(&self) -> f64 {
        let mut below = 0;
        for (mean, bin) in self.filled() {
            below += bin.count;
            if 2 * below >= self.total {
                return mean;
            }
        }
        0.0
    }

    /// The standard deviation of the intervals over their median. Intervals below 0.5 or above 1.5 medians are
    /// left out: there a sample was doubled or lost.
    pub fn jitter(&self) -> f64 {
        let median = self.median();
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (mean, bin) in self.filled() {
            if (0.5 * median..=1.5 * median).contains(&mean) {
                let number = bin.count as f64;
                let within = bin.squares - bin.sum * bin.sum / number;
                let deviation = mean - median;
                count += number;
                sum += number * deviation;
                squares += number * deviation * deviation + within;
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

    /// The number of gaps.
    pub fn gaps(&self) -> u64 {
        let gap = GAP * self.median();
        self.filled()
            .filter(|(mean, _)| *mean > gap)
            .map(|(_, bin)| bin.count)
            .sum()
    }

    /// Each non-empty bin with the mean of its intervals.
    fn filled(&self) -> impl Iterator<Item = (f64, &Bin)> {
        let bins = self.bins.iter().enumerate();
        bins.filter(|(_, bin)| bin.count > 0)
            .map(|(place, bin)| (edge(place) + bin.sum / bin.count as f64, bin))
    }
}

/// The upper bits of the lowest edge, from which bins are numbered.
const LOWEST: u64 = ((1023 + SHORTEST) as u64) << FINENESS;

/// The bin of a positive length: its exponent and the first bits of its mantissa.
fn place(length: f64) -> usize {
    (length.to_bits() >> (52 - FINENESS)).saturating_sub(LOWEST) as usize
}

/// The least length in a bin.
fn edge(place: usize) -> f64 {
    f64::from_bits((LOWEST + place as u64) << (52 - FINENESS))
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

    /// A third each at 0.99, 1 and 1.01; then within a bin.
    #[test]
    fn jitter_is_relative() {
        for spread in [0.01, 1e-5] {
            let thirds = |i: i32| 1.0 + spread * f64::from(i % 3 - 1);
            let jitter = of(&(0..999).map(thirds).collect::<Vec<_>>()).jitter();
            let expected = spread * (2.0f64 / 3.0).sqrt();
            // Times near 1000 have the deviation of each interval to 1e-13.
            assert!((jitter - expected).abs() < 1e-3 * spread, "{jitter}");
        }
    }

    #[test]
    fn extremes_have_bins() {
        let intervals = of(&[1e-300, 1e300, f64::MIN_POSITIVE]);
        assert_eq!(intervals.total, 3);
        assert_eq!(of(&[]).median(), 0.0);
        assert_eq!(of(&[]).jitter(), 0.0);
    }
}
