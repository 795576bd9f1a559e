//! The choice of the columns to read.

use super::axis::Axis;
use super::column::{Column, Role};
use super::error::{Names, RecordingProblem, nearest};
use super::reading::Reading;

/// The columns that may hold the vertical acceleration.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Accelerations {
    /// Named by the user.
    Named(usize),
    /// The only one.
    Only(usize),
    /// Several axes with their columns.
    Axes(Vec<(Axis, usize)>),
}

impl Accelerations {
    /// The indices of the columns.
    pub fn columns(&self) -> Vec<usize> {
        match self {
            Self::Named(column) | Self::Only(column) => vec![*column],
            Self::Axes(axes) => axes.iter().map(|(_, column)| *column).collect(),
        }
    }
}

fn names(columns: &[Column]) -> Names {
    Names(columns.iter().map(|column| column.name.clone()).collect())
}

/// The column named by the user, in exact spelling or ignoring case.
fn named(columns: &[Column], role: &'static str, got: &str) -> Result<usize, RecordingProblem> {
    let wanted = got.trim();
    let exact = columns.iter().position(|column| column.name == wanted);
    let alike = |column: &Column| column.name.to_lowercase() == wanted.to_lowercase();
    exact
        .or_else(|| columns.iter().position(alike))
        .ok_or_else(|| RecordingProblem::UnknownColumn {
            role,
            got: got.to_owned(),
            hint: nearest(wanted, &names(columns).0),
            found: names(columns),
        })
}

/// The column named by the user, or else the best clock.
pub(super) fn time(columns: &[Column], reading: &Reading) -> Result<usize, RecordingProblem> {
    if let Some(name) = &reading.time {
        return named(columns, "time", name);
    }
    let clocks = columns.iter().enumerate().filter_map(|(index, column)| {
        let Role::Time { rank } = column.role else {
            return None;
        };
        Some((rank, index))
    });
    let best = clocks.min().map(|(_, index)| index);
    best.ok_or_else(|| RecordingProblem::NoTime(names(columns)))
}

/// The column named by the user, or else the axes, or else the only one.
pub(super) fn accelerations(
    columns: &[Column],
    reading: &Reading,
    time: usize,
) -> Result<Accelerations, RecordingProblem> {
    if let Some(name) = &reading.acceleration {
        return Ok(Accelerations::Named(named(columns, "acceleration", name)?));
    }
    let axes: Vec<(Axis, usize)> = Axis::ALL
        .into_iter()
        .filter_map(|axis| Some((axis, along(columns, axis)?)))
        .collect();
    let only = |index: &usize| *index != time && columns[*index].role == Role::Acceleration;
    match reading.axis {
        Axis::Auto if axes.is_empty() => (0..columns.len())
            .find(only)
            .map(Accelerations::Only)
            .ok_or_else(|| RecordingProblem::NoAcceleration(names(columns))),
        Axis::Auto => Ok(Accelerations::Axes(axes)),
        Axis::Gravity if axes.len() == 3 => Ok(Accelerations::Axes(axes)),
        Axis::Gravity => Err(RecordingProblem::NoGravity("fewer than three axes")),
        axis => axes
            .into_iter()
            .find(|(found, _)| *found == axis)
            .map(|found| Accelerations::Axes(vec![found]))
            .ok_or_else(|| RecordingProblem::NoAxis {
                axis,
                found: names(columns),
            }),
    }
}

/// The column along `axis`, with gravity if there is a choice.
fn along(columns: &[Column], axis: Axis) -> Option<usize> {
    let found = columns
        .iter()
        .enumerate()
        .filter_map(|(index, column)| match column.role {
            Role::Along {
                axis: found,
                gravity,
            } if found == axis => Some((gravity, index)),
            _ => None,
        });
    found.min().map(|(_, index)| index)
}
