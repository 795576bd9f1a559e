//! Lines of bounded length from any reader.
//!
//! All lines share one buffer, and a line without end, as in a damaged file or from a wrong device, is refused
//! before it fills the memory.

use std::io::{self, BufRead};

/// The longest line, bytes. A table of sensor readings needs some hundred.
pub(super) const LONGEST_LINE: usize = 1 << 20;

/// A source of numbered lines.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    buffer: Vec<u8>,
    number: u64,
    /// Whether the rest of a refused line must be skipped.
    is_inside: bool,
}

/// A line without its line end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line<'a> {
    pub bytes: &'a [u8],
    /// Whether it had a line end, as opposed to the end of the input.
    pub is_ended: bool,
}

/// Why a line cannot be read.
#[derive(Debug)]
pub(super) enum NoLine {
    /// It is longer than [`LONGEST_LINE`].
    TooLong,
    /// The reader failed.
    Io(io::Error),
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Self {
            reader,
            buffer: Vec::new(),
            number: 0,
            is_inside: false,
        }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The next line as soon as its end has been read; `None` after the last. The next call skips the rest of a
    /// refused line.
    pub fn next(&mut self) -> Result<Option<Line<'_>>, NoLine> {
        if self.is_inside {
            self.pass_over()?;
        }
        self.buffer.clear();
        self.number += 1;
        let is_ended = loop {
            let chunk = available(&mut self.reader)?;
            if chunk.is_empty() {
                break false;
            }
            let end = memchr::memchr(b'\n', chunk);
            let taken = end.unwrap_or(chunk.len());
            if self.buffer.len() + taken > LONGEST_LINE {
                self.is_inside = true;
                self.buffer.clear();
                return Err(NoLine::TooLong);
            }
            self.buffer.extend_from_slice(&chunk[..taken]);
            self.reader.consume(taken + usize::from(end.is_some()));
            if end.is_some() {
                break true;
            }
        };
        if !is_ended && self.buffer.is_empty() {
            self.number -= 1;
            return Ok(None);
        }
        let bytes = self.buffer.strip_suffix(b"\r").unwrap_or(&self.buffer);
        Ok(Some(Line { bytes, is_ended }))
    }

    fn pass_over(&mut self) -> Result<(), NoLine> {
        loop {
            let chunk = available(&mut self.reader)?;
            let end = memchr::memchr(b'\n', chunk);
            let (taken, is_last) = (end.map_or(chunk.len(), |end| end + 1), chunk.is_empty());
            self.reader.consume(taken);
            if end.is_some() || is_last {
                self.is_inside = false;
                return Ok(());
            }
        }
    }
}

/// The bytes available in the reader; empty at its end.
fn available(reader: &mut impl BufRead) -> Result<&[u8], NoLine> {
    // Called twice because the borrow checker refuses to return a borrow from inside the loop; the second call
    // is answered from the reader's buffer.
    loop {
        match reader.fill_buf() {
            Ok(_) => break,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(NoLine::Io(error)),
        }
    }
    reader.fill_buf().map_err(NoLine::Io)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{BufReader, Read};

    fn all(text: &[u8], capacity: usize) -> Vec<(u64, Vec<u8>, bool)> {
        let mut lines = Lines::new(BufReader::with_capacity(capacity, text));
        let mut found = Vec::new();
        while let Some(line) = lines.next().unwrap() {
            let (bytes, is_ended) = (line.bytes.to_vec(), line.is_ended);
            found.push((lines.number(), bytes, is_ended));
        }
        found
    }

    #[test]
    fn splits_at_any_buffer() {
        for capacity in [1, 2, 3, 64] {
            let found = all(b"a\r\n\nbcd\ne", capacity);
            let expected: [(u64, &[u8], bool); 4] = [
                (1, b"a", true),
                (2, b"", true),
                (3, b"bcd", true),
                (4, b"e", false),
            ];
            assert_eq!(
                found,
                expected.map(|(n, line, end)| (n, line.to_vec(), end))
            );
        }
        assert!(all(b"", 4).is_empty());
        assert_eq!(all(b"a\n", 4).len(), 1);
    }

    #[test]
    fn a_line_without_end_is_refused_and_passed_over() {
        let endless = io::repeat(b'7').take(3 * LONGEST_LINE as u64);
        let text = b"1\n".chain(endless).chain(&b"\n2\n"[..]);
        let mut lines = Lines::new(BufReader::new(text));
        assert!(lines.next().unwrap().is_some());
        assert!(matches!(lines.next(), Err(NoLine::TooLong)));
        assert_eq!(lines.number(), 2);
        assert_eq!(lines.next().unwrap().unwrap().bytes, b"2");
        assert_eq!(lines.number(), 3);
        assert!(lines.buffer.capacity() <= 2 * LONGEST_LINE);
        assert!(lines.next().unwrap().is_none());
    }
}
