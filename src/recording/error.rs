//! Why a recording was refused: the file, the line, the rule, the value and the remedy.

use super::axis::Axis;
use super::cell::shorten;
use super::unit::{TimeUnit, UnitError};
use crate::suggest::nearest;
use std::fmt;
use std::io;

/// Why a recording was refused, and where.
#[derive(Debug, thiserror::Error)]
#[error("{file}{}: {problem}", .line.map_or(String::new(), |line| format!(":{line}")))]
pub struct RecordingError {
    /// Its name.
    pub file: String,
    /// The line at fault, from 1.
    pub line: Option<u64>,
    /// What is wrong.
    pub problem: Box<RecordingProblem>,
}

impl RecordingError {
    /// Whether names are listed under these words.
    pub(super) fn is_among(&self, what: &str) -> bool {
        matches!(&*self.problem, RecordingProblem::Among { what: it, .. } if *it == what)
    }
}

/// A problem with the line to blame, if there is one.
pub(super) type Located = (Option<u64>, RecordingProblem);

/// Why a recording was refused.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "what a message says is not said again")]
pub enum RecordingProblem {
    #[error("cannot be read: {0} (check the path and the file)")]
    Unreadable(#[from] io::Error),
    /// Neither a line nor a reading.
    #[error("is empty (export it again)")]
    Empty,
    #[error("has a header and no readings (export it again)")]
    HeaderOnly,
    /// What needs no value.
    #[error("{0}")]
    Simple(&'static str),
    #[error("{rule}, got {got} ({remedy})")]
    Must {
        rule: &'static str,
        got: String,
        remedy: &'static str,
    },
    /// A value of a column.
    #[error("column \"{column}\": must {rule}, got {got} ({remedy})")]
    Cell {
        column: String,
        rule: &'static str,
        got: String,
        remedy: &'static str,
    },
    /// What another program wrote, and says why it cannot be read.
    #[error("{what}: {error} ({remedy})")]
    Damaged {
        what: &'static str,
        error: String,
        remedy: &'static str,
    },
    /// A name that the user gave.
    #[error("no {what} \"{got}\"{} (there are {known})", did_you_mean(got, known))]
    Unknown {
        what: &'static str,
        got: String,
        known: Names,
    },
    /// Names among which none, or more than one, is right.
    #[error("{what} {names} ({remedy})")]
    Among {
        what: &'static str,
        names: Names,
        remedy: &'static str,
    },
    #[error(
        "no column looks like the acceleration along {axis}, the columns are {found} (--acceleration COLUMN)"
    )]
    NoAxis { axis: Axis, found: Names },
    #[error(
        "a table of {width} columns must have a header (or give the numbers of two of them: \
         --time 1 --acceleration {})",
        .width.min(&4)
    )]
    Unnamed { width: usize },
    #[error(
        "would take {gigabytes:.1} GB of memory, at most 2 are taken (read a part of it with --from and --to in \
         s, or send its rows to `liftsim monitor`)"
    )]
    TooLarge { gigabytes: f64 },
    #[error(
        "must have at least 2 readings from {from} to {to} s, got {got} (times go from {first} to {last} s: change \
         --from or --to)"
    )]
    NothingLeft {
        from: f64,
        to: f64,
        got: u64,
        first: f64,
        last: f64,
    },
    #[error(
        "no unit is named, and the mean is {mean:.1}, that of gravity 9.8 m/s^2 (if gravity is in it: \
         --unit counts --scale {scale:.4e}; else give --scale and --offset)"
    )]
    UnknownCounts { mean: f64, scale: f64 },
    #[error("must have {expected} cells as the first row has, got {got}{hint}")]
    Cells {
        expected: usize,
        got: usize,
        /// A possible reason, in brackets after a space.
        hint: &'static str,
    },
    #[error(
        "cells are parted by {expected} in the first row, here by {got} (write one of them throughout)"
    )]
    MixedSeparators {
        expected: &'static str,
        got: &'static str,
    },
    #[error("time must increase, got {to} s after {from} s (sort the rows, or split the file)")]
    TimeBack { from: f64, to: f64 },
    #[error(
        "column \"{column}\": counted in {unit} it gives {rate} readings a second (--time-unit {})",
        .likely.map_or("s, ms, us or ns".to_owned(), |unit| unit.to_string())
    )]
    Rate {
        column: String,
        unit: TimeUnit,
        rate: f64,
        likely: Option<TimeUnit>,
    },
    #[error("resample must lie in (0, {limit}] Hz, ten times what was recorded, got {got}")]
    Resample { got: f64, limit: f64 },
    #[error("{0}")]
    Unit(#[from] UnitError),
}

impl RecordingProblem {
    pub(super) const BINARY: Self = Self::Simple("holds bytes that are not text (export as CSV)");

    pub(super) fn must(rule: &'static str, got: impl fmt::Display, remedy: &'static str) -> Self {
        Self::Must {
            rule,
            got: got.to_string(),
            remedy,
        }
    }

    pub(super) fn unknown<'a>(
        what: &'static str,
        got: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        Self::Unknown {
            what,
            got: got.to_owned(),
            known: Names::of(known),
        }
    }
}

/// A list of column or member names in a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Names(Vec<String>);

impl Names {
    pub(super) fn of<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        Self(names.into_iter().map(str::to_owned).collect())
    }
}

/// The most names in a message.
const LISTED: usize = 12;

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = self.0.iter().take(LISTED);
        let shown: Vec<String> = shown
            .map(|name| format!("\"{}\"", shorten(name.as_bytes())))
            .collect();
        match self.0.len().saturating_sub(LISTED) {
            0 if shown.is_empty() => f.write_str("none"),
            0 => f.write_str(&shown.join(", ")),
            more => write!(f, "{} and {more} more", shown.join(", ")),
        }
    }
}

fn did_you_mean(got: &str, known: &Names) -> String {
    nearest(got, known.0.iter().map(String::as_str))
        .map_or(String::new(), |name| format!(", did you mean \"{name}\"?"))
}
