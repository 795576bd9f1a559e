//! Resampling of a signal to a uniform grid.
//!
//! The samples are joined by straight lines, and sample k of the result is the mean of that line over the
//! block of length 1/rate that begins at t₀ + k/rate; its time is the block's middle. The same rule lowers and
//! raises the rate:
//!
//! - a lower rate is a block average, whose zeros lie at the multiples of the new rate, where vibration
//!   would be aliased to the frequencies of a ride. It has no overshoot, needs no memory but its sum, and,
//!   unlike a mean of samples, does not depend on how unevenly they lie in the block;
//! - a higher rate is linear interpolation, averaged over less than an interval.
//!
//! Blocks that a gap reaches into are left out, because nothing was measured there. Averaging changes the
//! colour and the variance of the noise, so it is done only on request.

use super::error::RecordingError;
use super::series::{Sample, Series};

/// A series on a uniform grid.
pub(super) struct Resampled {
    series: Series,
    rate: f64,
    /// The longest interval that is interpolated, s.
    gap: f64,
    origin: f64,
    last: Option<Sample>,
    /// The sample at the end of the current line.
    next: Option<Sample>,
    /// The current block.
    block: f64,
    /// The integral over the current block up to `last`.
    area: f64,
}

impl Resampled {
    pub fn new(series: Series, rate: f64, gap: f64) -> Self {
        Self {
            series,
            rate,
            gap,
            origin: 0.0,
            last: None,
            next: None,
            block: 0.0,
            area: 0.0,
        }
    }

    fn time(&self, block: f64) -> f64 {
        self.origin + block / self.rate
    }

    /// Begins with the first block that lies after `sample`.
    fn begin(&mut self, sample: Sample) {
        let blocks = (sample.time - self.origin) * self.rate;
        self.block = blocks.ceil().max(self.block);
        self.area = 0.0;
        self.last = Some(sample);
    }

    fn advance(&mut self) -> Result<Option<Sample>, RecordingError> {
        loop {
            let Some(last) = self.last else {
                let Some(first) = self.series.next().transpose()? else {
                    return Ok(None);
                };
                self.origin = first.time;
                self.begin(first);
                continue;
            };
            let next = match self.next.take() {
                Some(next) => next,
                None => match self.series.next().transpose()? {
                    Some(next) => next,
                    None => return Ok(None),
                },
            };
            if next.time - last.time > self.gap {
                self.begin(next);
                continue;
            }
            let (start, end) = (self.time(self.block), self.time(self.block + 1.0));
            let at = |time: f64| {
                let share = (time - last.time) / (next.time - last.time);
                last.acceleration + share * (next.acceleration - last.acceleration)
            };
            let from = last.time.max(start);
            let to = next.time.min(end);
            if from < to {
                self.area += 0.5 * (to - from) * (at(from) + at(to));
            }
            if next.time < end {
                self.last = Some(next);
                continue;
            }
            let middle = Sample {
                time: self.time(self.block + 0.5),
                acceleration: self.area / (end - start),
            };
            self.area = 0.0;
            self.block += 1.0;
            // The line continues from the end of the block.
            self.last = Some(Sample {
                time: end,
                acceleration: at(end),
            });
            self.next = (next.time > end).then_some(next);
            return Ok(Some(middle));
        }
    }
}

impl Iterator for Resampled {
    type Item = Result<Sample, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Reading, Recording};

    fn resampled(rows: &[(f64, f64)], rate: f64) -> Vec<(f64, f64)> {
        let rows: String = rows.iter().map(|(t, a)| format!("{t},{a}\n")).collect();
        let reading = Reading {
            resample: Some(rate),
            ..Reading::default()
        };
        let recording = Recording::from_bytes("ride", rows.into_bytes(), &reading).unwrap();
        let samples = recording.samples().unwrap().map(Result::unwrap);
        samples
            .map(|sample| (sample.time, sample.acceleration))
            .collect()
    }

    fn agree(found: &[(f64, f64)], expected: &[(f64, f64)]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            let distance = (found.0 - expected.0).abs() + (found.1 - expected.1).abs();
            assert!(distance < 1e-12, "{found:?}, expected {expected:?}");
        }
    }

    /// The mean of a straight line over a block is its value in the middle, for any spacing of samples.
    #[test]
    fn a_line_stays_a_line() {
        let line = |t: f64| (t, 3.0 * t - 1.0);
        let uneven = [0.0, 0.125, 0.15, 0.375, 0.5, 0.75, 1.0].map(line);
        for rate in [4.0, 8.0, 16.0, 20.0] {
            let blocks = rate as u32;
            let middles: Vec<_> = (0..blocks)
                .map(|k| line((f64::from(k) + 0.5) / rate))
                .collect();
            agree(&resampled(&uneven, rate), &middles);
        }
    }

    /// Vibration at a multiple of the new rate is averaged out.
    #[test]
    fn vibration_is_not_folded_down() {
        let zigzag: Vec<_> = (0..=100)
            .map(|i| (0.01 * f64::from(i), f64::from(i % 2)))
            .collect();
        let blocks = resampled(&zigzag, 10.0);
        assert_eq!(blocks.len(), 10);
        blocks
            .iter()
            .for_each(|(_, a)| assert!((a - 0.5).abs() < 1e-12));
    }

    #[test]
    fn nothing_is_made_up_in_a_gap() {
        let times = (0..=10).chain(30..=40).map(|i| 0.125 * f64::from(i));
        let rows: Vec<_> = times.map(|t| (t, t)).collect();
        let middles = |from: i32, to: i32| (from..to).map(|k| 0.5 * (f64::from(k) + 0.5));
        let expected: Vec<_> = middles(0, 2)
            .chain(middles(8, 10))
            .map(|t| (t, t))
            .collect();
        agree(&resampled(&rows, 2.0), &expected);
    }
}
