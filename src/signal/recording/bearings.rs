//! Finding the vertical among three axes.
//!
//! An accelerometer at rest reads gravity as an acceleration of 9.8 m/s² upwards. Where the mean vector is
//! about as long, the axis within 25° of it is vertical, and its sign says which end is up; where none is
//! so near, the readings are projected on it.
//!
//! Where gravity has been taken out, the vertical axis is the one with the ride. A ride's pulses last
//! seconds and lie along one axis, whereas a hand that picks up the device turns it, and moves all
//! three. So the record is cut into blocks of half a second; each block's mean, less the median over all
//! blocks, is credited to the axis on which it is largest, by its square up to 1 m/s² less the squares
//! of the other two. The largest sum wins. Shaking and vibration average out in a block, and a wild
//! movement counts no more than a strong pulse.

use super::axis::Axis;
use super::blocks::Blocks;
use super::error::RecordingError;
use super::layout::Layout;
use super::series::Readings;
use super::source::Source;
use super::vertical::{Direction, Reason, Vertical, is_gravity};
use std::sync::Arc;

/// How far from gravity an axis may lie and still be taken for the vertical: its readings are then those
/// of the vertical times cos 25° = 0.91.
const WIDEST: f64 = 25.0;

/// What is known of the axes after one pass.
#[derive(Debug)]
pub(super) struct Bearings {
    axes: Vec<(Axis, usize)>,
    sums: Vec<f64>,
    counts: Vec<u64>,
    /// Rows in which all axes stand.
    together: u64,
    blocks: Blocks,
}

impl Bearings {
    /// Reads the whole table. Its end, and times out of order, are left to the pass after this.
    pub fn take(
        source: &Source,
        layout: &Arc<Layout>,
        axes: &[(Axis, usize)],
    ) -> Result<Self, RecordingError> {
        let mut readings = Readings::open(source, layout)?;
        let mut bearings = Self {
            axes: axes.to_vec(),
            sums: vec![0.0; axes.len()],
            counts: vec![0; axes.len()],
            together: 0,
            blocks: Blocks::new(axes.len()),
        };
        while readings.table.advance()? {
            let time = readings.time()?;
            let mut found = 0;
            for (index, (_, column)) in axes.iter().enumerate() {
                let reading = readings.acceleration(*column)?;
                if let (Some(time), Some(acceleration)) = (time, reading) {
                    found += 1;
                    bearings.sums[index] += acceleration;
                    bearings.counts[index] += 1;
                    bearings.blocks.add(index, time, acceleration);
                }
            }
            bearings.together += u64::from(found == axes.len());
        }
        Ok(bearings)
    }

    /// The mean vector, where each axis has been read.
    fn mean(&self) -> Option<Vec<f64>> {
        let mean = |(sum, count): (&f64, &u64)| (*count > 0).then(|| sum / *count as f64);
        self.sums.iter().zip(&self.counts).map(mean).collect()
    }

    /// The mean, where it is gravity's, and its length.
    fn gravity(&self) -> Option<(Vec<f64>, f64)> {
        let mean = self.mean()?;
        let length = mean.iter().map(|m| m * m).sum::<f64>().sqrt();
        is_gravity(length).then_some((mean, length))
    }

    /// The vertical, by gravity or by the ride.
    pub fn find(&self) -> Vertical {
        let Some((mean, length)) = self.gravity() else {
            return self.by_ride();
        };
        let cosines = mean.iter().map(|m| m.abs() / length);
        let (cosine, nearest) = cosines
            .zip(0..)
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0));
        let angle = cosine.min(1.0).acos().to_degrees();
        match self.project() {
            Ok(projected) if angle > WIDEST => projected,
            _ => self.along(nearest, mean[nearest].signum(), Reason::Gravity(angle)),
        }
    }

    /// The direction of gravity itself.
    ///
    /// # Errors
    /// What is lacking.
    pub fn project(&self) -> Result<Vertical, &'static str> {
        let &[(_, x), (_, y), (_, z)] = &self.axes[..] else {
            return Err("fewer than three axes");
        };
        let (mean, length) = self.gravity().ok_or("another mean")?;
        let most = self.counts.iter().max().copied().unwrap_or(0);
        if self.together * 10 < most * 9 {
            return Err("them in different rows");
        }
        let up = [mean[0] / length, mean[1] / length, mean[2] / length];
        Ok(Vertical {
            direction: Direction::Projected {
                columns: [x, y, z],
                up,
            },
            reason: Reason::Gravity(0.0),
        })
    }

    fn by_ride(&self) -> Vertical {
        /// (m/s²)² that tell nothing: a second at 0.1 m/s², which is no ride.
        const NOTHING: f64 = 0.02;
        /// A lead that is none.
        const TIE: f64 = 2.0;
        let credits = self.blocks.credits();
        let mut order: Vec<usize> = (0..credits.len()).collect();
        order.sort_by(|&a, &b| credits[b].total_cmp(&credits[a]));
        let credit = |place: usize| order.get(place).map_or(0.0, |&axis| credits[axis]) + NOTHING;
        let lead = credit(0) / credit(1);
        if lead >= TIE || self.axes.len() == 1 {
            let reason = if self.axes.len() == 1 {
                Reason::Only
            } else {
                Reason::Ride(lead)
            };
            return self.along(order[0], 1.0, reason);
        }
        let is_tied = |axis: &usize| (credits[*axis] + NOTHING) * TIE > credit(0);
        let z = order
            .iter()
            .copied()
            .filter(is_tied)
            .find(|&axis| self.axes[axis].0 == Axis::Z);
        self.along(z.unwrap_or(order[0]), 1.0, Reason::NearTie)
    }

    fn along(&self, index: usize, sign: f64, reason: Reason) -> Vertical {
        let (axis, column) = self.axes[index];
        Vertical {
            direction: Direction::Along {
                column,
                axis: Some(axis),
                sign,
            },
            reason,
        }
    }
}
