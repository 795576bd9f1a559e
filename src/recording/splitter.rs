//! Lines into cells.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// What stands between cells.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize, Deserialize)]
pub(super) enum Delimiter {
    Tab,
    Semicolon,
    Comma,
    /// One or more.
    Blank,
}

impl Delimiter {
    /// A comma may be a decimal mark where there are tabs or semicolons, and blanks may stand around any.
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Blank];

    fn byte(self) -> u8 {
        match self {
            Self::Tab => b'\t',
            Self::Semicolon => b';',
            Self::Comma => b',',
            Self::Blank => b' ',
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Tab => "a tab",
            Self::Semicolon => "a semicolon",
            Self::Comma => "a comma",
            Self::Blank => "blanks",
        }
    }
}

/// What a serial monitor writes between the time of day and what it received.
const ARROW: &[u8] = b" -> ";

/// Splits lines into cells, whose places are kept in one reused list.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Splitter {
    pub delimiter: Delimiter,
    /// Whether the first cell ends with an arrow.
    has_arrow: bool,
    cells: Vec<Range<usize>>,
}

impl Splitter {
    /// For lines like this one.
    pub fn new(delimiter: Delimiter, line: &[u8]) -> Self {
        Self {
            delimiter,
            has_arrow: arrow(line).is_some(),
            cells: Vec::new(),
        }
    }

    /// Splits a line without its line end; returns the number of cells.
    #[inline]
    pub fn split(&mut self, line: &[u8]) -> usize {
        self.cells.clear();
        let mut start = 0;
        if self.has_arrow
            && let Some(end) = arrow(line)
        {
            self.cells.push(0..end);
            start = end + ARROW.len();
        }
        if self.delimiter == Delimiter::Blank {
            self.split_at_blanks(line, start);
            return self.cells.len();
        }
        let (mut from, byte) = (start, self.delimiter.byte());
        let mut is_quoted = false;
        for (end, c) in (start..).zip(&line[start..]) {
            is_quoted ^= *c == b'"';
            if *c == byte && !is_quoted {
                self.cells.push(from..end);
                from = end + 1;
            }
        }
        self.cells.push(from..line.len());
        self.cells.len()
    }

    fn split_at_blanks(&mut self, line: &[u8], start: usize) {
        let mut from = start;
        for (place, c) in (start..).zip(&line[start..]) {
            if c.is_ascii_whitespace() {
                if from < place {
                    self.cells.push(from..place);
                }
                from = place + 1;
            }
        }
        if from < line.len() {
            self.cells.push(from..line.len());
        }
    }

    /// A cell of `line`, which was split last, without its quotes; an empty one beyond its end.
    #[inline]
    pub fn cell<'a>(&self, line: &'a [u8], index: usize) -> &'a [u8] {
        let Some(range) = self.cells.get(index) else {
            return &[];
        };
        let cell = line[range.clone()].trim_ascii();
        match cell.strip_prefix(b"\"") {
            Some(cell) => cell.strip_suffix(b"\"").unwrap_or(cell),
            None => cell,
        }
    }

    /// Where the cell before this one ended, if there is one.
    pub fn before(&self, index: usize) -> Option<usize> {
        Some(self.cells[index.checked_sub(1)?].end)
    }

    /// All cells of `line`, which was split last.
    pub fn cells<'a>(&'a self, line: &'a [u8]) -> impl Iterator<Item = &'a [u8]> {
        (0..self.cells.len()).map(|index| self.cell(line, index))
    }
}

fn arrow(line: &[u8]) -> Option<usize> {
    // As long as a date with a time.
    let start = &line[..line.len().min(32)];
    memchr::memmem::find(start, ARROW)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(delimiter: Delimiter, line: &str) -> Vec<String> {
        let mut splitter = Splitter::new(delimiter, line.as_bytes());
        splitter.split(b"left,from,before");
        splitter.split(line.as_bytes());
        let cells = splitter.cells(line.as_bytes());
        cells
            .map(|cell| String::from_utf8_lossy(cell).into_owned())
            .collect()
    }

    #[test]
    fn splits() {
        assert_eq!(split(Delimiter::Comma, "1,,3"), ["1", "", "3"]);
        assert_eq!(split(Delimiter::Comma, "1,"), ["1", ""]);
        assert_eq!(
            split(Delimiter::Comma, "\"a, b\",\"9,81\""),
            ["a, b", "9,81"]
        );
        assert_eq!(split(Delimiter::Semicolon, "0,5;9,8"), ["0,5", "9,8"]);
        assert_eq!(split(Delimiter::Tab, "1\r2\t\"open"), ["1\r2", "open"]);
        assert_eq!(split(Delimiter::Blank, " 0.5  9.8\t"), ["0.5", "9.8"]);
        assert_eq!(split(Delimiter::Comma, &",".repeat(100)).len(), 101);
        assert_eq!(
            split(Delimiter::Comma, "14:23:00.005 -> 1,2"),
            ["14:23:00.005", "1", "2"]
        );
    }
}
