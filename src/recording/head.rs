//! What stands before the first row: preamble, header and units.

use super::cell::{Cell, DecimalMark};
use super::error::RecordingProblem;
use super::lines::Lines;
use super::names::{Column, Role};
use super::splitter::{Delimiter, Splitter};
use super::stamp;
use std::io::BufRead;
use std::ops::Range;

/// The most lines before the first row.
const MOST_LINES: usize = 200;

/// The most bytes of them.
const MOST_BYTES: usize = 1 << 21;

/// A line that was read ahead.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub number: u64,
    pub bytes: Vec<u8>,
    pub is_ended: bool,
}

/// The lines up to the first row.
#[derive(Debug)]
pub(super) struct Head {
    pub lines: Vec<Kept>,
    pub splitter: Splitter,
    /// The number of cells in the first row, if there is one.
    pub width: Option<usize>,
}

impl Head {
    /// Reads lines up to the first row: numbers, times and blanks, or such under a header that names a time and
    /// an acceleration. The delimiter is the one under which that row is first found.
    ///
    /// # Errors
    /// The line and what is wrong with it.
    pub fn read<R: BufRead>(
        lines: &mut Lines<R>,
        owner: &str,
    ) -> Result<Self, (Option<u64>, RecordingProblem)> {
        let mut head: Vec<Kept> = Vec::new();
        let mut bytes = 0;
        loop {
            let number = lines.number() + 1;
            let line = match lines.next() {
                Ok(Some(line)) => line,
                Ok(None) if head.is_empty() => return Err((None, RecordingProblem::Empty)),
                Ok(None) => return Ok(Self::without_row(head, owner)),
                Err(reason) => return Err((Some(number), reason.into())),
            };
            let text = line.bytes;
            if text.iter().any(|&c| c.is_ascii_control() && c != b'\t') {
                return Err((Some(number), RecordingProblem::Binary));
            }
            if is_remark(text) {
                continue;
            }
            // A file of JSON is a table by now.
            if text.starts_with(b"{") {
                let has_drum = false;
                return Err((Some(number), RecordingProblem::Stream { has_drum }));
            }
            bytes += text.len();
            if head.len() == MOST_LINES || bytes > MOST_BYTES {
                return Err((Some(number), RecordingProblem::NoRows));
            }
            let kept = Kept {
                number,
                bytes: text.to_vec(),
                is_ended: line.is_ended,
            };
            let row = Delimiter::ALL.into_iter().find_map(|delimiter| {
                let mut splitter = Splitter::new(delimiter, &kept.bytes);
                is_row(&mut splitter, &kept.bytes, &head, owner).then_some(splitter)
            });
            if let Some(mut splitter) = row {
                let width = splitter.split(&kept.bytes);
                head.push(kept);
                return Ok(Self {
                    lines: head,
                    splitter,
                    width: Some(width),
                });
            }
            head.push(kept);
        }
    }

    /// Only words: a header without rows, or no table.
    fn without_row(lines: Vec<Kept>, owner: &str) -> Self {
        let splitters = Delimiter::ALL.map(|delimiter| Splitter::new(delimiter, b""));
        let has_header = |splitter: &&Splitter| {
            let named = |line: &Kept| names(&mut (*splitter).clone(), &line.bytes, owner);
            lines.iter().any(|line| is_header(&named(line)))
        };
        let has_cells = |splitter: &&Splitter| (*splitter).clone().split(&lines[0].bytes) > 1;
        let mut found = splitters.iter().filter(has_header);
        let found = found.next().or(splitters.iter().find(has_cells));
        Self {
            splitter: found.unwrap_or(&splitters[2]).clone(),
            lines,
            width: None,
        }
    }

    /// The columns as named by the header, and its place among the lines.
    ///
    /// Of the lines with as many cells as the first row, the first that names a time or an acceleration; else
    /// the first of them; else any that names both, which will not fit the rows.
    pub fn header(&self, owner: &str) -> Option<(Vec<Column>, usize)> {
        let mut splitter = self.splitter.clone();
        let rows = usize::from(self.width.is_some());
        let (words, row) = self.lines.split_at(self.lines.len() - rows);
        let mut named = |line: &Kept| names(&mut splitter, &line.bytes, owner);
        let fitting = match (row, self.width) {
            ([row], Some(width)) => named(row).len()..=width,
            _ => 0..=usize::MAX,
        };
        let named: Vec<_> = words.iter().map(named).zip(0..).collect();
        let fits = |(columns, _): &&(Vec<Column>, usize)| fitting.contains(&columns.len());
        let knows = |(columns, _): &&(Vec<Column>, usize)| {
            columns.iter().any(|column| column.role != Role::Other)
        };
        let found = (named.iter().filter(fits).find(knows))
            .or(named.iter().find(fits))
            .or(named.iter().find(|(columns, _)| is_header(columns)));
        found.cloned()
    }

    /// Gives columns without a unit the first that stands in one of these lines.
    pub fn units(&self, lines: Range<usize>, columns: &mut [Column]) {
        let mut splitter = self.splitter.clone();
        for line in &self.lines[lines] {
            splitter.split(&line.bytes);
            for (column, cell) in columns.iter_mut().zip(splitter.cells(&line.bytes)) {
                column.unit_below(&String::from_utf8_lossy(cell));
            }
        }
    }

    /// Whether a line holds a number or a time.
    pub fn has_number(&self, line: &Kept) -> bool {
        let mut splitter = self.splitter.clone();
        splitter.split(&line.bytes);
        splitter.cells(&line.bytes).any(is_number)
    }
}

/// Whether a line is blank, a comment, or tells a spreadsheet the delimiter.
pub(super) fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    matches!(line.first(), None | Some(b'#' | b'%')) || line.starts_with(b"sep=")
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

/// Whether both a time and an acceleration are named.
fn is_header(columns: &[Column]) -> bool {
    let has = |is: fn(Role) -> bool| columns.iter().any(|column| is(column.role));
    has(|role| matches!(role, Role::Time { .. }))
        && has(|role| matches!(role, Role::Along { .. } | Role::Acceleration))
}

/// Whether a line is a row: every cell is a number, a time or blank; or those are that a header above names.
fn is_row(splitter: &mut Splitter, line: &[u8], above: &[Kept], owner: &str) -> bool {
    let width = splitter.split(line);
    if width == 1 && splitter.delimiter != Delimiter::Comma {
        return false;
    }
    let cells: Vec<&[u8]> = splitter.cells(line).collect();
    let is_strict = cells.iter().all(|cell| is_value(cell));
    if cells.iter().any(|cell| is_number(cell)) && is_strict {
        return true;
    }
    let is_row_under = |header: &Kept| {
        let columns = names(&mut splitter.clone(), &header.bytes, owner);
        let used = columns
            .iter()
            .zip(&cells)
            .filter(|(column, _)| column.role != Role::Other);
        let mut used = used.map(|(_, cell)| *cell);
        columns.len() == width
            && is_header(&columns)
            && used.clone().all(is_value)
            && used.any(is_number)
    };
    above.iter().any(is_row_under)
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
