//! A uniform grid for a signal whose samples come unevenly, or too often.
//!
//! The samples are joined by straight lines, and sample k of the result is the mean of that line over the
//! block of length 1/rate that begins at t₀ + k/rate; its time is the block's middle. One rule serves both
//! ways:
//!
//! - a lower rate is a block average, whose zeros lie at the multiples of the new rate, where vibration
//!   would be folded down to the frequencies of a ride. It has no overshoot and needs no more memory than
//!   its sum, and unlike a mean of samples it does not care how unevenly they lie in the block;
//! - a higher rate is linear interpolation, but for a mean over less than an interval.
//!
//! Blocks that a gap reaches into are left out: what was not measured is not made up. Averaging changes the
//! colour and the deviation of the noise, which is why it is done only when asked.

use super::error::RecordingError;
use super::series::{Sample, Series};

/// A series on a uniform grid.
pub(super) struct Resampled {
    series: Series,
    rate: f64,
    /// s; nothing is interpolated over a longer interval.
    gap: f64,
    origin: f64,
    last: Option<Sample>,
    /// The sample that the line goes to.
    next: Option<Sample>,
    /// The block that is being summed.
    block: f64,
    /// The integral over it up to `last`.
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
            // The line goes on from the end of the block.
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
