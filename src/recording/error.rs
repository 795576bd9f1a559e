//! Errors of recordings: the file, the line, the rule, the value and the remedy.

use super::axis::Axis;
use super::lines::{LONGEST_LINE, NoLine};
use super::unit::{TimeUnit, UnitError};
use crate::suggest::nearest;
use std::fmt;
use std::io;

/// Why a recording was refused, and where.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct RecordingError(Box<Report>);

#[derive(Debug)]
struct Report {
    file: String,
    line: Option<u64>,
    problem: RecordingProblem,
}

impl RecordingError {
    pub(super) fn new(file: &str, line: Option<u64>, problem: RecordingProblem) -> Self {
        Self(Box::new(Report {
            file: file.to_owned(),
            line,
            problem,
        }))
    }

    /// The line at fault, from 1.
    pub fn line(&self) -> Option<u64> {
        self.0.line
    }

    /// The problem.
    pub fn problem(&self) -> &RecordingProblem {
        &self.0.problem
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.problem),
            None => write!(f, "{}: {}", self.file, self.problem),
        }
    }
}

/// Why a recording was refused.
#[derive(Debug, thiserror::Error)]
pub enum RecordingProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0} (check the path and the file)")]
    Unreadable(#[source] io::Error),
    /// Not a file, which could be read twice.
    #[error("must be a file, got {0} (a stream of readings is for the monitor)")]
    NotAFile(&'static str),
    /// A member asked for in a file that has none.
    #[error("is one table, so it has no member \"{0}\" (leave out --member)")]
    NotAnArchive(String),
    /// Too large to be held.
    #[error(
        "would take {gigabytes:.1} GB of memory, at most 2 are taken (read a part of it with --from and --to in \
         s, or send its rows to `liftsim monitor`)"
    )]
    TooLarge {
        /// Estimated from the size of the file, or read so far.
        gigabytes: f64,
    },
    /// A workbook that cannot be read.
    #[error("workbook: {0} (export as CSV)")]
    Workbook(String),
    /// JSON that cannot be read.
    #[error("JSON: {0} (export as CSV)")]
    Json(String),
    /// JSON of several sensors, none of them an accelerometer.
    #[error("JSON: no sensor is an accelerometer, there are {0} (--member NAME)")]
    NoSensor(Names),
    /// A table of words.
    #[error("no row of numbers in the first 200 lines (export a table of numbers)")]
    NoRows,
    /// A stream whose lines are not understood.
    #[error("must be {}", stream(*.has_drum))]
    Stream {
        /// Whether lines end with the drum.
        has_drum: bool,
    },
    /// A stream of several axes.
    #[error(
        "a stream must have one acceleration, got several axes (choose one: --axis x, y or z, or \
         --acceleration COLUMN)"
    )]
    StreamOfAxes,
    /// A cell for the drum.
    #[error("must end with a cell for the drum, 0 or 1, got \"{0}\" (leave out --expected-moving)")]
    Drum(String),
    /// No readings in the wanted part.
    #[error(
        "must have at least 2 readings from {from} to {to} s, got {got} (times go from {first} to {last} s: change \
         --from or --to)"
    )]
    NothingLeft {
        /// s
        from: f64,
        /// s
        to: f64,
        /// Their number.
        got: u64,
        /// s
        first: f64,
        /// s
        last: f64,
    },
    /// Counts of an unknown converter.
    #[error(
        "no unit is named, and the mean is {mean:.1}, that of gravity 9.8 m/s^2 (if gravity is in it: \
         --unit counts --scale {scale:.4e}; else give --scale and --offset)"
    )]
    UnknownCounts {
        /// As read.
        mean: f64,
        /// m/s² a count.
        scale: f64,
    },
    /// A rate of rows out of range.
    #[error("rate must lie in [0.001, 1e7] Hz, got {0} (--rate HZ)")]
    RowRate(f64),
    /// A file named like an archive that is not one.
    #[error("ends in .zip, but is not a zip archive (download it again)")]
    NotAZip,
    /// A damaged or unsupported archive.
    #[error("zip archive: {0} (export it anew)")]
    Archive(#[from] zip::result::ZipError),
    /// An encrypted member, or one with an unsupported compression.
    #[error("zip archive: {0} is encrypted, or packed by another method than deflate (unpack it)")]
    Packing(String),
    /// An unknown member.
    #[error("zip archive: no member \"{got}\"{} (it holds {found})", did_you_mean(.hint))]
    UnknownMember {
        /// The one asked for.
        got: String,
        /// The most similar one.
        hint: Option<String>,
        /// The known ones.
        found: Names,
    },
    /// An archive without a table of accelerations.
    #[error("zip archive: no member is a table of accelerations, it holds {0} (export as CSV)")]
    NoTable(Names),
    /// An archive with several tables of accelerations.
    #[error("zip archive: {0} are tables of accelerations (--member NAME)")]
    SeveralTables(Names),
    /// An empty file.
    #[error("is empty (export it again)")]
    Empty,
    /// A header without readings.
    #[error("has a header and no readings (export it again)")]
    HeaderOnly,
    /// Too few readings at different times.
    #[error("must have at least 2 readings of the acceleration at different times, got {0}")]
    TooFew(u64),
    /// All readings are equal.
    #[error("every reading of the acceleration is {0} (choose another column with --acceleration)")]
    AllEqual(f64),
    /// A binary file.
    #[error("holds bytes that are not text (export as CSV)")]
    Binary,
    /// A line that is too long.
    #[error("must be at most {LONGEST_LINE} bytes long (write one row of numbers a line)")]
    TooLong,
    /// An unknown column.
    #[error("no column \"{got}\" for the {role}{} (the columns are {found})", did_you_mean(.hint))]
    UnknownColumn {
        /// Time or acceleration.
        role: &'static str,
        /// The one asked for.
        got: String,
        /// The most similar one.
        hint: Option<String>,
        /// The known ones.
        found: Names,
    },
    /// A table without a header and with more than two columns.
    #[error(
        "a table of {width} columns must have a header (or give the numbers of two of them: \
         --time 1 --acceleration {})",
        .width.min(&4)
    )]
    Unnamed {
        /// The number of columns.
        width: usize,
    },
    /// No column looks like time.
    #[error(
        "no column looks like time, the columns are {0} (--time COLUMN, or --rate HZ where rows are evenly spaced)"
    )]
    NoTime(Names),
    /// No column looks like an acceleration.
    #[error("no column looks like an acceleration, the columns are {0} (--acceleration COLUMN)")]
    NoAcceleration(Names),
    /// A table without the axis asked for.
    #[error(
        "no column looks like the acceleration along {axis}, the columns are {found} \
         (--acceleration COLUMN)"
    )]
    NoAxis {
        /// The one asked for.
        axis: Axis,
        /// The known ones.
        found: Names,
    },
    /// The direction of gravity cannot be found.
    #[error(
        "vertical along gravity: needs x, y and z in the same rows and a length of 8.5 to 11.5 m/s^2, \
         got {0} (--axis x, y or z)"
    )]
    NoGravity(&'static str),
    /// A cell that is not a number, or none that a lift gives.
    #[error("column \"{column}\": must {rule}, got {got} ({remedy})")]
    Cell {
        /// The name of the column.
        column: String,
        /// What it must do.
        rule: &'static str,
        /// The text, shortened and quoted, or the value.
        got: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A row with a different number of cells.
    #[error("must have {expected} cells as the first row has, got {got}{}", .hint.unwrap_or_default())]
    Cells {
        /// Cells in the first row.
        expected: usize,
        /// Cells in this row.
        got: usize,
        /// A possible reason, in brackets after a space.
        hint: Option<&'static str>,
    },
    /// A row with another separator.
    #[error(
        "cells are parted by {expected} in the first row, here by {got} (write one of them throughout)"
    )]
    MixedSeparators {
        /// The separator in the first row.
        expected: &'static str,
        /// The separator in this row.
        got: &'static str,
    },
    /// A time before that of the last reading.
    #[error("time must increase, got {to} s after {from} s (sort the rows, or split the file)")]
    TimeBack {
        /// The time before, s.
        from: f64,
        /// The time in this row, s.
        to: f64,
    },
    /// An impossible rate of the clock.
    #[error(
        "column \"{column}\": counted in {unit} it gives {rate} readings a second (--time-unit {})",
        .likely.map_or("s, ms, us or ns".to_owned(), |unit| unit.to_string())
    )]
    Rate {
        /// The name of the column.
        column: String,
        /// The stated unit, or seconds.
        unit: TimeUnit,
        /// Hz.
        rate: f64,
        /// The unit in which it would be a sensor's clock.
        likely: Option<TimeUnit>,
    },
    /// A unit that cannot be used.
    #[error("{0}")]
    Unit(#[from] UnitError),
    /// A rate of resampling out of range.
    #[error("resample must lie in (0, {limit}] Hz, ten times what was recorded, got {got}")]
    Resample {
        /// The rate asked for.
        got: f64,
        /// The highest rate allowed.
        limit: f64,
    },
}

impl RecordingProblem {
    pub(super) fn unknown_member(got: &str, found: Vec<String>) -> Self {
        Self::UnknownMember {
            got: got.to_owned(),
            hint: nearest(got, found.iter().map(String::as_str)).map(str::to_owned),
            found: Names(found),
        }
    }
}

impl From<NoLine> for RecordingProblem {
    fn from(reason: NoLine) -> Self {
        match reason {
            NoLine::TooLong => Self::TooLong,
            NoLine::Io(error) => Self::Unreadable(error),
        }
    }
}

/// A list of column or member names in a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Names(pub Vec<String>);

/// The most names in a message.
const LISTED: usize = 12;

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("none");
        }
        for (index, name) in self.0.iter().take(LISTED).enumerate() {
            let name = super::cell::shorten(name.as_bytes());
            write!(f, "{}\"{name}\"", if index > 0 { ", " } else { "" })?;
        }
        match self.0.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// The hint as text.
fn did_you_mean(hint: &Option<String>) -> String {
    hint.as_ref()
        .map_or(String::new(), |name| format!(", did you mean \"{name}\"?"))
}

fn stream(has_drum: bool) -> &'static str {
    if has_drum {
        "`acceleration,drum` or `time,acceleration,drum`, the drum 0 or 1"
    } else {
        "`acceleration` or `time,acceleration`"
    }
}
