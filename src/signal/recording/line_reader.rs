//! Readings from a pipe, one a line: `acceleration` or `time,acceleration`.

use super::cell::Cell;
use super::lines::{LONGEST_LINE, Lines, NoLine};
use std::io::{self, BufRead};

/// Reads a line at a time, as soon as each is complete, in constant memory.
///
/// Cells are parted by a comma, a semicolon, a tab or blanks; the decimal mark is a point. Blank lines and
/// lines that begin with `#` are passed over, and so is one header line before the first reading. The
/// first reading says whether all have a time. The order of times is not looked at.
///
/// ```
/// use liftsim::signal::recording::LineReader;
///
/// let mut reader = LineReader::new(&b"time,acceleration\n0.01,9.81\n"[..]);
/// let reading = reader.next()?.expect("a line");
/// assert_eq!((reading.time, reading.acceleration), (Some(0.01), 9.81));
/// assert_eq!(reader.number(), 2);
/// assert!(reader.next()?.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct LineReader<R> {
    lines: Lines<R>,
    /// Cells a line, once known.
    cells: Option<usize>,
    is_headed: bool,
}

/// What a line says, in the units of whoever wrote it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineReading {
    /// The first of two cells.
    pub time: Option<f64>,
    /// The last cell.
    pub acceleration: f64,
}

/// Why a line was refused. The next call goes on with the line after it.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    /// No end in sight.
    #[error("line {line}: must be at most {LONGEST_LINE} bytes long (is this a table of numbers?)")]
    TooLong {
        /// From 1.
        line: u64,
    },
    /// A cell that is no number.
    #[error("line {line}: must be `acceleration` or `time,acceleration`, got \"{got}\"")]
    NotNumbers {
        /// From 1.
        line: u64,
        /// As written, shortened.
        got: String,
    },
    /// NaN or an infinity.
    #[error(
        "line {line}: numbers must be finite, got \"{got}\" (leave the line out where nothing was read)"
    )]
    NotFinite {
        /// From 1.
        line: u64,
        /// As written, shortened.
        got: String,
    },
    /// A line of another kind.
    #[error("line {line}: must have {expected} as the first reading had, got {got}", expected = cells(*.expected), got = cells(*.got))]
    Cells {
        /// From 1.
        line: u64,
        /// Cells of the first reading.
        expected: usize,
        /// Cells of this line.
        got: usize,
    },
    /// The pipe broke.
    #[error("line {line}: cannot be read: {source}")]
    Io {
        /// From 1.
        line: u64,
        /// What the system said.
        source: io::Error,
    },
}

fn cells(number: usize) -> String {
    match number {
        1 => "1 number".to_owned(),
        _ => format!("{number} numbers"),
    }
}

impl<R: BufRead> LineReader<R> {
    /// Reads from `reader`.
    pub fn new(reader: R) -> Self {
        Self {
            lines: Lines::new(reader),
            cells: None,
            is_headed: false,
        }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u64 {
        self.lines.number()
    }

    /// The next reading; none at the end of the input.
    ///
    /// # Errors
    /// Where a line is too long or holds anything but one or two finite numbers, or the reader fails.
    #[expect(clippy::should_implement_trait, reason = "an error does not end it")]
    pub fn next(&mut self) -> Result<Option<LineReading>, LineError> {
        loop {
            let number = self.lines.number() + 1;
            let may_be_header = self.cells.is_none() && !self.is_headed;
            let line = match self.lines.next() {
                Ok(Some(line)) => without_mark(line.bytes).trim_ascii(),
                Ok(None) => return Ok(None),
                Err(NoLine::TooLong) => return Err(LineError::TooLong { line: number }),
                Err(NoLine::Io(source)) => {
                    return Err(LineError::Io {
                        line: number,
                        source,
                    });
                }
            };
            if line.is_empty() || line[0] == b'#' {
                continue;
            }
            let (first, second) = split(line);
            let found = (Cell::read(first), second.map(Cell::read));
            let (time, acceleration) = match found {
                (Cell::Number(acceleration), None) => (None, acceleration),
                (Cell::Number(time), Some(Cell::Number(acceleration))) => {
                    (Some(time), acceleration)
                }
                (Cell::NotFinite, _) | (_, Some(Cell::NotFinite)) => {
                    return Err(LineError::NotFinite {
                        line: number,
                        got: shortened(line),
                    });
                }
                _ if may_be_header && is_words(line) => {
                    self.is_headed = true;
                    continue;
                }
                _ => {
                    return Err(LineError::NotNumbers {
                        line: number,
                        got: shortened(line),
                    });
                }
            };
            let got = 1 + usize::from(time.is_some());
            let expected = *self.cells.get_or_insert(got);
            if got != expected {
                return Err(LineError::Cells {
                    line: number,
                    expected,
                    got,
                });
            }
            return Ok(Some(LineReading { time, acceleration }));
        }
    }
}

/// What a header consists of.
fn is_words(line: &[u8]) -> bool {
    line.iter().all(|&c| c >= b' ' || c == b'\t') && line.iter().any(u8::is_ascii_alphabetic)
}

/// The line without the mark that some editors put before UTF-8.
fn without_mark(line: &[u8]) -> &[u8] {
    line.strip_prefix("\u{feff}".as_bytes()).unwrap_or(line)
}

/// The cells before and after the first separator. More than two cells leave a separator in the second,
/// which then is no number.
#[inline]
fn split(line: &[u8]) -> (&[u8], Option<&[u8]>) {
    let is_separator = |c: &u8| matches!(c, b',' | b';' | b'\t' | b' ');
    let Some(end) = line.iter().position(is_separator) else {
        return (line, None);
    };
    let rest = line[end..].trim_ascii_start();
    let rest = match rest {
        [b',' | b';', rest @ ..] => rest,
        _ => rest,
    };
    (&line[..end], Some(rest))
}

/// The beginning of what was written, in print.
pub(super) fn shortened(text: &[u8]) -> String {
    const SHOWN: usize = 40;
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * SHOWN)]);
    let mut short: String = text
        .chars()
        .take(SHOWN)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(SHOWN).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<String> {
        let mut reader = LineReader::new(text.as_bytes());
        let mut found = Vec::new();
        loop {
            found.push(match reader.next() {
                Ok(None) => return found,
                Ok(Some(LineReading {
                    time: None,
                    acceleration,
                })) => acceleration.to_string(),
                Ok(Some(LineReading {
                    time: Some(time),
                    acceleration,
                })) => {
                    format!("{time} {acceleration}")
                }
                Err(error) => error.to_string(),
            });
        }
    }

    #[test]
    fn one_or_two_cells() {
        assert_eq!(
            all("9.5\n\n 9.25 \r\n# rest\n9.75"),
            ["9.5", "9.25", "9.75"]
        );
        for separator in [",", ";", "\t", "  ", " , ", "\t\t"] {
            let text = format!("\u{feff}t{separator}a\n0.5{separator}1\n1{separator}-2e-1\n");
            assert_eq!(all(&text), ["0.5 1", "1 -0.2"], "{separator:?}");
        }
    }

    #[test]
    fn refusals_do_not_end_it() {
        assert_eq!(
            all("time,a\n1,2\nx,3\n4,nan\n5\n6,7,8\n9,\n10,11"),
            [
                "1 2",
                "line 3: must be `acceleration` or `time,acceleration`, got \"x,3\"",
                "line 4: numbers must be finite, got \"4,nan\" (leave the line out where nothing was read)",
                "line 5: must have 2 numbers as the first reading had, got 1 number",
                "line 6: must be `acceleration` or `time,acceleration`, got \"6,7,8\"",
                "line 7: must be `acceleration` or `time,acceleration`, got \"9,\"",
                "10 11",
            ]
        );
        assert!(all("\u{1}a\n1\n")[0].starts_with("line 1: must be"));
        let long = format!("1\n{}\n2", "9".repeat(LONGEST_LINE + 1));
        assert!(all(&long)[1].starts_with("line 2: must be at most 1048576 bytes long"));
        assert_eq!(all(&long)[2], "2");
    }
}
