//! What stands before the first row: preamble, header and units.

use super::cell::{Cell, DecimalMark};
use super::error::{Located, RecordingProblem};
use super::lines::{Kept, Lines};
use super::names::{Column, Role};
use super::pressure;
use super::splitter::{Delimiter, Splitter};
use super::stamp;
use std::io::BufRead;

/// The most lines before the first row, and the most bytes of them.
const MOST_LINES: usize = 200;
const MOST_BYTES: usize = 1 << 21;

const NO_ROWS: &str = "no row of numbers in the first 200 lines (export a table of numbers)";

/// The lines up to the first row, which is the last of them.
#[derive(Debug)]
pub(super) struct Head {
    pub lines: Vec<Kept>,
    pub splitter: Splitter,
}

impl Head {
    /// Reads lines up to the first row: numbers, times and blanks, or such under a header that names a time and
    /// an acceleration. The delimiter is the one under which that row is first found.
    ///
    /// # Errors
    /// If there is none.
    pub fn read<R: BufRead>(lines: &mut Lines<R>, owner: &str) -> Result<Self, Located> {
        let mut head: Vec<Kept> = Vec::new();
        let mut bytes = 0;
        while let Some(line) = lines.next()? {
            bytes += line.bytes.len();
            let is_long = head.len() == MOST_LINES || bytes > MOST_BYTES;
            let problem = if line
                .bytes
                .iter()
                .any(|&c| c.is_ascii_control() && c != b'\t')
            {
                Some(RecordingProblem::BINARY)
            } else if line.bytes.starts_with(b"{") {
                // A file of JSON is a table by now.
                Some(no_stream(false))
            } else {
                is_long.then_some(RecordingProblem::Simple(NO_ROWS))
            };
            if let Some(problem) = problem {
                return Err((Some(line.number), problem));
            }
            let above = head.len();
            head.push(line.keep());
            let (above, row) = head.split_at(above);
            let splitters = Delimiter::ALL.map(|delimiter| Splitter::new(delimiter, &row[0].bytes));
            let mut splitters = splitters.into_iter();
            let found =
                splitters.find_map(|splitter| is_row(splitter, &row[0].bytes, above, owner));
            if let Some(splitter) = found {
                return Ok(Self {
                    lines: head,
                    splitter,
                });
            }
        }
        Self::of_words(head, owner)
    }

    /// Of lines that are no rows: below a header any line with a number is meant to be one.
    fn of_words(mut lines: Vec<Kept>, owner: &str) -> Result<Self, Located> {
        for delimiter in Delimiter::ALL {
            let mut splitter = Splitter::new(delimiter, b"");
            let mut is_header = |line: &Kept| is_header(&names(&mut splitter, &line.bytes, owner));
            let Some(header) = lines.iter().position(&mut is_header) else {
                continue;
            };
            let mut below = lines.iter().skip(header + 1);
            let Some(row) = below.position(|line| has_number(&mut splitter, &line.bytes)) else {
                return Err((None, RecordingProblem::HeaderOnly));
            };
            lines.truncate(header + 1 + row + 1);
            return Ok(Self { lines, splitter });
        }
        let is_empty = lines.is_empty();
        let no_rows = RecordingProblem::Simple(NO_ROWS);
        Err((
            None,
            if is_empty {
                RecordingProblem::Empty
            } else {
                no_rows
            },
        ))
    }

    /// The columns as named by the header, and its place among the lines.
    ///
    /// Of the lines with as many cells as the first row, the first that names a time or an acceleration; else
    /// the first of them; else any that names both, which will not fit the rows.
    pub fn header(&mut self, owner: &str) -> Option<(Vec<Column>, usize)> {
        let (row, words) = self.lines.split_last()?;
        let width = self.splitter.split(&row.bytes);
        let used = names(&mut self.splitter, &row.bytes, owner).len();
        let named: Vec<_> = (words.iter())
            .map(|line| names(&mut self.splitter, &line.bytes, owner))
            .zip(0..)
            .collect();
        let fits = |(columns, _): &&(Vec<Column>, usize)| (used..=width).contains(&columns.len());
        let knows = |(columns, _): &&(Vec<Column>, usize)| {
            columns.iter().any(|column| column.role != Role::Other)
        };
        let found = (named.iter().filter(fits).find(knows))
            .or(named.iter().find(fits))
            .or(named.iter().find(|(columns, _)| is_header(columns)));
        found.cloned()
    }

    /// The number of cells of the first row.
    pub fn width(&mut self) -> usize {
        let row = self.lines.last();
        row.map_or(0, |row| self.splitter.split(&row.bytes))
    }

    /// Reads the lines below the names at `place`: units and the like, the first of which a column without a unit
    /// is given. A line with a number is a row; returns the place of the first.
    pub fn units(&mut self, place: usize, columns: &mut [Column]) -> usize {
        let mut first = place + 1;
        for line in &self.lines[first..] {
            if has_number(&mut self.splitter, &line.bytes) {
                break;
            }
            first += 1;
            for (column, cell) in columns.iter_mut().zip(self.splitter.cells(&line.bytes)) {
                column.unit_below(&String::from_utf8_lossy(cell));
            }
        }
        first.min(self.lines.len() - 1)
    }
}

/// A stream whose lines are not understood.
pub(super) fn no_stream(has_drum: bool) -> RecordingProblem {
    RecordingProblem::Simple(if has_drum {
        "must be `acceleration,drum` or `time,acceleration,drum`, the drum 0 or 1"
    } else {
        "must be `acceleration` or `time,acceleration`"
    })
}

/// The cells of a line as names of columns, without blank ones at its end.
fn names(splitter: &mut Splitter, line: &[u8], owner: &str) -> Vec<Column> {
    splitter.split(line);
    let cells: Vec<&[u8]> = splitter.cells(line).collect();
    let used = cells.iter().rposition(|cell| !cell.is_empty());
    cells[..used.map_or(0, |last| last + 1)]
        .iter()
        .map(|cell| Column::new(&String::from_utf8_lossy(cell).replace("\"\"", "\""), owner))
        .collect()
}

/// Whether both a time and an acceleration, or a pressure, are named.
fn is_header(columns: &[Column]) -> bool {
    let has = |is: fn(Role) -> bool| columns.iter().any(|column| is(column.role));
    let is_measured = has(|role| matches!(role, Role::Along { .. } | Role::Acceleration));
    has(|role| matches!(role, Role::Time { .. }))
        && (is_measured || !pressure::columns(columns).is_empty())
}

/// The splitter, if by it a line is a row: every cell is a number, a time or blank; or those are that a header
/// above names.
fn is_row(mut splitter: Splitter, line: &[u8], above: &[Kept], owner: &str) -> Option<Splitter> {
    let width = splitter.split(line);
    if width == 1 && splitter.delimiter != Delimiter::Comma {
        return None;
    }
    let cells: Vec<&[u8]> = splitter.cells(line).collect();
    let is_strict = cells.iter().all(|cell| is_value(cell));
    if cells.iter().any(|cell| is_number(cell)) && is_strict {
        return Some(splitter);
    }
    let is_header = above.iter().any(|header| {
        let columns = names(&mut splitter.clone(), &header.bytes, owner);
        let used = columns.iter().zip(&cells);
        let mut used =
            used.filter_map(|(column, cell)| (column.role != Role::Other).then_some(*cell));
        columns.len() == width
            && is_header(&columns)
            && used.clone().all(is_value)
            && used.any(is_number)
    });
    is_header.then_some(splitter)
}

fn has_number(splitter: &mut Splitter, line: &[u8]) -> bool {
    splitter.split(line);
    splitter.cells(line).any(is_number)
}

fn is_number(cell: &[u8]) -> bool {
    let number = DecimalMark::default().read(cell);
    matches!(number, Cell::Number(_) | Cell::Infinite) || stamp::read(cell).is_some()
}

/// Whether a cell may stand in a row of readings. Loggers write their address in hexadecimal.
fn is_value(cell: &[u8]) -> bool {
    let other = DecimalMark::default().read(cell) != Cell::Text;
    other || cell.starts_with(b"0x") || stamp::read(cell).is_some()
}
