//! Finding the vertical among three axes.
//!
//! An accelerometer at rest reads gravity as an acceleration of 9.8 m/s² upwards. If the mean vector is about
//! that long, the axis within 25° of it is vertical, and its sign gives the direction; if no axis is that
//! near, the readings are projected on the mean vector.
//!
//! Without gravity the vertical axis is the one with the ride. The pulses of a ride last seconds and lie along
//! one axis, whereas picking up the device turns it and moves all three. So the record is cut into blocks of
//! half a second. The median over all blocks is subtracted from each block's mean; its square, at most
//! (1 m/s²)², less the squares on the other two axes, is credited to the axis on which it is largest. The
//! axis with the largest sum is taken. Shaking and vibration average out in a block, and a violent movement
//! counts no more than a strong pulse.

use super::axis::Axis;
use super::blocks::Blocks;
use super::error::RecordingError;
use super::layout::Layout;
use super::series::Readings;
use super::source::Source;
use super::vertical::{Direction, Reason, Vertical, is_gravity};
use std::sync::Arc;

/// The largest angle from gravity at which an axis is taken as vertical: its readings are then those of the
/// vertical times cos 25° = 0.91.
const WIDEST: f64 = 25.0;

/// Statistics of the axes from one pass.
#[derive(Debug)]
pub(super) struct Bearings {
    axes: Vec<(Axis, usize)>,
    sums: Vec<f64>,
    counts: Vec<u64>,
    /// Rows with readings of all axes.
    together: u64,
    blocks: Blocks,
}

impl Bearings {
    /// Reads the whole table. A cut end and times out of order are left to the next pass.
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

    /// The mean vector, if each axis has readings.
    fn mean(&self) -> Option<Vec<f64>> {
        let mean = |(sum, count): (&f64, &u64)| (*count > 0).then(|| sum / *count as f64);
        self.sums.iter().zip(&self.counts).map(mean).collect()
    }

    /// The mean vector and its length, if it is gravity.
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
    /// The condition that is not met.
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
        /// A sum too small for a ride, (m/s²)²: a second at 0.1 m/s².
        const NOTHING: f64 = 0.02;
        /// A ratio of the two largest sums below this counts as a tie.
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
