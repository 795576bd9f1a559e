//! The rows of a table, one at a time.

use super::cell::{Cell, DecimalMark};
use super::delimiter::{Delimiter, Splitter};
use super::error::{RecordingError, RecordingProblem};
use super::layout::{Layout, is_remark};
use super::line_reader::shorten;
use super::lines::{Lines, NoLine};
use super::source::{Source, Text};
use std::sync::Arc;

/// A table that is being read.
pub(super) struct Table {
    source: Source,
    layout: Arc<Layout>,
    lines: Lines<Text>,
    splitter: Splitter,
    mark: DecimalMark,
    /// Whether the row's last line end has been seen.
    is_ended: bool,
    /// Whether the last cell of the row before was written with an exponent.
    had_exponent: bool,
    cut: Option<u64>,
}

impl Table {
    pub fn open(source: &Source, layout: &Arc<Layout>) -> Result<Self, RecordingError> {
        let mut table = Self {
            source: source.clone(),
            layout: layout.clone(),
            lines: Lines::new(source.text()?),
            splitter: Splitter::new(layout.delimiter),
            mark: match layout.delimiter {
                Delimiter::Comma => DecimalMark::Point,
                _ => DecimalMark::Unknown,
            },
            is_ended: true,
            had_exponent: false,
            cut: None,
        };
        while table.lines.number() < layout.preamble {
            if let Err(reason) = table.lines.next() {
                return Err(table.unread(reason));
            }
        }
        Ok(table)
    }

    /// Goes to the next row; returns whether there is one. A last line without a line end and with too few cells
    /// is not a row: the file was cut there.
    pub fn advance(&mut self) -> Result<bool, RecordingError> {
        let expected = self.layout.columns.len();
        loop {
            let line = match self.lines.next() {
                Ok(Some(line)) => line,
                Ok(None) => return Ok(false),
                Err(reason) => return Err(self.unread(reason)),
            };
            if is_remark(line.bytes) {
                continue;
            }
            self.is_ended = line.is_ended;
            let got = self.splitter.split(line.bytes);
            if got == expected
                || self.splitter.cells().skip(expected).all(<[u8]>::is_empty) && got > expected
            {
                return Ok(true);
            }
            if got < expected && !line.is_ended {
                self.cut = Some(self.lines.number());
                return Ok(false);
            }
            let problem = wrong_cells(line.bytes, self.layout.delimiter, expected, got);
            return Err(self.error(problem));
        }
    }

    /// The number in a cell of the row; `None` if the cell is blank or was cut off with the file.
    #[inline]
    pub fn number(&mut self, column: usize) -> Result<Option<f64>, RecordingError> {
        let cell = self.splitter.cell(column);
        let read = self.mark.read(cell);
        if column + 1 == self.layout.columns.len() {
            let has_exponent = memchr::memchr2(b'e', b'E', cell).is_some();
            if !self.is_ended && self.had_exponent && !has_exponent {
                self.cut = Some(self.lines.number());
                return Ok(None);
            }
            self.had_exponent = has_exponent;
        }
        match read {
            Cell::Number(number) => Ok(Some(number)),
            Cell::Blank => Ok(None),
            Cell::Text if !self.is_ended => {
                self.cut = Some(self.lines.number());
                Ok(None)
            }
            Cell::Text | Cell::NotFinite => Err(self.error(self.refusal(column, read))),
        }
    }

    /// The line at which the file was cut off, once it has been reached.
    pub fn cut(&self) -> Option<u64> {
        self.cut
    }

    /// The row's line.
    pub fn line(&self) -> u64 {
        self.lines.number()
    }

    /// An error in this row.
    pub fn error(&self, problem: RecordingProblem) -> RecordingError {
        self.source.error(Some(self.lines.number()), problem)
    }

    fn refusal(&self, column: usize, read: Cell) -> RecordingProblem {
        let cell = self.splitter.cell(column);
        if cell.iter().any(u8::is_ascii_control) {
            return RecordingProblem::Binary;
        }
        let (column, got) = (self.layout.columns[column].name.clone(), shorten(cell));
        match read {
            Cell::NotFinite => RecordingProblem::NotFinite { column, got },
            _ => RecordingProblem::NotANumber {
                remedy: if is_date(cell) {
                    " (dates are not read: write times as numbers, in s from any start)"
                } else {
                    ""
                },
                column,
                got,
            },
        }
    }

    fn unread(&self, reason: NoLine) -> RecordingError {
        self.error(match reason {
            NoLine::TooLong => RecordingProblem::TooLong,
            NoLine::Io(error) => RecordingProblem::Unreadable(error),
        })
    }
}

/// Whether a cell looks like a date, 2013-11-25 or 25.11.2013, or contains a time of day.
fn is_date(cell: &[u8]) -> bool {
    let digits = |part: &[u8]| part.iter().take_while(|c| c.is_ascii_digit()).count();
    let parts: Vec<usize> = cell
        .trim_ascii()
        .splitn(3, |c| matches!(c, b'-' | b'/' | b'.' | b':'))
        .map(digits)
        .collect();
    match parts[..] {
        [1..=2, 1..=2, 4] | [4, 1..=2, 1..=2] => true,
        [hours, minutes, ..] => hours > 0 && minutes > 0 && cell.contains(&b':'),
        _ => false,
    }
}

/// The error for a line with a different number of cells than the first.
fn wrong_cells(line: &[u8], delimiter: Delimiter, expected: usize, got: usize) -> RecordingProblem {
    if line.iter().any(|&c| c.is_ascii_control() && c != b'\t') {
        return RecordingProblem::Binary;
    }
    let others = Delimiter::ALL
        .into_iter()
        .filter(|other| *other != delimiter);
    let mut others = others.filter(|other| other.count(line) + 1 == expected);
    if let (Some(other), true) = (others.next(), got == 1 || got > expected) {
        return RecordingProblem::MixedSeparators {
            expected: delimiter.name(),
            got: other.name(),
        };
    }
    let is_comma_mark = delimiter == Delimiter::Comma && got > expected;
    RecordingProblem::Cells {
        expected,
        got,
        hint: is_comma_mark
            .then_some(" (decimal commas need semicolons or tabs between the cells)"),
    }
}
