//! The spacing of samples in time, from a histogram of fixed size.
//!
//! A bin is one of 512 equal parts between two powers of two, so it is less than 0.2 % wide at every
//! length; the mean of what fell into the median's bin is the median, exactly so where the sampling is
//! regular. Sums and squares about the bin's lower edge make the deviation exact.

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
    bins: Vec<Bin>,
    total: u64,
    longest: Gap,
}

/// Intervals of nearly one length.
#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    count: u64,
    /// Of what each exceeds the lower edge by.
    sum: f64,
    squares: f64,
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

    /// s; zero where nothing was counted.
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

    /// The standard deviation of the intervals over their median. Those below half of it or above one and a
    /// half are left out: they are nearer to no interval or to two, so a sample came double or was lost.
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

    /// How many gaps there are.
    pub fn gaps(&self) -> u64 {
        let gap = GAP * self.median();
        self.filled()
            .filter(|(mean, _)| *mean > gap)
            .map(|(_, bin)| bin.count)
            .sum()
    }

    /// Each bin that holds something, and the mean of what it holds.
    fn filled(&self) -> impl Iterator<Item = (f64, &Bin)> {
        let bins = self.bins.iter().enumerate();
        bins.filter(|(_, bin)| bin.count > 0)
            .map(|(place, bin)| (edge(place) + bin.sum / bin.count as f64, bin))
    }
}

/// The bits of the lowest edge that tell bins apart.
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
