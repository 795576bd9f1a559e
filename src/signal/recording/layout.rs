//! The layout of a table, found from its first line.

use super::cell::{Cell, DecimalMark};
use super::choice::{Accelerations, accelerations, time};
use super::column::{Column, Gravity, Role};
use super::delimiter::{Delimiter, Splitter};
use super::error::{RecordingError, RecordingProblem};
use super::lines::{Lines, NoLine};
use super::reading::{Reading, TimeUnit, Unit};
use super::source::Source;
use std::fmt;

/// The app that wrote a table.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Format {
    /// phyphox: names with units in brackets.
    Phyphox,
    /// Science Journal: `relative_time` in ms, a row for every sensor's reading.
    ScienceJournal,
    /// Sensor Logger: `seconds_elapsed` beside `time` in ns.
    SensorLogger,
    /// None of these.
    Plain,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Phyphox => "phyphox",
            Self::ScienceJournal => "Science Journal",
            Self::SensorLogger => "Sensor Logger",
            Self::Plain => "plain",
        })
    }
}

/// The columns of time and acceleration, and their units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub format: Format,
    pub delimiter: Delimiter,
    /// The number of lines before the first row.
    pub preamble: u64,
    pub is_headed: bool,
    pub columns: Vec<Column>,
    pub time: usize,
    pub time_unit: TimeUnit,
    /// Whether the file or the reader says so.
    pub is_time_unit_stated: bool,
    pub acceleration: Accelerations,
    pub unit: Unit,
    /// Whether the file or the reader says so.
    pub is_unit_stated: bool,
}

impl Layout {
    /// Reads the first line.
    ///
    /// # Errors
    /// If there is no line, or a column cannot be found.
    pub fn find(source: &Source, reading: &Reading) -> Result<Self, RecordingError> {
        let mut lines = Lines::new(source.text()?);
        let first = first(&mut lines).map_err(|problem| {
            let line = (lines.number() > 0).then(|| lines.number());
            source.error(
                line.filter(|_| !matches!(problem, RecordingProblem::Empty)),
                problem,
            )
        })?;
        let number = lines.number();
        Self::of(&first, number, source.name(), reading)
            .map_err(|problem| source.error(Some(number), problem))
    }

    fn of(
        first: &[u8],
        number: u64,
        owner: &str,
        reading: &Reading,
    ) -> Result<Self, RecordingProblem> {
        reading.unit.check()?;
        let delimiter = Delimiter::of(first);
        let mut splitter = Splitter::new(delimiter);
        splitter.split(first);
        let is_headed = !is_row(&splitter, delimiter);
        let columns = if is_headed {
            headed(&splitter, owner)
        } else {
            numbered(splitter.cells().count())
        };
        let is_told = reading.time.is_some() && reading.acceleration.is_some();
        if let (false, false, width @ 3..) = (is_headed, is_told, columns.len()) {
            return Err(RecordingProblem::Unnamed { width });
        }
        let time = time(&columns, reading)?;
        let acceleration = accelerations(&columns, reading, time)?;
        let format = format(&columns, time);
        let found_time_unit = columns[time]
            .time_unit
            .or(clock_unit(format, &columns[time]));
        let time_unit = reading.time_unit.or(found_time_unit);
        let found_unit = columns[acceleration.columns()[0]].unit;
        let unit = match reading.unit {
            Unit::Found => found_unit,
            given => Some(given),
        };
        Ok(Self {
            format,
            delimiter,
            preamble: number - u64::from(!is_headed),
            is_headed,
            columns,
            time,
            time_unit: time_unit.unwrap_or(TimeUnit::Seconds),
            is_time_unit_stated: time_unit.is_some(),
            acceleration,
            unit: unit.unwrap_or(Unit::MetresPerSecondSquared),
            is_unit_stated: unit.is_some(),
        })
    }

    /// Whether, by their names, the accelerations include gravity. Sensor Logger says so only in the name of the
    /// file.
    pub fn includes_gravity(&self, owner: &str) -> bool {
        let is_total = |index: &usize| match self.columns[*index].role {
            Role::Along { gravity, .. } => gravity == Gravity::In,
            _ => false,
        };
        match self.format {
            Format::SensorLogger => owner.to_lowercase().contains("totalacceleration"),
            _ => self.acceleration.columns().iter().all(is_total),
        }
    }
}

/// The first line with content, after blank lines, comments, and a line that gives spreadsheets the separator.
fn first<R: std::io::BufRead>(lines: &mut Lines<R>) -> Result<Vec<u8>, RecordingProblem> {
    loop {
        let line = match lines.next() {
            Ok(Some(line)) => line.bytes,
            Ok(None) => return Err(RecordingProblem::Empty),
            Err(NoLine::TooLong) => return Err(RecordingProblem::TooLong),
            Err(NoLine::Io(error)) => return Err(RecordingProblem::Unreadable(error)),
        };
        if line.iter().any(|&c| c.is_ascii_control() && c != b'\t') {
            return Err(RecordingProblem::Binary);
        }
        if !is_remark(line) && !line.starts_with(b"sep=") {
            return Ok(line.to_vec());
        }
    }
}

/// Whether a line is blank or a comment.
pub(super) fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    matches!(line.first(), None | Some(b'#' | b'%'))
}

/// Whether the first line is a row of numbers, not a header.
fn is_row(splitter: &Splitter, delimiter: Delimiter) -> bool {
    let mut mark = match delimiter {
        Delimiter::Comma => DecimalMark::Point,
        _ => DecimalMark::Unknown,
    };
    let cells: Vec<Cell> = splitter.cells().map(|cell| mark.read(cell)).collect();
    let is_number = |cell: &Cell| matches!(cell, Cell::Number(_) | Cell::NotFinite);
    cells.iter().any(is_number) && !cells.contains(&Cell::Text)
}

fn headed(splitter: &Splitter, owner: &str) -> Vec<Column> {
    let names: Vec<String> = splitter
        .cells()
        .map(|cell| String::from_utf8_lossy(cell).into_owned())
        .collect();
    let used = names.iter().rposition(|name| !name.trim().is_empty());
    names[..used.map_or(0, |last| last + 1)]
        .iter()
        .map(|name| Column::new(name, owner))
        .collect()
}

/// Columns without names: of two, the first is time and the second the acceleration.
fn numbered(width: usize) -> Vec<Column> {
    let role = |index| match (width, index) {
        (2, 0) => Role::Time { rank: 0 },
        (2, _) => Role::Acceleration,
        _ => Role::Other,
    };
    (0..width)
        .map(|index| Column {
            name: (index + 1).to_string(),
            role: role(index),
            time_unit: None,
            unit: None,
        })
        .collect()
}

fn format(columns: &[Column], time: usize) -> Format {
    let has = |name: &str| {
        columns
            .iter()
            .any(|column| column.name.eq_ignore_ascii_case(name))
    };
    let has_units = |column: &Column| column.unit.is_some() && column.name.ends_with(')');
    let clock = &columns[time];
    match () {
        () if has("seconds_elapsed") => Format::SensorLogger,
        () if has("relative_time") || (has("timestamp") && has("AccX")) => Format::ScienceJournal,
        () if clock.time_unit.is_some()
            && clock.name.ends_with(')')
            && columns.iter().any(has_units) =>
        {
            Format::Phyphox
        }
        () => Format::Plain,
    }
}

/// The unit of the app's clock, if the name does not state it.
fn clock_unit(format: Format, clock: &Column) -> Option<TimeUnit> {
    match (format, clock.name.to_lowercase().as_str()) {
        (Format::ScienceJournal, "relative_time" | "timestamp") => Some(TimeUnit::Milliseconds),
        (Format::SensorLogger, "seconds_elapsed") => Some(TimeUnit::Seconds),
        (Format::SensorLogger, "time") => Some(TimeUnit::Nanoseconds),
        _ => None,
    }
}
