//! A recording in windows of half a second, as vectors.

use super::table::Columns;
use super::unit::Unit;
use crate::stats::quantile::median;
use crate::vector::{Vector, dot, largest, length, mix, unit};
use std::ops::{Range, RangeInclusive};

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// A mean of this length is gravity, m/s²: 9.8 up to the bias of a poor sensor.
pub(super) const GRAVITATION: RangeInclusive<f64> = 8.5..=11.5;

/// No lift accelerates so, m/s²: a shock, or handling.
const SHOCK: f64 = 2.5;

/// The mean vectors of windows of half a second.
#[derive(Debug, Default)]
pub(super) struct Windows {
    /// Their middles, s.
    pub times: Vec<f64>,
    pub means: Vec<Vector>,
    /// The least share of rows with readings of all axes among those with readings of one.
    pub together: f64,
}

impl Windows {
    /// In the unit of the columns; 0 for an axis that is not there.
    pub fn of(columns: &Columns) -> Self {
        let mut windows = Self::default();
        let window_of = |time: f64| (time / WINDOW).floor();
        let mut rest = &columns.times[..];
        let mut rows = 0..0;
        while let Some(first) = rest.first() {
            // Times increase, and twice a time is exact: rounding each of them down would take longer.
            let end = window_of(*first) + 1.0;
            let others = rest.iter().skip(1).take_while(|time| **time / WINDOW < end);
            let (times, after) = rest.split_at(1 + others.count());
            rest = after;
            rows = rows.end..rows.end + times.len();
            let mut mean = [0.0; 3];
            for (mean, axis) in mean.iter_mut().zip(&columns.axes) {
                let read = axis[rows.clone()]
                    .iter()
                    .filter(|reading| !reading.is_nan());
                *mean = read.clone().sum::<f64>() / read.count() as f64;
            }
            // Without readings of an axis its mean is NaN.
            if !mean.iter().any(|along| along.is_nan()) {
                windows.times.push((window_of(times[0]) + 0.5) * WINDOW);
                windows.means.push(mean);
            }
        }
        let is_read = |row: usize| move |axis: &Vec<f64>| !axis[row].is_nan();
        let all = (0..columns.times.len()).filter(|row| columns.axes.iter().all(is_read(*row)));
        let read = |axis: &Vec<f64>| axis.iter().filter(|reading| !reading.is_nan()).count();
        let most = columns.axes.iter().map(read).max().unwrap_or(0);
        windows.together = all.count() as f64 / most.max(1) as f64;
        windows
    }

    pub fn convert(&mut self, unit: Unit, axes: usize) {
        let readings = self.means.iter_mut().flat_map(|mean| &mut mean[..axes]);
        readings.for_each(|reading| *reading = unit.convert(*reading));
    }

    /// The median length.
    pub fn length(&self) -> f64 {
        median(self.means.iter().map(|mean| length(*mean)).collect())
    }

    pub fn has_gravity(&self) -> bool {
        GRAVITATION.contains(&self.length())
    }

    /// The median vector.
    pub fn median(&self, range: Range<usize>) -> Vector {
        let means = &self.means[range];
        [0, 1, 2].map(|axis| median(means.iter().map(|mean| mean[axis]).collect()))
    }

    /// The sixth largest distance of a smoothed window from the median: what lasts 3 s in all.
    pub fn strength(&self) -> f64 {
        let lengths = sorted(self.pulses(f64::INFINITY).into_iter().map(length));
        let sixth = lengths.len().saturating_sub(6);
        lengths.get(sixth).copied().unwrap_or(0.0)
    }

    /// The windows over the median, low-passed at about 1 Hz, without those beyond `shock`.
    fn pulses(&self, shock: f64) -> Vec<Vector> {
        let level = self.median(0..self.means.len());
        let above = |mean: &Vector| mix([(1.0, *mean), (-1.0, level)]);
        let above: Vec<Vector> = self.means.iter().map(above).collect();
        let three = above.windows(3);
        three
            .filter(|three| three.iter().all(|v| length(*v) < shock))
            .map(|three| mix([(0.25, three[0]), (0.5, three[1]), (0.25, three[2])]))
            .collect()
    }

    /// The direction of the pulses, if they stand out: the first principal direction, weighted by squares.
    pub fn principal(&self) -> Option<Vector> {
        /// A weaker pulse is none of a lift, m/s².
        const WEAKEST: f64 = 0.08;
        /// Pulses are stronger than what is usual in a record by this factor.
        const OVER_NOISE: f64 = 4.0;
        /// The share of the squares along the direction: noise alike in three axes has a third.
        const SHARE: f64 = 0.7;
        let pulses = self.pulses(SHOCK);
        let weighted = |a: usize, b: usize| pulses.iter().map(|v| dot(*v, *v) * v[a] * v[b]).sum();
        let covariance: [Vector; 3] = [0, 1, 2].map(|a| [0, 1, 2].map(|b| weighted(a, b)));
        let diagonal = [0, 1, 2].map(|axis| covariance[axis][axis]);
        let mut up = [0.0; 3];
        up[largest(diagonal)] = 1.0;
        for _ in 0..64 {
            up = unit(covariance.map(|row| dot(row, up)))?;
        }
        let share = dot(covariance.map(|row| dot(row, up)), up) / diagonal.iter().sum::<f64>();
        let along = sorted(pulses.iter().map(|v| dot(*v, up).abs()));
        let strongest = along.get(along.len().saturating_sub(3))?;
        let usual = along[along.len() / 2];
        let stands_out = *strongest > WEAKEST.max(OVER_NOISE * usual) && share > SHARE;
        let sign = up[largest(up)].signum();
        stands_out.then(|| up.map(|along| sign * along))
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}
