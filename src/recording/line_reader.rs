//! Readings from a pipe, one per line: `acceleration` or `time,acceleration`, followed on request by whether
//! the drum turns: 0 or 1.

use super::cell::shorten;
use super::error::{Located, RecordingProblem};
use super::layout::Input;
use super::lines::Lines;
use super::moment::Moment;
use super::parser::Parser;
use super::reading::Reading;
use super::unit::Unit;
use serde::{Deserialize, Serialize};
use std::io::BufRead;

/// Reads each line as soon as it is complete, in constant memory.
///
/// Lines are read as those of a file: the same delimiters, decimal marks, headers, columns, units and dates. But
/// a stream has one acceleration, and every line has all its cells. The first reading decides whether all have a
/// time. The order of times is not checked.
///
/// ```
/// use liftsim::recording::{LineReader, Reading};
///
/// let mut reader = LineReader::new(&b"time (ms),acceleration (g)\n10,1.0\n"[..], &Reading::default());
/// let reading = reader.next()?.expect("a line");
/// assert_eq!((reading.time, reading.acceleration), (Some(0.01), 9.80665));
/// assert_eq!(reader.number(), 2);
/// assert!(reader.next()?.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct LineReader<R> {
    lines: Lines<R>,
    options: Reading,
    /// Whether the last cell is the drum.
    has_drum: bool,
    parser: Option<Parser>,
    number: u64,
}

/// The columns of a stream, and what its earlier lines have shown of them.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StreamColumns {
    parser: Parser,
    options: Reading,
    has_drum: bool,
}

impl StreamColumns {
    /// Whether the last cell is the drum.
    pub fn has_drum(&self) -> bool {
        self.has_drum
    }

    /// The options with which they were found.
    pub fn options(&self) -> &Reading {
        &self.options
    }
}

/// The reading of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineReading {
    /// s, if the line has a time.
    pub time: Option<f64>,
    /// m/s², up positive.
    pub acceleration: f64,
    /// Whether the drum turns, if the line has it.
    pub drum_turns: Option<bool>,
}

/// Why a line was refused. The next call continues with the next line.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct LineError {
    /// The number of the line, from 1.
    pub line: u64,
    /// What is wrong with it.
    pub problem: RecordingProblem,
}

impl LineError {
    /// Whether the input itself cannot be read.
    pub fn is_io(&self) -> bool {
        matches!(self.problem, RecordingProblem::Unreadable(_))
    }
}

impl<R: BufRead> LineReader<R> {
    /// Reads from `reader`. Of the options those for columns, units and an axis count.
    pub fn new(reader: R, options: &Reading) -> Self {
        Self {
            lines: Lines::new(reader),
            options: options.clone(),
            has_drum: false,
            parser: None,
            number: 0,
        }
    }

    /// Reads from `reader`, where every line ends with a cell for the drum: 0 or 1.
    pub fn with_drum(reader: R, options: &Reading) -> Self {
        Self {
            has_drum: true,
            ..Self::new(reader, options)
        }
    }

    /// Goes on with a stream whose columns another reader has found, unless it begins with a header that they do not fit.
    /// Where that reader left it within a line, what is left of that is passed over.
    ///
    /// # Errors
    /// If the reader fails.
    pub fn resume(mut self, columns: StreamColumns, within_line: bool) -> Result<Self, LineError> {
        let unread = |(line, problem): Located| LineError {
            line: line.unwrap_or(0),
            problem,
        };
        self.options = columns.options;
        self.has_drum = columns.has_drum;
        if within_line {
            self.lines.next().map_err(unread)?;
        }
        let first = self.lines.next().map_err(unread)?;
        if let Some(line) = first.map(|line| line.keep()) {
            let parser = columns.parser;
            let read = reading(
                &mut parser.clone(),
                &line.bytes,
                self.has_drum,
                &self.options,
            );
            if read.is_ok() || !may_be_header(&line.bytes) {
                self.parser = Some(parser);
            }
            self.lines.give_back(vec![line]);
        }
        Ok(self)
    }

    /// The columns of the stream, once its first line was read.
    pub fn columns(&self) -> Option<StreamColumns> {
        self.parser.clone().map(|parser| StreamColumns {
            parser,
            options: self.options.clone(),
            has_drum: self.has_drum,
        })
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The moment of time 0, where the lines have dates.
    pub fn zero(&self) -> Option<Moment> {
        self.parser.as_ref().and_then(|parser| parser.clock.zero())
    }

    /// The next reading; `None` at the end of the input.
    ///
    /// # Errors
    /// If a line is too long or is not a reading, or the reader fails.
    #[expect(clippy::should_implement_trait, reason = "an error does not end it")]
    pub fn next(&mut self) -> Result<Option<LineReading>, LineError> {
        self.advance().map_err(|(line, problem)| {
            self.number = line.unwrap_or(self.number);
            LineError {
                line: self.number,
                problem,
            }
        })
    }

    fn advance(&mut self) -> Result<Option<LineReading>, Located> {
        let (has_drum, options) = (self.has_drum, &self.options);
        if self.parser.is_none() {
            match Parser::begin(&mut self.lines, "", options, Input::Stream { has_drum }) {
                Err((_, RecordingProblem::Empty | RecordingProblem::HeaderOnly)) => {
                    return Ok(None);
                }
                begun => self.parser = Some(begun?),
            }
        }
        let parser = self.parser.as_mut().expect("it has begun");
        let Some(line) = self.lines.next()? else {
            return Ok(None);
        };
        self.number = line.number;
        let read = reading(parser, line.bytes, has_drum, options);
        read.map(Some)
            .map_err(|problem| (Some(line.number), problem))
    }
}

/// Whether a line begins with a word.
fn may_be_header(line: &[u8]) -> bool {
    let line = line.strip_prefix("\u{feff}".as_bytes()).unwrap_or(line);
    let mut word = line.iter().skip_while(|c| b" \t\"'".contains(c));
    word.next()
        .is_some_and(|c| !(c.is_ascii_digit() || b"+-.,;".contains(c)))
}

#[inline]
fn reading(
    parser: &mut Parser,
    line: &[u8],
    has_drum: bool,
    options: &Reading,
) -> Result<LineReading, RecordingProblem> {
    let (line, drum_turns) = if has_drum {
        let (line, turns) = without_drum(parser, line)?;
        (line, Some(turns))
    } else {
        (line, None)
    };
    let row = parser
        .read(line, true)?
        .expect("a whole line is not cut off");
    parser.check_whole(line, &row)?;
    let unit = parser.layout.unit.unwrap_or(Unit::MetresPerSecondSquared);
    Ok(LineReading {
        time: row.time,
        acceleration: unit.convert(row.axes[0].unwrap_or_default()) * options.sign(),
        drum_turns,
    })
}

const DRUM: &str = "must end with a cell for the drum, 0 or 1";

/// The line before its last cell, and whether that says that the drum turns.
fn without_drum<'a>(
    parser: &mut Parser,
    line: &'a [u8],
) -> Result<(&'a [u8], bool), RecordingProblem> {
    let line = line.trim_ascii_end();
    let cells = parser.splitter.split(line);
    let cell = parser.splitter.cell(line, cells - 1);
    let refused = || {
        let got = format!("\"{}\"", shorten(cell));
        RecordingProblem::must(DRUM, got, "leave out --expected-moving")
    };
    let number = std::str::from_utf8(cell)
        .ok()
        .and_then(|cell| cell.parse().ok());
    let turns = match number {
        Some(0.0) => false,
        Some(1.0) => true,
        _ => return Err(refused()),
    };
    let before = parser.splitter.before(cells - 1).ok_or_else(refused)?;
    Ok((&line[..before], turns))
}

#[cfg(test)]
mod tests {
    use super::super::lines::LONGEST_LINE;
    use super::*;

    fn all(text: &str) -> Vec<String> {
        let mut reader = LineReader::new(text.as_bytes(), &Reading::default());
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
        let mut reader = LineReader::with_drum(text.as_bytes(), &Reading::default());
        let mut next = || {
            reader
                .next()
                .map(|reading| reading.and_then(|r| r.drum_turns))
        };
        assert_eq!(next().unwrap(), Some(true));
        assert_eq!(next().unwrap(), Some(false));
        assert!(next().is_err());
        let refused = next().unwrap_err().to_string();
        assert!(
            refused.contains("for the drum, 0 or 1, got \"2\""),
            "{refused}"
        );
        let mut bare = LineReader::with_drum(&b"9.8 1\n9.8\n"[..], &Reading::default());
        let reading = bare.next().unwrap().unwrap();
        assert_eq!((reading.time, reading.acceleration), (None, 9.8));
        assert!(bare.next().is_err());
    }

    /// Headers, columns and units as in a file.
    #[test]
    fn read_as_a_file() {
        let text = "# log\nn;time (ms);acc (mg)\n1;10;1000\n2;20;500,5\n";
        assert_eq!(all(text), ["0.01 9.80665", "0.02 4.908228325"]);
        assert_eq!(
            all("14:23:00.5 -> 9.5\n14:23:01 -> 9.25\n"),
            ["51780.5 9.5", "51781 9.25"]
        );
        assert_eq!(all("1385337600000,9.5\n")[0], "1385337600 9.5");
        assert!(all("{\"t\": 1}\n")[0].contains("must be `acceleration` or"));
        assert!(
            all("time,x,y,z\n0,1,2,3\n")[0].contains("must have one acceleration, got several")
        );
        let reading = Reading {
            axis: "-z".parse().unwrap(),
            ..Reading::default()
        };
        let mut reader = LineReader::new(&b"time,x,y,z\n0,1,2,3\n"[..], &reading);
        assert_eq!(reader.next().unwrap().unwrap().acceleration, -3.0);
    }

    #[test]
    fn refusals_do_not_end_it() {
        assert_eq!(
            all("time,a\n1,2\nx,3\n4,nan\n5\n6,7,8\n9,\n10,11"),
            [
                "1 2",
                "line 3: column \"time\": must be a number, got \"x\" (write times as numbers, or all as \
                 2013-11-25T12:30:00.005Z)",
                "line 4: column \"a\": must be finite, got \"nan\" (leave the row out where nothing was read)",
                "line 5: must have 2 cells as the first row has, got 1",
                "line 6: must have 2 cells as the first row has, got 3 (write decimal points, or quote cells with \
                 decimal commas)",
                "line 7: column \"a\": must be finite, got nothing (leave the row out where nothing was read)",
                "10 11",
            ]
        );
        assert!(all("\u{1}a\n1\n")[0].starts_with("line 1: holds bytes that are not text"));
        let long = format!("1\n{}\n2", "9".repeat(LONGEST_LINE + 1));
        assert!(all(&long)[1].starts_with("line 2: must be at most 1048576 bytes long"));
        assert_eq!(all(&long)[2], "2");
    }
}
