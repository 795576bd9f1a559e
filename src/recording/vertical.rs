//! The vertical among the axes of a sensor.
//!
//! An accelerometer at rest reads gravity as an acceleration of 9.8 m/s² upwards, and a ride accelerates along
//! it. So the mean vectors of windows of half a second all point up, at rest and in motion, and their median is
//! the vertical. Where for about 20 s they point elsewhere, the device has been turned, and the local
//! median is followed; the direction is interpolated, so that no step arises.
//!
//! Without gravity the vertical is the direction of the pulses of a ride: the first principal direction of
//! the smoothed windows, weighted by their squares, without shocks. Its sign cannot be known.

use super::axis::{AXES, Axis};
use super::table::Columns;
use super::unit::Unit;
use std::fmt;
use std::ops::{Range, RangeInclusive};

/// The vertical direction, and how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertical {
    /// The direction.
    pub direction: Direction,
    /// How it was found.
    pub reason: Reason,
    /// Whether it is certain which way is up.
    pub sign: Sign,
}

/// The direction along which the acceleration is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Direction {
    /// Along one column.
    Along {
        /// Its place among the columns of accelerations.
        place: usize,
        /// 0, 1 or 2 for x, y or z, if it is one of them.
        axis: Option<usize>,
        /// −1 if it points down.
        sign: f64,
    },
    /// Along a direction between x, y and z, of length 1.
    Projected([f64; 3]),
}

/// How the vertical was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// Given by the user.
    Given,
    /// The only column.
    Only,
    /// By gravity, which is so many degrees from it and turned by so many degrees in the record.
    Gravity {
        /// Degrees.
        from: f64,
        /// Degrees.
        turned: f64,
    },
    /// By the pulses of a ride.
    Pulses,
    /// Nothing shows it.
    Nothing,
}

/// How the upward direction is known.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Sign {
    /// By gravity, or as the user says.
    Known,
    /// The positive side of an axis.
    Assumed,
}

impl Vertical {
    /// The opposite direction, wanted by the user.
    pub(super) fn inverted(self) -> Self {
        Self {
            sign: Sign::Known,
            ..self.turned()
        }
    }

    fn turned(mut self) -> Self {
        match &mut self.direction {
            Direction::Along { sign, .. } => *sign = -*sign,
            Direction::Projected(up) => *up = up.map(|along| -along),
        }
        self
    }

    /// The axis nearest to it, with its sign.
    fn nearest(&self) -> String {
        let (axis, sign) = match &self.direction {
            Direction::Along { axis, sign, .. } => (*axis, *sign),
            Direction::Projected(up) => {
                let axis = largest(*up);
                (Some(axis), up[axis])
            }
        };
        let name = axis.map_or("that column", |axis| AXES[axis]);
        format!("{}{name}", if sign < 0.0 { "-" } else { "" })
    }
}

impl fmt::Display for Vertical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.direction {
            Direction::Along { .. } => f.write_str(&self.nearest())?,
            Direction::Projected(up) => {
                // Never "-0.00".
                let [x, y, z] = up.map(|along| (100.0 * along).round() / 100.0 + 0.0);
                write!(f, "projected on ({x:.2}, {y:.2}, {z:.2})")?;
            }
        }
        let is_along = matches!(self.direction, Direction::Along { .. });
        match self.reason {
            Reason::Given => f.write_str(" (as given)")?,
            Reason::Only => f.write_str(" (the only one)")?,
            Reason::Gravity { from, .. } if is_along => {
                write!(f, ", {from:.0} degrees from gravity")?;
            }
            Reason::Gravity { turned, .. } => {
                f.write_str(", the direction of gravity")?;
                if turned >= TURNED.1 {
                    write!(f, ", which turns by {turned:.0} degrees and is followed")?;
                }
            }
            Reason::Pulses => f.write_str(", the direction of the pulses")?,
            Reason::Nothing => f.write_str("; no axis carries a ride (--axis x, y or z)")?,
        }
        match (self.sign, &self.direction) {
            (Sign::Known, _) => Ok(()),
            (Sign::Assumed, Direction::Along { axis: None, .. }) => {
                f.write_str("; up assumed to be positive (--invert)")
            }
            (Sign::Assumed, _) => {
                let up = self.nearest();
                let plus = if up.starts_with('-') { "" } else { "+" };
                write!(f, "; up assumed along {plus}{up} (--invert)")
            }
        }
    }
}

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// Windows on each side in the neighbourhood of one: 20 s in all.
const NEIGHBOURS: usize = 20;

/// Windows from one local direction to the next.
const STRIDE: usize = 4;

/// Where the local direction differs from the median by more than the second angle, degrees, it is followed, by
/// less than the first it is not; between them in part. People shake a lift by less than a degree.
const TURNED: (f64, f64) = (3.0, 6.0);

/// A mean of this length is gravity, m/s²: 9.8 up to the bias of a poor sensor.
const GRAVITATION: RangeInclusive<f64> = 8.5..=11.5;

/// No lift accelerates so, m/s²: a shock, or handling.
const SHOCK: f64 = 2.5;

/// The mean vectors of windows of half a second.
#[derive(Debug, Default)]
pub(super) struct Windows {
    /// Their middles, s.
    times: Vec<f64>,
    means: Vec<[f64; 3]>,
    /// The least share of rows with readings of all axes among those with readings of one.
    together: f64,
}

impl Windows {
    /// In the unit of the columns; 0 for an axis that is not there.
    pub fn of(columns: &Columns) -> Self {
        let mut windows = Self::default();
        let of_window = |a: &f64, b: &f64| (a / WINDOW).floor() == (b / WINDOW).floor();
        let mut from = 0;
        for window in columns.times.chunk_by(of_window) {
            let rows = from..from + window.len();
            from = rows.end;
            let mut mean = [0.0; 3];
            for (mean, axis) in mean.iter_mut().zip(&columns.axes) {
                let read = axis[rows.clone()]
                    .iter()
                    .filter(|reading| !reading.is_nan());
                *mean = read.clone().sum::<f64>() / read.count() as f64;
            }
            // Without readings of an axis its mean is NaN.
            if !mean.iter().any(|along| along.is_nan()) {
                windows
                    .times
                    .push(((window[0] / WINDOW).floor() + 0.5) * WINDOW);
                windows.means.push(mean);
            }
        }
        let is_read = |row: usize| move |axis: &Vec<f64>| !axis[row].is_nan();
        let rows = 0..columns.times.len();
        let all = rows.filter(|row| columns.axes.iter().all(is_read(*row)));
        let read = |axis: &Vec<f64>| axis.iter().filter(|reading| !reading.is_nan()).count();
        let most = columns.axes.iter().map(read).max().unwrap_or(0);
        windows.together = all.count() as f64 / most.max(1) as f64;
        windows
    }

    /// The median length.
    pub fn length(&self) -> f64 {
        median(self.means.iter().map(|mean| length(*mean)))
    }

    /// The sixth largest distance of a smoothed window from the median: what lasts 3 s in all.
    pub fn strength(&self) -> f64 {
        let pulses = self.pulses(f64::INFINITY);
        let lengths = sorted(pulses.into_iter().map(length));
        let sixth = lengths.len().saturating_sub(6);
        lengths.get(sixth).copied().unwrap_or(0.0)
    }

    pub fn convert(&mut self, unit: Unit, number: usize) {
        let readings = self.means.iter_mut().flat_map(|mean| &mut mean[..number]);
        readings.for_each(|reading| *reading = unit.convert(*reading));
    }

    pub fn has_gravity(&self) -> bool {
        GRAVITATION.contains(&self.length())
    }

    /// The median vector.
    fn median(&self, range: Range<usize>) -> [f64; 3] {
        let means = &self.means[range];
        [0, 1, 2].map(|axis| median(means.iter().map(|mean| mean[axis])))
    }

    /// The windows over the median, low-passed at about 1 Hz, without those beyond `shock`.
    fn pulses(&self, shock: f64) -> Vec<[f64; 3]> {
        let level = self.median(0..self.means.len());
        let above = |mean: &[f64; 3]| mix([(1.0, *mean), (-1.0, level)]);
        let above: Vec<[f64; 3]> = self.means.iter().map(above).collect();
        let three = above.windows(3);
        three
            .filter(|three| three.iter().all(|v| length(*v) < shock))
            .map(|three| mix([(0.25, three[0]), (0.5, three[1]), (0.25, three[2])]))
            .collect()
    }

    /// The direction of the pulses, if they stand out.
    fn principal(&self) -> Option<[f64; 3]> {
        /// A weaker pulse is none of a lift, m/s².
        const WEAKEST: f64 = 0.08;
        /// Pulses are stronger than what is usual in a record by this factor.
        const OVER_NOISE: f64 = 4.0;
        /// The share of the squares along the direction: noise alike in three axes has a third.
        const SHARE: f64 = 0.7;
        let pulses = self.pulses(SHOCK);
        let squares = |a: usize, b: usize| {
            let weighted = pulses.iter().map(|v| dot(*v, *v) * v[a] * v[b]);
            weighted.sum::<f64>()
        };
        let covariance = [0, 1, 2].map(|a| [0, 1, 2].map(|b| squares(a, b)));
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

/// Finds the vertical. `is_reversed`: up reads negative, which shows only in a record without gravity.
///
/// # Errors
/// If gravity is wanted and not there; the condition that is not met.
pub(super) fn find(
    columns: &Columns,
    windows: &Windows,
    axis: Axis,
    is_reversed: bool,
) -> Result<Vertical, &'static str> {
    let axes = &columns.layout.axes;
    let has_gravity = windows.has_gravity();
    let median = windows.median(0..windows.means.len());
    let along = |place: usize, sign: f64, reason, is_known| Vertical {
        direction: Direction::Along {
            place,
            axis: axes[place].0,
            sign,
        },
        reason,
        sign: if is_known { Sign::Known } else { Sign::Assumed },
    };
    let can_project = axes.len() == 3 && windows.together >= 0.9;
    let is_given = columns.layout.is_given;
    if let (Axis::Along { is_down: true, .. }, true) = (axis, is_given) {
        return Ok(along(0, -1.0, Reason::Given, true));
    }
    if axes.len() == 1 {
        let reason = if is_given {
            Reason::Given
        } else {
            Reason::Only
        };
        // Gravity shows which way is up.
        let sign = if has_gravity && median[0] < 0.0 {
            -1.0
        } else {
            1.0
        };
        return Ok(along(0, sign, reason, has_gravity || is_given));
    }
    if axis == Axis::Gravity && !(has_gravity && can_project) {
        return Err(if has_gravity {
            "them in different rows"
        } else {
            "another length"
        });
    }
    if has_gravity {
        let place = largest(median);
        let from = (median[place].abs() / length(median)).min(1.0);
        let from = libm::acos(from).to_degrees();
        let Some(up) = unit(median).filter(|_| can_project) else {
            let reason = Reason::Gravity { from, turned: 0.0 };
            return Ok(along(place, median[place].signum(), reason, true));
        };
        let turned = path(windows, up)
            .into_iter()
            .map(|(_, local)| angle(local, up));
        return Ok(Vertical {
            direction: Direction::Projected(up),
            reason: Reason::Gravity {
                from,
                turned: turned.fold(0.0, f64::max),
            },
            sign: Sign::Known,
        });
    }
    let found = match windows.principal() {
        Some(up) if can_project => Vertical {
            direction: Direction::Projected(up),
            reason: Reason::Pulses,
            sign: Sign::Assumed,
        },
        Some(up) => along(largest(up), 1.0, Reason::Pulses, false),
        None => {
            let z = axes.iter().position(|(axis, _)| *axis == Some(2));
            along(z.unwrap_or(0), 1.0, Reason::Nothing, false)
        }
    };
    Ok(if is_reversed { found.turned() } else { found })
}

/// The acceleration along the vertical, row by row; NaN where an axis was not read.
pub(super) fn project(
    columns: &Columns,
    windows: &Windows,
    unit: Unit,
    vertical: &Vertical,
) -> Vec<f64> {
    let up = match vertical.direction {
        Direction::Along { place, sign, .. } => {
            let column = columns.axes[place].iter();
            return column
                .map(|reading| sign * unit.convert(*reading))
                .collect();
        }
        Direction::Projected(up) => up,
    };
    let path = match vertical.reason {
        Reason::Gravity { .. } => path(windows, up),
        _ => Vec::new(),
    };
    let [x, y, z] = &columns.axes[..] else {
        unreachable!("only three axes are projected");
    };
    let mut node = 0;
    let rows = columns.times.iter().zip(x).zip(y).zip(z);
    rows.map(|(((time, x), y), z)| {
        let up = if path.is_empty() {
            up
        } else {
            local(&path, &mut node, *time)
        };
        dot([*x, *y, *z].map(|reading| unit.convert(reading)), up)
    })
    .collect()
}

/// The local directions of gravity, at their times; empty if none differs from the median.
fn path(windows: &Windows, up: [f64; 3]) -> Vec<(f64, [f64; 3])> {
    let number = windows.means.len();
    let mut is_turned = false;
    let nodes = (0..number).step_by(STRIDE).map(|at| {
        let range = at.saturating_sub(NEIGHBOURS)..(at + NEIGHBOURS + 1).min(number);
        let median = windows.median(range);
        let here = unit(median).filter(|_| GRAVITATION.contains(&length(median)));
        let here = here.unwrap_or(up);
        let share = ((angle(here, up) - TURNED.0) / (TURNED.1 - TURNED.0)).clamp(0.0, 1.0);
        is_turned |= share > 0.0;
        let mixed = mix([(1.0 - share, up), (share, here)]);
        (windows.times[at], unit(mixed).unwrap_or(up))
    });
    let nodes: Vec<_> = nodes.collect();
    if is_turned { nodes } else { Vec::new() }
}

/// The direction at `time`, between those of the nodes around it; `node` moves on with time.
fn local(path: &[(f64, [f64; 3])], node: &mut usize, time: f64) -> [f64; 3] {
    while path.get(*node + 1).is_some_and(|(next, _)| *next <= time) {
        *node += 1;
    }
    let (start, from) = path[*node];
    let Some((end, to)) = path.get(*node + 1) else {
        return from;
    };
    let share = ((time - start) / (end - start)).clamp(0.0, 1.0);
    unit(mix([(1.0 - share, from), (share, *to)])).unwrap_or(from)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The vector of length 1 in this direction, if it has one.
fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = length(v);
    (length > 0.0 && length.is_finite()).then(|| v.map(|along| along / length))
}

/// Degrees between two vectors of length 1.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    libm::acos(dot(a, b).clamp(-1.0, 1.0)).to_degrees()
}

fn largest(v: [f64; 3]) -> usize {
    let axes = [0, 1, 2].into_iter();
    axes.max_by(|a, b| v[*a].abs().total_cmp(&v[*b].abs()))
        .unwrap_or(0)
}

/// The sum of vectors, each times its number.
fn mix<const N: usize>(parts: [(f64, [f64; 3]); N]) -> [f64; 3] {
    [0, 1, 2].map(|axis| parts.iter().map(|(share, v)| share * v[axis]).sum())
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let values = sorted(values);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
