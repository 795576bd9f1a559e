//! Lines of bounded length from any reader.
//!
//! All lines share one buffer, and a line without end, as in a damaged file or from a wrong device, is refused
//! before it fills the memory.

use super::error::{Located, RecordingProblem};
use std::collections::VecDeque;
use std::io::{self, BufRead};

/// The longest line, bytes. A table of sensor readings needs some hundred.
pub(super) const LONGEST_LINE: usize = 1 << 20;

const TOO_LONG: &str = "must be at most 1048576 bytes long (write one row of numbers a line)";

/// A source of numbered lines.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    buffer: Vec<u8>,
    number: u64,
    /// Lines that were given back.
    ahead: VecDeque<Kept>,
    /// Whether the rest of a refused line must be skipped.
    is_inside: bool,
}

/// A line without its line end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line<'a> {
    /// From 1.
    pub number: u64,
    pub bytes: &'a [u8],
    /// Whether it had a line end, as opposed to the end of the input.
    pub is_ended: bool,
}

/// A line that was read ahead.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub number: u64,
    pub bytes: Vec<u8>,
    is_ended: bool,
}

impl Line<'_> {
    pub fn keep(&self) -> Kept {
        Kept {
            number: self.number,
            bytes: self.bytes.to_vec(),
            is_ended: self.is_ended,
        }
    }
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Self {
            reader,
            buffer: Vec::new(),
            number: 0,
            ahead: VecDeque::new(),
            is_inside: false,
        }
    }

    /// Gives lines back, which are read once more.
    pub fn give_back(&mut self, lines: Vec<Kept>) {
        self.ahead = lines.into();
    }

    /// The next line that says something, as soon as its end has been read; `None` after the last. The next call
    /// skips the rest of a refused line.
    pub fn next(&mut self) -> Result<Option<Line<'_>>, Located> {
        if let Some(kept) = self.ahead.pop_front() {
            self.buffer = kept.bytes;
            return Ok(Some(Line {
                number: kept.number,
                bytes: &self.buffer,
                is_ended: kept.is_ended,
            }));
        }
        loop {
            let read = self.advance();
            let number = self.number;
            match read.map_err(|problem| (Some(number), problem))? {
                None => return Ok(None),
                Some(_) if is_remark(&self.buffer) => {}
                Some(is_ended) => {
                    let bytes = self.buffer.strip_suffix(b"\r").unwrap_or(&self.buffer);
                    return Ok(Some(Line {
                        number,
                        bytes,
                        is_ended,
                    }));
                }
            }
        }
    }

    /// Reads a line into the buffer; returns whether it had an end.
    fn advance(&mut self) -> Result<Option<bool>, RecordingProblem> {
        while self.is_inside {
            let chunk = available(&mut self.reader)?;
            let end = memchr::memchr(b'\n', chunk);
            self.is_inside = end.is_none() && !chunk.is_empty();
            let taken = end.map_or(chunk.len(), |end| end + 1);
            self.reader.consume(taken);
        }
        self.buffer.clear();
        self.number += 1;
        loop {
            let chunk = available(&mut self.reader)?;
            if chunk.is_empty() {
                let is_line = !self.buffer.is_empty();
                self.number -= u64::from(!is_line);
                return Ok(is_line.then_some(false));
            }
            let end = memchr::memchr(b'\n', chunk);
            let taken = end.unwrap_or(chunk.len());
            if self.buffer.len() + taken > LONGEST_LINE {
                self.is_inside = true;
                self.buffer.clear();
                return Err(RecordingProblem::Simple(TOO_LONG));
            }
            self.buffer.extend_from_slice(&chunk[..taken]);
            self.reader.consume(taken + usize::from(end.is_some()));
            if end.is_some() {
                return Ok(Some(true));
            }
        }
    }
}

/// Whether a line is blank, a comment, or tells a spreadsheet the delimiter.
fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    matches!(line.first(), None | Some(b'#' | b'%')) || line.starts_with(b"sep=")
}

/// The bytes available in the reader; empty at its end.
fn available(reader: &mut impl BufRead) -> io::Result<&[u8]> {
    // Called twice because the borrow checker refuses to return a borrow from inside the loop; the second call
    // is answered from the reader's buffer.
    while let Err(error) = reader.fill_buf() {
        if error.kind() != io::ErrorKind::Interrupted {
            return Err(error);
        }
    }
    reader.fill_buf()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{BufReader, Read};

    fn all(text: &[u8], capacity: usize) -> Vec<(u64, Vec<u8>, bool)> {
        let mut lines = Lines::new(BufReader::with_capacity(capacity, text));
        let mut found = Vec::new();
        while let Some(line) = lines.next().unwrap() {
            found.push((line.number, line.bytes.to_vec(), line.is_ended));
        }
        found
    }

    #[test]
    fn splits_at_any_buffer() {
        for capacity in [1, 2, 3, 64] {
            let found = all(b"a\r\n\nbcd\n# x\n \ne", capacity);
            let expected: [(u64, &[u8], bool); 3] =
                [(1, b"a", true), (3, b"bcd", true), (6, b"e", false)];
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
        assert!(matches!(lines.next(), Err((Some(2), _))));
        let line = lines.next().unwrap().unwrap();
        assert_eq!((line.number, line.bytes), (3, &b"2"[..]));
        assert!(lines.buffer.capacity() <= 2 * LONGEST_LINE);
        assert!(lines.next().unwrap().is_none());
    }
}
