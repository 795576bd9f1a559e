//! What a slow sensor reads while the car stands.

use crate::stats::quantile::median;
use std::ops::Range;

/// Of the readings of a rest those are outliers that are farther from their median than this, in deviations.
const OUTLIER: f64 = 3.0;

/// Readings are independent after so long: barometers smooth, s.
const SMOOTH: f64 = 1.0;

/// The readings of a rest that are no outliers, of which there may be none.
#[derive(Clone, Debug)]
pub(super) struct Rested {
    pub count: f64,
    /// The means of the readings and of their times.
    pub mean: f64,
    pub time: f64,
    /// How far each is off.
    pub off: Vec<f64>,
    /// So many of them are independent.
    independent: f64,
}

impl Rested {
    /// Of readings in order of time, each behind its time.
    pub fn of(readings: &[(f64, f64)], times: &Range<f64>) -> Self {
        let first = readings.partition_point(|it| it.0 < times.start);
        let end = readings.partition_point(|it| it.0 <= times.end).max(first);
        let readings = &readings[first..end];
        let middle = median(readings.iter().map(|it| it.1).collect());
        let off = readings.iter().map(|it| (it.1 - middle).abs());
        let deviation = 1.4826 * median(off.collect());
        let sound = readings.iter();
        let sound: Vec<(f64, f64)> = sound
            .filter(|it| (it.1 - middle).abs() <= OUTLIER * deviation)
            .copied()
            .collect();
        let count = sound.len() as f64;
        let mean = sound.iter().map(|it| it.1).sum::<f64>() / count;
        let ends = sound.first().zip(sound.last());
        let seconds = ends.map_or(0.0, |(first, last)| last.0 - first.0);
        Self {
            count,
            mean,
            time: sound.iter().map(|it| it.0).sum::<f64>() / count,
            off: sound.iter().map(|it| it.1 - mean).collect(),
            independent: count.min(1.0 + seconds / SMOOTH),
        }
    }

    /// The variance of the mean over that of a reading.
    pub fn of_mean(&self) -> f64 {
        1.0 / self.independent
    }
}
