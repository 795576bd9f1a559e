//! Errors of recordings: the file, the line, the rule, the value and the remedy.

use super::axis::Axis;
use super::lines::LONGEST_LINE;
use super::reading::{TimeUnit, UnitError};
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
    /// A member asked for in a file that is not an archive.
    #[error("no zip archive, so it has no member \"{0}\" (leave out --member)")]
    NotAnArchive(String),
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
    #[error("must be at most {LONGEST_LINE} bytes long (export a table of numbers)")]
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
    #[error("no column looks like time, the columns are {0} (--time COLUMN)")]
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
        "vertical along gravity: needs x, y and z in the same rows and a mean of about 9.8 m/s^2, \
         got {0} (--axis x, y or z)"
    )]
    NoGravity(&'static str),
    /// A cell that is not a number.
    #[error("column \"{column}\": must be a number, got \"{got}\"{remedy}")]
    NotANumber {
        /// The name of the column.
        column: String,
        /// The text, shortened.
        got: String,
        /// The remedy, in brackets after a space; may be empty.
        remedy: &'static str,
    },
    /// NaN or an infinity.
    #[error(
        "column \"{column}\": must be finite, got \"{got}\" (leave the cell blank where nothing was read)"
    )]
    NotFinite {
        /// The name of the column.
        column: String,
        /// The text, shortened.
        got: String,
    },
    /// A number that no lift gives and whose square might overflow.
    #[error("column \"{column}\": must lie within 1e{exponent} {unit}, got {got} ({remedy})")]
    OutOfRange {
        /// The name of the column.
        column: String,
        /// The limit as a power of ten.
        exponent: u8,
        /// The unit of the limit.
        unit: &'static str,
        /// The value in that unit.
        got: f64,
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
            let name = super::line_reader::shorten(name.as_bytes());
            write!(f, "{}\"{name}\"", if index > 0 { ", " } else { "" })?;
        }
        match self.0.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// The name nearest to `got`, if it is near.
pub(super) fn nearest(got: &str, known: &[String]) -> Option<String> {
    let got = got.to_lowercase();
    known
        .iter()
        .map(|name| {
            (
                strsim::damerau_levenshtein(&got, &name.to_lowercase()),
                name,
            )
        })
        .min()
        .filter(|&(distance, name)| distance <= name.chars().count().div_ceil(3))
        .map(|(_, name)| name.clone())
}

/// The hint as text.
fn did_you_mean(hint: &Option<String>) -> String {
    hint.as_ref()
        .map_or(String::new(), |name| format!(", did you mean \"{name}\"?"))
}
