//! What is wrong with a recording: the file, the line, the rule, what was found, what to do.

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

    /// The line it is about, from 1.
    pub fn line(&self) -> Option<u64> {
        self.0.line
    }

    /// What is wrong.
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

/// What is wrong with a recording.
#[derive(Debug, thiserror::Error)]
pub enum RecordingProblem {
    /// The system refuses.
    #[error("cannot be read: {0} (check the path and the file)")]
    Unreadable(#[source] io::Error),
    /// Not a file, and so not to be read twice.
    #[error("must be a file, got {0} (a stream of readings is for the monitor)")]
    NotAFile(&'static str),
    /// A member of what has none.
    #[error("no zip archive, so it has no member \"{0}\" (leave out --member)")]
    NotAnArchive(String),
    /// An archive by its name alone.
    #[error("ends in .zip, but is no zip archive (was it downloaded whole?)")]
    NotAZip,
    /// A damaged or unsupported archive.
    #[error("zip archive: {0} (export it anew)")]
    Archive(#[from] zip::result::ZipError),
    /// A member that is packed in another way.
    #[error("zip archive: {0} is encrypted, or packed by another method than deflate (unpack it)")]
    Packing(String),
    /// A member that is not there.
    #[error("zip archive: no member \"{got}\"{} (it holds {found})", did_you_mean(.hint))]
    UnknownMember {
        /// As asked.
        got: String,
        /// The nearest one.
        hint: Option<String>,
        /// All there are.
        found: Names,
    },
    /// An archive of something else.
    #[error("zip archive: no member is a table of accelerations, it holds {0} (export as CSV)")]
    NoTable(Names),
    /// More than one to choose from.
    #[error("zip archive: {0} are tables of accelerations (--member NAME)")]
    SeveralTables(Names),
    /// Nothing at all.
    #[error("is empty (was it exported whole?)")]
    Empty,
    /// Names and no numbers.
    #[error("has a header and no readings (was it exported whole?)")]
    HeaderOnly,
    /// One reading makes no signal, nor do several at one time.
    #[error("must have at least 2 readings of the acceleration at different times, got {0}")]
    TooFew(u64),
    /// A dead sensor.
    #[error("every reading of the acceleration is {0} (is this the right column?)")]
    AllEqual(f64),
    /// Bytes that are no text.
    #[error("holds bytes that are no text (is this a table? export as CSV)")]
    Binary,
    /// No end in sight.
    #[error("must be at most {LONGEST_LINE} bytes long (is this a table of numbers?)")]
    TooLong,
    /// A column that is not there.
    #[error("no column \"{got}\" for the {role}{} (the columns are {found})", did_you_mean(.hint))]
    UnknownColumn {
        /// Time or acceleration.
        role: &'static str,
        /// As asked.
        got: String,
        /// The nearest one.
        hint: Option<String>,
        /// All there are.
        found: Names,
    },
    /// Numbers alone, of which two might be those.
    #[error(
        "a table of {width} columns must have a header (or give the numbers of two of them: \
         --time 1 --acceleration {})",
        .width.min(&4)
    )]
    Unnamed {
        /// How many columns there are.
        width: usize,
    },
    /// No column looks like time.
    #[error("no column looks like time, the columns are {0} (--time COLUMN)")]
    NoTime(Names),
    /// No column looks like an acceleration.
    #[error("no column looks like an acceleration, the columns are {0} (--acceleration COLUMN)")]
    NoAcceleration(Names),
    /// A table without the axis that is asked for.
    #[error(
        "no column looks like the acceleration along {axis}, the columns are {found} \
         (--acceleration COLUMN)"
    )]
    NoAxis {
        /// As asked.
        axis: Axis,
        /// All there are.
        found: Names,
    },
    /// Gravity cannot say where up is.
    #[error(
        "vertical along gravity: needs x, y and z in the same rows and a mean of about 9.8 m/s^2, \
         got {0} (--axis x, y or z)"
    )]
    NoGravity(&'static str),
    /// Words among numbers.
    #[error("column \"{column}\": must be a number, got \"{got}\"{remedy}")]
    NotANumber {
        /// Its name.
        column: String,
        /// As written, shorten.
        got: String,
        /// What to do, in brackets after a space; or nothing.
        remedy: &'static str,
    },
    /// NaN or an infinity.
    #[error(
        "column \"{column}\": must be finite, got \"{got}\" (leave the cell blank where nothing was read)"
    )]
    NotFinite {
        /// Its name.
        column: String,
        /// As written, shorten.
        got: String,
    },
    /// A number that no lift makes, and that sums of squares would not survive.
    #[error("column \"{column}\": must lie within 1e{exponent} {unit}, got {got} ({remedy})")]
    OutOfRange {
        /// Its name.
        column: String,
        /// Of the limit, a power of ten.
        exponent: u8,
        /// Of the limit.
        unit: &'static str,
        /// In that unit.
        got: f64,
        /// What to do.
        remedy: &'static str,
    },
    /// A row of another table.
    #[error("must have {expected} cells as the first row has, got {got}{}", .hint.unwrap_or_default())]
    Cells {
        /// Of the first row.
        expected: usize,
        /// Of this one.
        got: usize,
        /// What may be the reason, in brackets after a space.
        hint: Option<&'static str>,
    },
    /// Two separators in one file.
    #[error(
        "cells are parted by {expected} in the first row, here by {got} (write one of them throughout)"
    )]
    MixedSeparators {
        /// Of the first row.
        expected: &'static str,
        /// Of this one.
        got: &'static str,
    },
    /// A clock that was set back, or two files in one.
    #[error("time must increase, got {to} s after {from} s (sort the rows, or split the file)")]
    TimeBack {
        /// The reading before.
        from: f64,
        /// This one.
        to: f64,
    },
    /// A clock that cannot be right.
    #[error(
        "column \"{column}\": counted in {unit} it gives {rate} readings a second (--time-unit {})",
        .likely.map_or("s, ms, us or ns".to_owned(), |unit| unit.to_string())
    )]
    Rate {
        /// Its name.
        column: String,
        /// As named, or seconds.
        unit: TimeUnit,
        /// Hz.
        rate: f64,
        /// The unit in which it would be a sensor's clock.
        likely: Option<TimeUnit>,
    },
    /// A unit that is none.
    #[error("{0}")]
    Unit(#[from] UnitError),
    /// A rate that is none.
    #[error("resample must lie in (0, {limit}] Hz, ten times what was recorded, got {got}")]
    Resample {
        /// As given.
        got: f64,
        /// The highest one.
        limit: f64,
    },
}

/// Names of columns or members, in print.
#[derive(Clone, Debug, PartialEq)]
pub struct Names(pub Vec<String>);

/// Names that a message lists.
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

/// A hint in words.
fn did_you_mean(hint: &Option<String>) -> String {
    hint.as_ref()
        .map_or(String::new(), |name| format!(", did you mean \"{name}\"?"))
}
