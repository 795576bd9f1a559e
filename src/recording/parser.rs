//! Lines into times and accelerations: the one way for files and for streams.

use super::cell::{Cell, DecimalMark, shorten};
use super::clock::Clock;
use super::error::{Located, RecordingProblem};
use super::head::Head;
use super::layout::{Input, Layout};
use super::lines::Lines;
use super::reading::Reading;
use super::splitter::{Delimiter, Splitter};
use super::unit::Unit;
use serde::{Deserialize, Serialize};
use std::io::BufRead;

/// What a cell must do, and else the user. No recording of a lift has times or accelerations beyond these: 30 000
/// years, and ten thousand times the range of a shock sensor.
type Rule = (&'static str, &'static str);
const NUMBER: Rule = ("be a number", "correct it, or leave the row out");
const TIME: Rule = (
    "be a number",
    "write times as numbers, or all as 2013-11-25T12:30:00.005Z",
);
const FINITE: Rule = ("be finite", "leave the row out where nothing was read");
const LATEST: Rule = (
    "lie within 1e12 s",
    "check the unit: --time-unit s, ms, us or ns",
);
const STRONGEST: Rule = (
    "lie within 1e9 m/s^2",
    "check the unit: --unit m/s^2, g, mg or counts",
);

/// Reads the rows of one table.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Parser {
    pub layout: Layout,
    pub clock: Clock,
    pub splitter: Splitter,
    marks: [DecimalMark; 3],
    /// Whether the last cell of the row before was written with an exponent.
    had_exponent: bool,
}

/// What a row says, in s and in the unit of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Row {
    pub time: Option<f64>,
    pub axes: [Option<f64>; 3],
    /// Whether a cell is NaN.
    pub is_missing: bool,
}

impl Parser {
    /// Reads up to the first row, which is read next.
    ///
    /// # Errors
    /// If there is no table, or a column cannot be found, with the line to blame.
    pub fn begin<R: BufRead>(
        lines: &mut Lines<R>,
        owner: &str,
        reading: &Reading,
        input: Input,
    ) -> Result<Self, Located> {
        let mut head = Head::read(lines, owner)?;
        let (layout, first) = Layout::of(&mut head, owner, reading, input)?;
        lines.give_back(head.lines.split_off(first));
        Ok(Self {
            clock: match input {
                Input::File(_) => Clock::of_file(layout.time_unit),
                Input::Stream { .. } => Clock::of_stream(layout.time_unit),
            },
            layout,
            splitter: head.splitter,
            marks: Default::default(),
            had_exponent: false,
        })
    }

    /// Reads a row; `None` where the file was cut off within it, which only a line without an end can be.
    ///
    /// # Errors
    /// If the line has other cells than the first row, or one that is read is no number.
    #[inline]
    pub fn read(&mut self, line: &[u8], is_ended: bool) -> Result<Option<Row>, RecordingProblem> {
        let expected = self.layout.columns.len();
        let got = self.splitter.split(line);
        if got != expected {
            let mut more = self.splitter.cells(line).skip(expected);
            if got < expected && !is_ended {
                return Ok(None);
            }
            if got < expected || !more.all(<[u8]>::is_empty) {
                return Err(self.wrong_cells(line, got));
            }
        }
        let last = self.splitter.cell(line, expected - 1);
        let has_exponent = last.iter().any(|c| matches!(c, b'e' | b'E'));
        if !is_ended && self.had_exponent && !has_exponent && self.reads(expected - 1) {
            return Ok(None);
        }
        self.had_exponent = has_exponent;
        match self.values(line) {
            Err(RecordingProblem::Cell { .. }) if !is_ended => Ok(None),
            row => row.map(Some),
        }
    }

    /// Whether a column is read.
    fn reads(&self, column: usize) -> bool {
        let mut axes = self.layout.axes.iter();
        self.layout.time == Some(column) || axes.any(|(_, axis)| *axis == column)
    }

    #[inline]
    fn values(&mut self, line: &[u8]) -> Result<Row, RecordingProblem> {
        let mut row = Row::default();
        if let Some(column) = self.layout.time {
            let cell = self.splitter.cell(line, column);
            row.time = match self.clock.read(cell) {
                Ok(Some(time)) if time.abs() > 1e12 => {
                    return Err(self.refused(column, cell, LATEST));
                }
                Ok(time) => time,
                Err(Cell::Infinite) => return Err(self.refused(column, cell, FINITE)),
                Err(_) => return Err(self.refused(column, cell, TIME)),
            };
        }
        let unit = self.layout.unit.unwrap_or(Unit::MetresPerSecondSquared);
        for (place, (_, column)) in self.layout.axes.iter().enumerate() {
            let cell = self.splitter.cell(line, *column);
            let read = self.marks[place].read(cell);
            row.is_missing |= read == Cell::Missing;
            row.axes[place] = match read {
                Cell::Number(number) if unit.convert(number).abs() > 1e9 => {
                    return Err(self.refused(*column, cell, STRONGEST));
                }
                Cell::Number(number) => Some(number),
                Cell::Blank | Cell::Missing => None,
                Cell::Infinite => return Err(self.refused(*column, cell, FINITE)),
                Cell::Text => return Err(self.refused(*column, cell, NUMBER)),
            };
        }
        Ok(row)
    }

    fn refused(&self, column: usize, cell: &[u8], (rule, remedy): Rule) -> RecordingProblem {
        if cell.iter().any(u8::is_ascii_control) {
            return RecordingProblem::BINARY;
        }
        RecordingProblem::Cell {
            column: self.layout.columns[column].name.clone(),
            got: match cell {
                [] => "nothing".to_owned(),
                cell => format!("\"{}\"", shorten(cell)),
            },
            rule,
            remedy,
        }
    }

    /// Refuses a row of a stream that lacks the time or the acceleration.
    pub fn check_whole(&self, line: &[u8], row: &Row) -> Result<(), RecordingProblem> {
        let blank = match self.layout.time {
            Some(time) if row.time.is_none() => time,
            _ if row.axes[0].is_none() => self.layout.axes[0].1,
            _ => return Ok(()),
        };
        Err(self.refused(blank, self.splitter.cell(line, blank), FINITE))
    }

    /// The error for a line with a different number of cells than the first.
    fn wrong_cells(&self, line: &[u8], got: usize) -> RecordingProblem {
        if line.iter().any(|&c| c.is_ascii_control() && c != b'\t') {
            return RecordingProblem::BINARY;
        }
        let (expected, delimiter) = (self.layout.columns.len(), self.splitter.delimiter);
        let fits = |other: &Delimiter| {
            expected > 1
                && *other != delimiter
                && Splitter::new(*other, line).split(line) == expected
        };
        let other = Delimiter::ALL.into_iter().find(fits);
        if let (Some(other), true) = (other, got == 1 || got > expected) {
            return RecordingProblem::MixedSeparators {
                expected: delimiter.name(),
                got: other.name(),
            };
        }
        let is_comma_mark = delimiter == Delimiter::Comma && got > expected;
        RecordingProblem::Cells {
            expected,
            got,
            hint: if is_comma_mark {
                " (write decimal points, or quote cells with decimal commas)"
            } else {
                ""
            },
        }
    }
}
