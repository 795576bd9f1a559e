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
use super::error::RecordingError;
use super::layout::Layout;
use super::reading::GRAVITY;
use super::series::Readings;
use super::source::Source;
use std::fmt;
use std::sync::Arc;

/// Which way is up, and how that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertical {
    /// Which way.
    pub direction: Direction,
    /// How that is known.
    pub reason: Reason,
}

/// The direction along which the acceleration is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Direction {
    /// Along one column.
    Along {
        /// Its place in the table, from 0.
        column: usize,
        /// Its axis, where it has one.
        axis: Option<Axis>,
        /// −1 where it points down.
        sign: f64,
    },
    /// Along a direction between three of them.
    Projected {
        /// Their places in the table, from 0.
        columns: [usize; 3],
        /// A vector of length 1.
        up: [f64; 3],
    },
}

/// How the vertical was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The reader said so.
    Given,
    /// There is no other.
    Only,
    /// It lies this near to gravity, in degrees.
    Gravity(f64),
    /// The ride is along it, more than along any other by this factor.
    Ride(f64),
    /// No axis stands out: z where there is one.
    NearTie,
}

impl Vertical {
    /// The same upside down.
    pub(super) fn turned(mut self) -> Self {
        match &mut self.direction {
            Direction::Along { sign, .. } => *sign = -*sign,
            Direction::Projected { up, .. } => *up = up.map(|along| -along),
        }
        self
    }
}

impl fmt::Display for Vertical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.direction {
            Direction::Along { axis, sign, .. } => {
                let minus = if *sign < 0.0 { "-" } else { "" };
                match axis {
                    Some(axis) => write!(f, "{minus}{axis}")?,
                    None => write!(f, "{minus}1 times its column")?,
                }
            }
            Direction::Projected { up: [x, y, z], .. } => {
                write!(f, "({x:.3}, {y:.3}, {z:.3})")?;
            }
        }
        match self.reason {
            Reason::Given => f.write_str(", as given"),
            Reason::Only => f.write_str(", the only one"),
            Reason::Gravity(angle) => write!(f, ", {angle:.1} degrees from gravity"),
            Reason::Ride(factor) => write!(f, ", with {factor:.1} times the ride of any other"),
            Reason::NearTie => f.write_str(", though no axis stands out"),
        }
    }
}

/// How far from gravity an axis may lie and still be taken for the vertical: its readings are then those
/// of the vertical times cos 25° = 0.91.
const WIDEST: f64 = 25.0;

/// Whether a mean is gravity: 9.8 m/s² but for the bias of a bad sensor, and the tilt of one axis.
pub(super) fn is_gravity(mean: f64) -> bool {
    (0.87 * GRAVITY..=1.13 * GRAVITY).contains(&mean.abs())
}

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

/// Means over blocks of half a second of several axes, in bounded memory.
#[derive(Debug)]
struct Blocks {
    current: Option<i64>,
    sums: Vec<(f64, u64)>,
    /// The means of all axes, block after block.
    means: Vec<f64>,
    /// Only every so many blocks are kept; twice as many whenever the list is full.
    stride: i64,
}

/// s.
const BLOCK: f64 = 0.5;

/// Blocks that are kept: nine hours without a stride.
const MOST_BLOCKS: usize = 1 << 16;

impl Blocks {
    fn new(axes: usize) -> Self {
        Self {
            current: None,
            sums: vec![(0.0, 0); axes],
            means: Vec::new(),
            stride: 1,
        }
    }

    fn add(&mut self, axis: usize, time: f64, acceleration: f64) {
        let block = (time / BLOCK).floor() as i64;
        if self.current != Some(block) {
            self.end();
            self.current = Some(block);
        }
        let (sum, count) = &mut self.sums[axis];
        *sum += acceleration;
        *count += 1;
    }

    /// Keeps the block if every axis was read in it.
    fn end(&mut self) {
        let axes = self.sums.len();
        let is_kept = self.current.is_some_and(|block| block % self.stride == 0);
        if is_kept && self.sums.iter().all(|(_, count)| *count > 0) {
            let means = self.sums.iter().map(|(sum, count)| sum / *count as f64);
            self.means.extend(means);
        }
        self.sums.fill((0.0, 0));
        if self.means.len() >= MOST_BLOCKS * axes {
            self.stride *= 2;
            let blocks = self.means.chunks_exact(axes).step_by(2);
            self.means = blocks.flatten().copied().collect();
        }
    }

    /// What each axis is credited with.
    fn credits(&self) -> Vec<f64> {
        let axes = self.sums.len();
        let current = self.sums.iter().all(|(_, count)| *count > 0);
        let last: Vec<f64> = self
            .sums
            .iter()
            .filter(|_| current)
            .map(|(sum, count)| sum / *count as f64)
            .collect();
        let blocks = || self.means.chunks_exact(axes).chain(last.chunks_exact(axes));
        let medians: Vec<f64> = (0..axes)
            .map(|axis| median(blocks().map(|block| block[axis]).collect()))
            .collect();
        let mut credits = vec![0.0; axes];
        for block in blocks() {
            let squares: Vec<f64> = block
                .iter()
                .zip(&medians)
                .map(|(mean, median)| (mean - median) * (mean - median))
                .collect();
            let total: f64 = squares.iter().sum();
            for (credit, square) in credits.iter_mut().zip(&squares) {
                *credit += (square.min(1.0) - (total - square)).max(0.0);
            }
        }
        credits
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    match values.is_empty() {
        true => 0.0,
        false => *values.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}
