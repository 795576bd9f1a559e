//! The separator between the cells of a line.

use csv_core::{ReadRecordResult, Reader, ReaderBuilder, Terminator};

/// The separator between cells.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Delimiter {
    Comma,
    Semicolon,
    Tab,
}

impl Delimiter {
    pub const ALL: [Self; 3] = [Self::Tab, Self::Semicolon, Self::Comma];

    /// The separator of a file that begins with this line: the tab or the semicolon if there is one outside
    /// quotes, since a comma may then be a decimal mark.
    pub fn of(line: &[u8]) -> Self {
        let found = Self::ALL
            .into_iter()
            .find(|delimiter| delimiter.count(line) > 0);
        found.unwrap_or(Self::Comma)
    }

    pub fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Comma => "a comma",
            Self::Semicolon => "a semicolon",
            Self::Tab => "a tab",
        }
    }

    /// How often it occurs in `line`, outside quotes.
    pub fn count(self, line: &[u8]) -> usize {
        let mut is_quoted = false;
        line.iter()
            .filter(|&&c| {
                is_quoted ^= c == b'"';
                !is_quoted && c == self.byte()
            })
            .count()
    }
}

/// Splits lines into cells without quotes, in reused buffers.
#[derive(Debug)]
pub(super) struct Splitter {
    reader: Reader,
    text: Vec<u8>,
    ends: Vec<usize>,
    cells: usize,
}

impl Splitter {
    pub fn new(delimiter: Delimiter) -> Self {
        Self {
            reader: ReaderBuilder::new()
                .delimiter(delimiter.byte())
                .terminator(Terminator::Any(b'\n'))
                .build(),
            text: Vec::new(),
            ends: vec![0; 16],
            cells: 0,
        }
    }

    /// Splits a line without its line end; returns the number of cells.
    pub fn split(&mut self, mut line: &[u8]) -> usize {
        if self.text.len() < line.len() {
            self.text.resize(line.len(), 0);
        }
        self.reader.reset();
        let (mut written, mut ended) = (0, 0);
        loop {
            let (result, read, wrote, ends) =
                self.reader
                    .read_record(line, &mut self.text[written..], &mut self.ends[ended..]);
            line = &line[read..];
            written += wrote;
            ended += ends;
            match result {
                // No input is left; the next call takes this as the end of the line.
                ReadRecordResult::InputEmpty => {}
                ReadRecordResult::OutputFull => self.text.resize(2 * self.text.len() + 1, 0),
                ReadRecordResult::OutputEndsFull => self.ends.resize(2 * self.ends.len(), 0),
                ReadRecordResult::Record | ReadRecordResult::End => break,
            }
        }
        self.cells = ended;
        ended
    }

    /// A cell of the line split last; an empty one beyond its end.
    pub fn cell(&self, index: usize) -> &[u8] {
        if index >= self.cells {
            return &[];
        }
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.text[start..self.ends[index]]
    }

    /// All cells of the line split last.
    pub fn cells(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.cells).map(|index| self.cell(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(delimiter: Delimiter, line: &str) -> Vec<String> {
        let mut splitter = Splitter::new(delimiter);
        splitter.split(b"left,from,before");
        splitter.split(line.as_bytes());
        let text = |cell| String::from_utf8_lossy(cell).into_owned();
        splitter.cells().map(text).collect()
    }

    #[test]
    fn splits() {
        assert_eq!(split(Delimiter::Comma, "1,,3"), ["1", "", "3"]);
        assert_eq!(split(Delimiter::Comma, "1,"), ["1", ""]);
        assert_eq!(
            split(Delimiter::Comma, "\"a, b\",\"c\"\"d\""),
            ["a, b", "c\"d"]
        );
        assert_eq!(split(Delimiter::Semicolon, "0,5;9,8"), ["0,5", "9,8"]);
        assert_eq!(split(Delimiter::Tab, "1\r2\t\"open"), ["1\r2", "open"]);
        assert_eq!(split(Delimiter::Comma, &",".repeat(100)).len(), 101);
        assert!(split(Delimiter::Comma, "").is_empty());
    }

    #[test]
    fn found_outside_quotes() {
        assert_eq!(Delimiter::of(b"\"a;b\",c"), Delimiter::Comma);
        assert_eq!(Delimiter::of(b"a,b;c,d"), Delimiter::Semicolon);
        assert_eq!(Delimiter::of(b"a;b\tc"), Delimiter::Tab);
        assert_eq!(Delimiter::of(b"a"), Delimiter::Comma);
    }
}
