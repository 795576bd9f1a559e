//! Readings from a pipe, one per line: `acceleration` or `time,acceleration`, followed on request by whether
//! the drum turns: 0 or 1.

use super::cell::Cell;
use super::lines::{LONGEST_LINE, Lines, NoLine};
use std::io::{self, BufRead};

/// Reads each line as soon as it is complete, in constant memory.
///
/// Cells are separated by a comma, a semicolon, a tab or blanks; the decimal mark is a point. Blank lines,
/// lines that begin with `#`, and one header line before the first reading are skipped. The first reading
/// decides whether all have a time. The order of times is not checked.
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
    /// Whether the last cell is the drum.
    has_drum: bool,
    /// Cells per line, once known.
    cells: Option<usize>,
    is_headed: bool,
}

/// The reading of a line, in the units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineReading {
    /// The first cell, if the line has a time.
    pub time: Option<f64>,
    /// The last cell, or the last before the drum.
    pub acceleration: f64,
    /// Whether the drum turns, if the line has it.
    pub drum_turns: Option<bool>,
}

/// Why a line was refused. The next call continues with the next line.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    /// A line that is too long.
    #[error("line {line}: must be at most {LONGEST_LINE} bytes long (send one reading per line)")]
    TooLong {
        /// The number of the line, from 1.
        line: u64,
    },
    /// A cell that is not a number.
    #[error("line {line}: must be {}, got \"{got}\"", layout(*.has_drum))]
    NotNumbers {
        /// The number of the line, from 1.
        line: u64,
        /// Whether lines end with the drum.
        has_drum: bool,
        /// The text, shortened.
        got: String,
    },
    /// NaN or an infinity.
    #[error(
        "line {line}: numbers must be finite, got \"{got}\" (leave the line out where nothing was read)"
    )]
    NotFinite {
        /// The number of the line, from 1.
        line: u64,
        /// The text, shortened.
        got: String,
    },
    /// A line with a different number of cells.
    #[error("line {line}: must have {expected} as the first reading had, got {got}", expected = cells(*.expected), got = cells(*.got))]
    Cells {
        /// The number of the line, from 1.
        line: u64,
        /// Cells of the first reading.
        expected: usize,
        /// Cells of this line.
        got: usize,
    },
    /// The input cannot be read.
    #[error("line {line}: cannot be read: {error}")]
    Io {
        /// The number of the line, from 1.
        line: u64,
        /// The error of the system.
        error: io::Error,
    },
}

fn layout(has_drum: bool) -> &'static str {
    if has_drum {
        "`acceleration,drum` or `time,acceleration,drum`, the drum 0 or 1"
    } else {
        "`acceleration` or `time,acceleration`"
    }
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
            has_drum: false,
            cells: None,
            is_headed: false,
        }
    }

    /// Reads from `reader`, where every line ends with a cell for the drum: 0 or 1.
    pub fn with_drum(reader: R) -> Self {
        Self {
            has_drum: true,
            ..Self::new(reader)
        }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u64 {
        self.lines.number()
    }

    /// The next reading; `None` at the end of the input.
    ///
    /// # Errors
    /// If a line is too long or holds anything but one or two finite numbers, or the reader fails.
    #[expect(clippy::should_implement_trait, reason = "an error does not end it")]
    pub fn next(&mut self) -> Result<Option<LineReading>, LineError> {
        loop {
            let number = self.lines.number() + 1;
            let may_be_header = self.cells.is_none() && !self.is_headed;
            let line = match self.lines.next() {
                Ok(Some(line)) => without_mark(line.bytes).trim_ascii(),
                Ok(None) => return Ok(None),
                Err(NoLine::TooLong) => return Err(LineError::TooLong { line: number }),
                Err(NoLine::Io(error)) => {
                    return Err(LineError::Io {
                        line: number,
                        error,
                    });
                }
            };
            if line.is_empty() || line[0] == b'#' {
                continue;
            }
            let reading = match read(line, self.has_drum) {
                Ok(reading) => reading,
                Err(Cell::NotFinite) => {
                    return Err(LineError::NotFinite {
                        line: number,
                        got: shorten(line),
                    });
                }
                Err(_) if may_be_header && is_words(line) => {
                    self.is_headed = true;
                    continue;
                }
                Err(_) => {
                    return Err(LineError::NotNumbers {
                        line: number,
                        has_drum: self.has_drum,
                        got: shorten(line),
                    });
                }
            };
            let got = 1 + usize::from(reading.time.is_some()) + usize::from(self.has_drum);
            let expected = *self.cells.get_or_insert(got);
            if got != expected {
                return Err(LineError::Cells {
                    line: number,
                    expected,
                    got,
                });
            }
            return Ok(Some(reading));
        }
    }
}

/// The reading of a line; the error is the first cell that is not a finite number, or a cell too many.
#[inline]
fn read(line: &[u8], has_drum: bool) -> Result<LineReading, Cell> {
    let number = |cell: &[u8]| match Cell::read(cell) {
        Cell::Number(number) => Ok(number),
        other => Err(other),
    };
    let (first, rest) = split(line);
    let first = number(first)?;
    let (time, acceleration, drum) = match rest {
        None => (None, first, None),
        Some(rest) if !has_drum => (Some(first), number(rest)?, None),
        Some(rest) => match split(rest) {
            (drum, None) => (None, first, Some(number(drum)?)),
            (acceleration, Some(drum)) => (Some(first), number(acceleration)?, Some(number(drum)?)),
        },
    };
    let drum_turns = match drum {
        None if has_drum => return Err(Cell::Text),
        None => None,
        Some(0.0) => Some(false),
        Some(1.0) => Some(true),
        Some(_) => return Err(Cell::Text),
    };
    Ok(LineReading {
        time,
        acceleration,
        drum_turns,
    })
}

/// Whether a line consists of words, as a header does.
fn is_words(line: &[u8]) -> bool {
    line.iter().all(|&c| c >= b' ' || c == b'\t') && line.iter().any(u8::is_ascii_alphabetic)
}

/// The line without the byte order mark of UTF-8.
fn without_mark(line: &[u8]) -> &[u8] {
    line.strip_prefix("\u{feff}".as_bytes()).unwrap_or(line)
}

/// The parts before and after the first separator. A cell too many leaves a separator in the last part, which
/// then is not a number.
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

/// The beginning of a text, with control characters escaped.
pub(super) fn shorten(text: &[u8]) -> String {
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
                    ..
                })) => acceleration.to_string(),
                Ok(Some(LineReading {
                    time: Some(time),
                    acceleration,
                    ..
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
    fn the_drum_stands_last() {
        let text = "time,acceleration,drum\n0.5,9.8,1\n1,9.7,0\n2,9.7\n3,9.7,2\n";
        let mut reader = LineReader::with_drum(text.as_bytes());
        let mut next = || {
            reader
                .next()
                .map(|reading| reading.and_then(|r| r.drum_turns))
        };
        assert_eq!(next().unwrap(), Some(true));
        assert_eq!(next().unwrap(), Some(false));
        assert!(next().is_err());
        let refused = next().unwrap_err().to_string();
        assert!(refused.contains("the drum 0 or 1"), "{refused}");
        let mut bare = LineReader::with_drum(&b"9.8 1\n9.8\n"[..]);
        let reading = bare.next().unwrap().unwrap();
        assert_eq!((reading.time, reading.acceleration), (None, 9.8));
        assert!(bare.next().is_err());
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
