//! The columns of a table: which are read, and in which units.

use super::axis::Axis;
use super::error::{Located, Names, RecordingProblem};
use super::head::{Head, no_stream};
use super::names::{self, Column, Gravity, Role};
use super::pressure;
use super::reading::Reading;
use super::unit::{TimeUnit, Unit};
use serde::{Deserialize, Serialize};

/// What a sensor measures.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Quantity {
    /// Along one axis or three.
    Acceleration,
    /// Of the air.
    Pressure,
}

/// Where a table comes from.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Input {
    /// A file, of which everything is known, and what is read of it.
    File(Quantity),
    /// A stream of one acceleration, each line with a last cell for the drum if there is one.
    Stream { has_drum: bool },
}

const STREAM_OF_AXES: &str = "a stream must have one acceleration, got several axes (choose one: --axis x, y or z, or \
    --acceleration COLUMN)";

/// The direction of gravity cannot be found.
pub(super) fn no_gravity(got: &str) -> RecordingProblem {
    let rule = "vertical along gravity: needs x, y and z in the same rows and a length of 8.5 to 11.5 m/s^2";
    RecordingProblem::must(rule, got, "--axis x, y or z")
}

/// The columns of time and acceleration, and their units.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Layout {
    /// The app that wrote it.
    #[serde(skip)]
    pub format: &'static str,
    pub columns: Vec<Column>,
    /// None if the rows have a rate instead.
    pub time: Option<usize>,
    /// Given, or in the file.
    pub time_unit: Option<TimeUnit>,
    /// One column, or those of several axes, which are 0, 1 and 2 for x, y and z.
    pub axes: Vec<(Option<usize>, usize)>,
    /// Whether the user named the column or the axis.
    pub is_given: bool,
    /// Given, or in the file.
    pub unit: Option<Unit>,
    /// Whether nameless columns were taken for time, x, y, z, or for time and a pressure.
    pub is_guessed: bool,
}

impl Layout {
    /// The layout of the columns, and the place of the first row among the lines of `head`.
    ///
    /// # Errors
    /// If a column cannot be found, with the line to blame.
    pub fn of(
        head: &mut Head,
        owner: &str,
        reading: &Reading,
        input: Input,
    ) -> Result<(Self, usize), Located> {
        let header = head.header(owner);
        let is_headed = header.is_some();
        let (mut columns, place) = header.unwrap_or_else(|| {
            let columns = numbered(head.width(), reading, input);
            (columns, head.lines.len() - 1)
        });
        let mut first = place;
        if is_headed {
            first = head.units(place, &mut columns);
            if input == (Input::Stream { has_drum: true }) {
                columns.pop();
            }
        }
        let layout = Self::choose(columns, is_headed, reading, input);
        let mut layout = layout.map_err(|problem| (Some(head.lines[place].number), problem))?;
        if head.lines[0].bytes.starts_with(b"\"TOA5\"") {
            layout.format = "TOA5";
        }
        Ok((layout, first))
    }

    fn choose(
        columns: Vec<Column>,
        is_headed: bool,
        reading: &Reading,
        input: Input,
    ) -> Result<Self, RecordingProblem> {
        reading.unit.check()?;
        let is_told = reading.time.is_some() && reading.acceleration.is_some();
        let has_roles = columns.iter().any(|column| column.role != Role::Other);
        let is_pressure = input == Input::File(Quantity::Pressure);
        if !is_headed && !has_roles && !is_told && !is_pressure {
            return Err(match input {
                Input::File(_) => RecordingProblem::Unnamed {
                    width: columns.len(),
                },
                Input::Stream { has_drum } => no_stream(has_drum),
            });
        }
        let time = match (reading.rate, input) {
            (Some(_), Input::File(_)) => None,
            (_, Input::Stream { .. }) if reading.time.is_none() => {
                time(&columns, reading, is_pressure).ok()
            }
            _ => Some(time(&columns, reading, is_pressure)?),
        };
        let axes = if is_pressure {
            vec![(None, pressure(&columns, reading, is_headed)?)]
        } else {
            accelerations(&columns, reading, time)?
        };
        if let (Input::Stream { .. }, true) = (input, axes.len() > 1) {
            return Err(RecordingProblem::Simple(STREAM_OF_AXES));
        }
        let clock = time.map(|time| &columns[time]);
        let first = axes[0].1;
        Ok(Self {
            format: names::format(&columns, clock),
            time,
            time_unit: reading
                .time_unit
                .or(clock.and_then(|clock| clock.time_unit)),
            is_given: reading.acceleration.is_some() || matches!(reading.axis, Axis::Along { .. }),
            unit: match reading.unit {
                Unit::Found => columns[first].unit,
                given => Some(given),
            },
            is_guessed: !is_headed && (axes.len() == 3 || is_pressure),
            axes,
            columns,
        })
    }

    /// The names of the columns that are read as accelerations.
    pub fn acceleration_names(&self) -> Vec<&str> {
        let names = self
            .axes
            .iter()
            .map(|(_, column)| &*self.columns[*column].name);
        names.collect()
    }

    /// Whether, by their names, the accelerations include gravity. Sensor Logger says so only in the name of the
    /// file.
    pub fn includes_gravity(&self, owner: &str) -> bool {
        let is_total = |(_, index): &(_, usize)| match self.columns[*index].role {
            Role::Along { gravity, .. } => gravity == Gravity::In,
            _ => false,
        };
        match self.format {
            "Sensor Logger" => owner.to_lowercase().contains("totalacceleration"),
            _ => self.axes.iter().all(is_total),
        }
    }
}

/// Columns without names: the acceleration, after the time unless there is a rate, or x, y and z. Others are
/// for the user to name.
fn numbered(width: usize, reading: &Reading, input: Input) -> Vec<Column> {
    let is_timed = match input {
        Input::File(_) => reading.rate.is_none(),
        Input::Stream { .. } => width > 1,
    };
    let width = match input {
        Input::Stream { has_drum: true } => width - 1,
        _ => width,
    };
    let is_timed = is_timed && width > 1;
    let axes = width - usize::from(is_timed);
    let role = |index: usize| match (axes, index) {
        (1 | 3, 0) if is_timed => Role::Time { rank: 0 },
        (1, _) => Role::Acceleration,
        (3, _) => Role::Along {
            axis: index - usize::from(is_timed),
            gravity: Gravity::In,
        },
        _ => Role::Other,
    };
    (0..width)
        .map(|index| Column::numbered(index + 1, role(index)))
        .collect()
}

fn all_names(columns: &[Column]) -> impl Iterator<Item = &str> {
    columns.iter().map(|column| &*column.name)
}

/// The column named by the user, in exact spelling or ignoring case.
fn named(columns: &[Column], what: &'static str, got: &str) -> Result<usize, RecordingProblem> {
    let wanted = got.trim();
    let exact = columns.iter().position(|column| column.name == wanted);
    let alike = |column: &Column| column.name.to_lowercase() == wanted.to_lowercase();
    exact
        .or_else(|| columns.iter().position(alike))
        .ok_or_else(|| RecordingProblem::unknown(what, got, all_names(columns)))
}

fn no_column(columns: &[Column], what: &'static str, remedy: &'static str) -> RecordingProblem {
    let names = Names::of(all_names(columns));
    RecordingProblem::Among {
        what,
        names,
        remedy,
    }
}

/// The column named by the user, or else the best clock.
fn time(
    columns: &[Column],
    reading: &Reading,
    is_pressure: bool,
) -> Result<usize, RecordingProblem> {
    if let Some(name) = &reading.time {
        return named(columns, "time column", name);
    }
    let clocks = columns
        .iter()
        .zip(0..)
        .filter_map(|(column, index)| match column.role {
            Role::Time { rank } => Some((rank, index)),
            _ => None,
        });
    let best = clocks.min().map(|(_, index)| index);
    let what = "no column looks like time, the columns are";
    let remedy = if is_pressure {
        "name it `time (s)` in the header"
    } else {
        "--time COLUMN, or --rate HZ where rows are evenly spaced"
    };
    best.ok_or_else(|| no_column(columns, what, remedy))
}

/// The column named by the user, or else the first that looks like a pressure, or else the only nameless one.
fn pressure(
    columns: &[Column],
    reading: &Reading,
    is_headed: bool,
) -> Result<usize, RecordingProblem> {
    if let Some(name) = &reading.acceleration {
        return named(columns, "column of the barometer", name);
    }
    let is_only = |of: &Column| !is_headed && of.role == Role::Acceleration;
    let found = pressure::columns(columns).first().copied();
    let found = found.or_else(|| columns.iter().position(is_only));
    let what = "no column looks like the pressure of the air, the columns are";
    let remedy = "name it `pressure (hPa)` in the header, or give --barometer-column COLUMN";
    found.ok_or_else(|| no_column(columns, what, remedy))
}

/// The column named by the user, or else the axes, or else the only one.
fn accelerations(
    columns: &[Column],
    reading: &Reading,
    time: Option<usize>,
) -> Result<Vec<(Option<usize>, usize)>, RecordingProblem> {
    if let Some(name) = &reading.acceleration {
        return Ok(vec![(None, named(columns, "acceleration column", name)?)]);
    }
    let axes: Vec<(Option<usize>, usize)> = (0..3)
        .filter_map(|axis| Some((Some(axis), along(columns, axis)?)))
        .collect();
    match reading.axis {
        Axis::Auto if axes.is_empty() => {
            let is_one = |(column, index): &(&Column, usize)| {
                column.role == Role::Acceleration && Some(*index) != time
            };
            let one = columns.iter().zip(0..).find(is_one);
            let what = "no column looks like an acceleration, the columns are";
            let none = || no_column(columns, what, "--acceleration COLUMN");
            one.map(|(_, index)| vec![(None, index)]).ok_or_else(none)
        }
        Axis::Gravity if axes.len() < 3 => Err(no_gravity("fewer than three axes")),
        Axis::Auto | Axis::Gravity => Ok(axes),
        Axis::Along { index, .. } => {
            let found = axes.into_iter().find(|(axis, _)| *axis == Some(index));
            found
                .map(|found| vec![found])
                .ok_or_else(|| RecordingProblem::NoAxis {
                    axis: reading.axis,
                    found: Names::of(all_names(columns)),
                })
        }
    }
}

/// The column along an axis, with gravity if there is a choice.
fn along(columns: &[Column], wanted: usize) -> Option<usize> {
    let found = columns
        .iter()
        .zip(0..)
        .filter_map(|(column, index)| match column.role {
            Role::Along { axis, gravity } if axis == wanted => Some((gravity, index)),
            _ => None,
        });
    found.min().map(|(_, index)| index)
}
