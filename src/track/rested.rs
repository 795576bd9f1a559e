//! What a slow sensor reads while the car stands.

use crate::stats::quantile::median;
use libm::floor;

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
    /// So many means of a second are independent.
    seconds: f64,
    /// When each was read, and how far it is off.
    off: Vec<(f64, f64)>,
}

impl Rested {
    /// Of readings in order of time, each behind its time, s.
    pub fn of(readings: &[(f64, f64)]) -> Self {
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
        let span = ends.map_or(0.0, |(first, last)| last.0 - first.0);
        // Each reading stands for its interval.
        let held = span * count / (count - 1.0).max(1.0) / SMOOTH;
        Self {
            count,
            mean,
            time: sound.iter().map(|it| it.0).sum::<f64>() / count,
            seconds: held.max(1.0).min(count),
            off: sound.iter().map(|it| (it.0, it.1 - mean)).collect(),
        }
    }

    /// The variance of the mean over that of the mean of a second.
    pub fn of_mean(&self) -> f64 {
        1.0 / self.seconds
    }

    /// From the first reading to the last, s.
    pub fn times(&self) -> Option<(f64, f64)> {
        Some((self.off.first()?.0, self.off.last()?.0))
    }

    /// How far the mean of each second is off.
    fn by_second(&self) -> impl Iterator<Item = f64> {
        let second = |it: &(f64, f64)| floor(it.0 / SMOOTH);
        let seconds = self
            .off
            .chunk_by(move |one, next| second(one) == second(next));
        seconds.map(|some| some.iter().map(|it| it.1).sum::<f64>() / some.len() as f64)
    }
}

/// The deviation of a reading, and that of the mean of a second, which is no less than if the readings knew nothing of each other.
pub(super) fn noise<'a>(rests: impl Iterator<Item = &'a Rested> + Clone) -> (f64, f64) {
    let squares = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |sum, it| sum + it * it);
    let per = |sum: f64, spare: f64| sum / spare.max(1.0);
    let all = rests
        .clone()
        .map(|it| squares(&mut it.off.iter().map(|it| it.1)));
    let spare = rests.clone().map(|it| (it.count - 1.0).max(0.0));
    let reading = per(all.sum(), spare.sum());
    let all = rests.clone().map(|it| squares(&mut it.by_second()));
    let spare = rests
        .clone()
        .map(|it| it.by_second().count().saturating_sub(1) as f64);
    let second = per(all.sum(), spare.sum());
    let (count, seconds) = rests.fold((0.0, 0.0), |sum, it| (sum.0 + it.count, sum.1 + it.seconds));
    let least = reading * seconds / f64::max(count, 1.0);
    (reading.sqrt(), second.max(least).sqrt())
}
