//! The columns of a table: which are read, and in which units.

use super::axis::Axis;
use super::error::{Names, RecordingProblem};
use super::head::Head;
use super::names::{Column, Gravity, Role};
use super::reading::Reading;
use super::unit::{TimeUnit, Unit};
use crate::suggest::nearest;
use std::fmt;

/// The app or the logger that wrote a table.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub enum Format {
    Phyphox,
    ScienceJournal,
    SensorLogger,
    PhysicsToolbox,
    Xsens,
    Campbell,
    Plain,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Phyphox => "phyphox",
            Self::ScienceJournal => "Science Journal",
            Self::SensorLogger => "Sensor Logger",
            Self::PhysicsToolbox => "Physics Toolbox",
            Self::Xsens => "Xsens DOT",
            Self::Campbell => "TOA5",
            Self::Plain => "plain",
        })
    }
}

/// Where a table comes from.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Input {
    /// A file, of which everything is known.
    File,
    /// A stream of one acceleration, each line with a last cell for the drum if there is one.
    Stream { has_drum: bool },
}

/// The columns of time and acceleration, and their units.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub format: Format,
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
    /// Whether nameless columns were taken for time, x, y, z.
    pub is_guessed: bool,
}

impl Layout {
    /// # Errors
    /// If a column cannot be found, with the line to blame.
    pub fn of(
        head: &Head,
        owner: &str,
        reading: &Reading,
        input: Input,
    ) -> Result<(Self, usize), (Option<u64>, RecordingProblem)> {
        let last = head.lines.len() - usize::from(head.width.is_some());
        let Some((mut columns, place)) = head.header(owner) else {
            let columns = numbered(head.width.unwrap_or(0), reading, input);
            let layout = Self::choose(columns, false, reading, input);
            let line = Some(head.lines[last].number);
            return layout
                .map(|layout| (layout, last))
                .map_err(|problem| (line, problem));
        };
        // Units and the like stand below the names; a line with a number is a row.
        let below = (place + 1..last).find(|&at| head.has_number(&head.lines[at]));
        let first = below.unwrap_or(last);
        head.units(place + 1..first, &mut columns);
        if let Input::Stream { has_drum: true } = input {
            columns.pop();
        }
        let mut layout = Self::choose(columns, true, reading, input)
            .map_err(|problem| (Some(head.lines[place].number), problem))?;
        if head.lines[0].bytes.starts_with(b"\"TOA5\"") {
            layout.format = Format::Campbell;
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
        if !is_headed && !has_roles && !is_told {
            return Err(match input {
                Input::File => RecordingProblem::Unnamed {
                    width: columns.len(),
                },
                Input::Stream { has_drum } => RecordingProblem::Stream { has_drum },
            });
        }
        let time = match (reading.rate, input) {
            (Some(_), Input::File) => None,
            (_, Input::Stream { .. }) if reading.time.is_none() => time(&columns, reading).ok(),
            _ => Some(time(&columns, reading)?),
        };
        let axes = accelerations(&columns, reading, time)?;
        if let (Input::Stream { .. }, true) = (input, axes.len() > 1) {
            return Err(RecordingProblem::StreamOfAxes);
        }
        let clock = time.map(|time| &columns[time]);
        let first = axes[0].1;
        Ok(Self {
            format: format(&columns, clock),
            time,
            time_unit: reading
                .time_unit
                .or(clock.and_then(|clock| clock.time_unit)),
            is_given: reading.acceleration.is_some() || matches!(reading.axis, Axis::Along { .. }),
            unit: match reading.unit {
                Unit::Found => columns[first].unit,
                given => Some(given),
            },
            is_guessed: !is_headed && axes.len() == 3,
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
            Format::SensorLogger => owner.to_lowercase().contains("totalacceleration"),
            _ => self.axes.iter().all(is_total),
        }
    }
}

/// Columns without names: the acceleration, after the time unless there is a rate, or x, y and z. Others are
/// for the user to name.
fn numbered(width: usize, reading: &Reading, input: Input) -> Vec<Column> {
    let is_timed = match input {
        Input::File => reading.rate.is_none(),
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
            hint: nearest(wanted, columns.iter().map(|column| &*column.name)).map(str::to_owned),
            found: names(columns),
        })
}

/// The column named by the user, or else the best clock.
fn time(columns: &[Column], reading: &Reading) -> Result<usize, RecordingProblem> {
    if let Some(name) = &reading.time {
        return named(columns, "time", name);
    }
    let clocks = columns
        .iter()
        .zip(0..)
        .filter_map(|(column, index)| match column.role {
            Role::Time { rank } => Some((rank, index)),
            _ => None,
        });
    let best = clocks.min().map(|(_, index)| index);
    best.ok_or_else(|| RecordingProblem::NoTime(names(columns)))
}

/// The column named by the user, or else the axes, or else the only one.
fn accelerations(
    columns: &[Column],
    reading: &Reading,
    time: Option<usize>,
) -> Result<Vec<(Option<usize>, usize)>, RecordingProblem> {
    if let Some(name) = &reading.acceleration {
        return Ok(vec![(None, named(columns, "acceleration", name)?)]);
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
            let none = || RecordingProblem::NoAcceleration(names(columns));
            one.map(|(_, index)| vec![(None, index)]).ok_or_else(none)
        }
        Axis::Gravity if axes.len() < 3 => {
            Err(RecordingProblem::NoGravity("fewer than three axes"))
        }
        Axis::Auto | Axis::Gravity => Ok(axes),
        Axis::Along { index, .. } => {
            let found = axes.into_iter().find(|(axis, _)| *axis == Some(index));
            found
                .map(|found| vec![found])
                .ok_or_else(|| RecordingProblem::NoAxis {
                    axis: reading.axis,
                    found: names(columns),
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

fn format(columns: &[Column], clock: Option<&Column>) -> Format {
    let is = |column: &Column, name: &str| column.name.eq_ignore_ascii_case(name);
    let has = |name: &str| columns.iter().any(|column| is(column, name));
    let in_brackets = |column: &Column| column.name.ends_with(')');
    let has_units = |column: &Column| column.unit.is_some() && in_brackets(column);
    let is_phyphox = clock.is_some_and(|clock| clock.time_unit.is_some() && in_brackets(clock))
        && columns.iter().any(has_units);
    match () {
        () if has("seconds_elapsed") => Format::SensorLogger,
        () if has("relative_time") || (has("timestamp") && has("AccX")) => Format::ScienceJournal,
        () if has("gFx") => Format::PhysicsToolbox,
        () if has("SampleTimeFine") => Format::Xsens,
        () if is_phyphox && !has("address") => Format::Phyphox,
        () => Format::Plain,
    }
}
