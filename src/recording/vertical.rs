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
use super::error::RecordingProblem;
use super::facts::coarse;
use super::layout::no_gravity;
use super::steps::{LOOKED_AT, Steps};
use super::table::Columns;
use super::unit::Unit;
use super::windows::{GRAVITATION, Windows};
use crate::vector::{Vector, angle, cross, dot, largest, length, mix, smallest, unit};
use std::fmt;

/// The vertical direction, and how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertical {
    /// The place of the only column that is read; none if all three are.
    pub column: Option<usize>,
    /// The direction among the columns, of length 1.
    pub up: [f64; 3],
    /// The nearest of x, y, z, by its number, if the columns are called so.
    axis: Option<usize>,
    /// How it was found.
    pub reason: Reason,
    /// Whether it is certain which way is up: by gravity, by a barometer, or as the user says. Else it is the positive side.
    pub is_sign_known: bool,
    is_by_barometer: bool,
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

impl Vertical {
    /// Whether it turns in the record, and is followed.
    pub fn is_followed(&self) -> bool {
        matches!(self.reason, Reason::Gravity { turned, .. } if turned >= TURNED.1)
    }

    /// The opposite direction, wanted by the user.
    pub(super) fn inverted(self) -> Self {
        Self {
            is_sign_known: true,
            ..self.turned()
        }
    }

    /// As a barometer says, which may be the opposite.
    pub(super) fn by_barometer(self, is_upside_down: bool) -> Self {
        Self {
            is_sign_known: true,
            is_by_barometer: true,
            ..if is_upside_down { self.turned() } else { self }
        }
    }

    fn turned(self) -> Self {
        let up = self.up.map(|along| -along);
        Self { up, ..self }
    }
}

impl fmt::Display for Vertical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.axis.map_or("that column", |axis| AXES[axis]);
        let minus = if self.up[largest(self.up)] < 0.0 {
            "-"
        } else {
            ""
        };
        let is_projected = self.column.is_none();
        if is_projected {
            // Never "-0.00".
            let [x, y, z] = self.up.map(|along| (100.0 * along).round() / 100.0 + 0.0);
            write!(f, "projected on ({x:.2}, {y:.2}, {z:.2})")?;
        } else {
            write!(f, "{minus}{name}")?;
        }
        match self.reason {
            Reason::Given => f.write_str(" (as given)")?,
            Reason::Only => f.write_str(" (the only one)")?,
            Reason::Gravity { turned, .. } if is_projected => {
                f.write_str(", the direction of gravity")?;
                if turned >= TURNED.1 {
                    write!(f, ", which turns by {turned:.0} degrees and is followed")?;
                }
            }
            Reason::Gravity { from, .. } => write!(f, ", {from:.0} degrees from gravity")?,
            Reason::Pulses => f.write_str(", the direction of the pulses")?,
            Reason::Nothing => f.write_str("; no axis carries a ride (--axis x, y or z)")?,
        }
        let plus = if minus.is_empty() { "+" } else { minus };
        match self.axis {
            _ if self.is_by_barometer => f.write_str("; up as the barometer says"),
            _ if self.is_sign_known => Ok(()),
            Some(_) => write!(f, "; up assumed along {plus}{name} (--invert)"),
            None => f.write_str("; up assumed to be positive (--invert)"),
        }
    }
}

/// An axis with more than this of the vertical in it is no direction across it.
const STEEP: f64 = 0.9;

/// Windows on each side in the neighbourhood of one: 20 s in all.
const NEIGHBOURS: usize = 20;

/// Windows from one local direction to the next.
const STRIDE: usize = 4;

/// Where the local direction differs from the median by more than the second angle, degrees, it is followed, by
/// less than the first it is not; between them in part. People shake a lift by less than a degree.
const TURNED: (f64, f64) = (3.0, 6.0);

/// Finds the vertical. `is_reversed`: up reads negative, which shows only in a record without gravity.
///
/// # Errors
/// If gravity is wanted and not there.
pub(super) fn find(
    columns: &Columns,
    windows: &Windows,
    axis: Axis,
    is_reversed: bool,
) -> Result<Vertical, RecordingProblem> {
    let (axes, is_given) = (&columns.parser.layout.axes, columns.parser.layout.is_given);
    let (is_one, has_gravity) = (axes.len() == 1, windows.has_gravity());
    let can_project = axes.len() == 3 && windows.together >= 0.9;
    if axis == Axis::Gravity && !is_one && !(has_gravity && can_project) {
        return Err(no_gravity(if has_gravity {
            "them in different rows"
        } else {
            "another length"
        }));
    }
    let median = windows.median(0..windows.means.len());
    let along = |place: usize, sign: f64| {
        let mut up = [0.0; 3];
        up[place] = sign;
        up
    };
    let (mut up, reason) = if is_one {
        let is_down = match axis {
            Axis::Along { is_down: true, .. } if is_given => true,
            // Gravity shows which way is up.
            _ => has_gravity && median[0] < 0.0,
        };
        let reason = if is_given {
            Reason::Given
        } else {
            Reason::Only
        };
        (along(0, if is_down { -1.0 } else { 1.0 }), reason)
    } else if has_gravity {
        let up = unit(median).unwrap_or(along(0, 1.0));
        let from = libm::acos(up[largest(up)].abs().min(1.0)).to_degrees();
        let path = path(windows, up).into_iter().filter(|_| can_project);
        let turned = path.map(|(_, local)| angle(local, up)).fold(0.0, f64::max);
        (up, Reason::Gravity { from, turned })
    } else if let Some(up) = windows.principal() {
        (up, Reason::Pulses)
    } else {
        let z = axes.iter().position(|(axis, _)| *axis == Some(2));
        (along(z.unwrap_or(0), 1.0), Reason::Nothing)
    };
    let nearest = largest(up);
    let is_along = !can_project || reason == Reason::Nothing;
    if is_along {
        up = along(nearest, up[nearest].signum());
    }
    let found = Vertical {
        column: is_along.then_some(nearest),
        up,
        axis: axes[nearest].0,
        reason,
        is_sign_known: has_gravity || is_given,
        is_by_barometer: false,
    };
    let is_turned = is_reversed && !is_one && !has_gravity;
    Ok(if is_turned { found.turned() } else { found })
}

/// The acceleration along the vertical, row by row; NaN where an axis was not read.
pub(super) fn project(
    columns: &Columns,
    windows: &Windows,
    unit: Unit,
    vertical: &Vertical,
) -> Vec<f64> {
    match vertical.column {
        Some(place) => alone(&columns.axes[place], vertical.up[place], unit),
        None => along(columns, windows, unit, vertical, |up| up),
    }
}

/// The accelerations across it in two directions, row by row; none if three axes were not read. Where one column is the
/// vertical they are the two others; else the first is as near as can be to the axis that is least vertical.
pub(super) fn project_across(
    columns: &Columns,
    windows: &Windows,
    unit: Unit,
    vertical: &Vertical,
) -> Option<[Vec<f64>; 2]> {
    if columns.axes.len() != 3 {
        return None;
    }
    if let Some(place) = vertical.column {
        let others = [(place + 1) % 3, (place + 2) % 3];
        return Some(others.map(|place| alone(&columns.axes[place], 1.0, unit)));
    }
    let level = smallest(vertical.up);
    let first = move |up: Vector| {
        // It may be turned until it is.
        let level = if up[level].abs() < STEEP {
            level
        } else {
            smallest(up)
        };
        let mut axis = [0.0; 3];
        axis[level] = 1.0;
        let across = mix([(1.0, axis), (-up[level], up)]);
        across.map(|along| along / length(across))
    };
    let second = move |up: Vector| cross(up, first(up));
    Some([
        along(columns, windows, unit, vertical, first),
        along(columns, windows, unit, vertical, second),
    ])
}

fn alone(axis: &[f64], sign: f64, unit: Unit) -> Vec<f64> {
    let readings = axis.iter();
    readings
        .map(|reading| sign * unit.convert(*reading))
        .collect()
}

/// The acceleration along a direction that follows from what is up, row by row.
fn along(
    columns: &Columns,
    windows: &Windows,
    unit: Unit,
    vertical: &Vertical,
    direction: impl Fn(Vector) -> Vector,
) -> Vec<f64> {
    let path = match vertical.reason {
        Reason::Gravity { .. } => path(windows, vertical.up),
        _ => Vec::new(),
    };
    let mut node = 0;
    let rows = columns.times.iter().enumerate();
    rows.map(|(row, time)| {
        let up = local(&path, &mut node, *time).unwrap_or(vertical.up);
        let reading = [0, 1, 2].map(|axis| unit.convert(columns.axes[axis][row]));
        dot(reading, direction(up))
    })
    .collect()
}

/// The step along the vertical, m/s², of three axes of which some are coarse: what each adds is known to its own step.
pub(super) fn coarse_step(columns: &Columns, unit: Unit, vertical: &Vertical) -> Option<f64> {
    if vertical.column.is_some() {
        return None;
    }
    let squares = columns
        .axes
        .iter()
        .zip(vertical.up)
        .filter_map(|(axis, up)| {
            let repeats = axis.windows(2).filter(|pair| pair[0] == pair[1]).count();
            let first = axis.iter().filter(|reading| !reading.is_nan());
            let first = first.take(LOOKED_AT).map(|reading| unit.convert(*reading));
            let step = Steps::of(first.collect()).quantum;
            let step = coarse(step, repeats as f64 / axis.len() as f64)?;
            Some((step * up).powi(2))
        });
    let variance: f64 = squares.sum();
    (variance > 0.0).then(|| variance.sqrt())
}

/// The local directions of gravity, at their times; empty if none differs from the median.
fn path(windows: &Windows, up: Vector) -> Vec<(f64, Vector)> {
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
fn local(path: &[(f64, Vector)], node: &mut usize, time: f64) -> Option<Vector> {
    while path.get(*node + 1).is_some_and(|(next, _)| *next <= time) {
        *node += 1;
    }
    let (start, from) = *path.get(*node)?;
    let Some((end, to)) = path.get(*node + 1) else {
        return Some(from);
    };
    let share = ((time - start) / (end - start)).clamp(0.0, 1.0);
    Some(unit(mix([(1.0 - share, from), (share, *to)])).unwrap_or(from))
}
