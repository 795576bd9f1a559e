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

use super::sample::Sample;

/// The samples on a uniform grid; `gap` is the longest interval that is interpolated, s.
pub(super) fn resample(samples: &[Sample], rate: f64, gap: f64) -> Vec<Sample> {
    let mut resampled = Vec::new();
    let Some(origin) = samples.first().map(|first| first.time) else {
        return resampled;
    };
    let edge = |block: f64| origin + block / rate;
    // The integral over the current block up to the current sample.
    let (mut block, mut area) = (0.0, 0.0);
    for pair in samples.windows(2) {
        let [last, next] = [pair[0], pair[1]];
        if next.time - last.time > gap {
            block = ((next.time - origin) * rate).ceil();
            area = 0.0;
            continue;
        }
        let at = |time: f64| {
            let share = (time - last.time) / (next.time - last.time);
            last.acceleration + share * (next.acceleration - last.acceleration)
        };
        let mut from = last.time.max(edge(block));
        while edge(block + 1.0) <= next.time {
            let end = edge(block + 1.0);
            area += 0.5 * (end - from) * (at(from) + at(end));
            resampled.push(Sample {
                time: edge(block + 0.5),
                acceleration: area / (end - edge(block)),
            });
            (from, area, block) = (end, 0.0, block + 1.0);
        }
        if from < next.time {
            area += 0.5 * (next.time - from) * (at(from) + at(next.time));
        }
    }
    resampled
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
        let samples = recording.samples().iter();
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
