//! The rows of a file as columns in memory, in one pass.

use super::error::{Located, RecordingError, RecordingProblem};
use super::layout::{Input, Quantity};
use super::lines::{Line, Lines};
use super::moment::When;
use super::parser::Parser;
use super::reading::Reading;
use super::source::{Source, Text};
use super::unit::TimeUnit;

/// The most memory taken for a recording, bytes.
const MOST_MEMORY: f64 = 2e9;

/// What was read of a file: times in s, accelerations in the unit of the file.
#[derive(Debug)]
pub(super) struct Columns {
    pub parser: Parser,
    pub times: Vec<f64>,
    /// In the order of the layout; NaN where nothing was read.
    pub axes: Vec<Vec<f64>>,
    pub skipped: Skipped,
    /// Rows seen, kept or not.
    rows: u64,
    /// The memory of a row, bytes: columns may hold twice what is in them while they grow; samples come to them in the end.
    row_bytes: f64,
    /// The first and the last time seen, kept or not, s.
    seen: Option<(f64, f64)>,
    /// From when to when rows are kept, s, once the clock is known.
    window: Option<(f64, f64)>,
}

/// Rows that gave no sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Skipped {
    /// A cell was NaN.
    pub missing: u64,
    /// All were blank.
    pub blank: u64,
    /// The line of the first repeated time.
    pub first_repeat: Option<u64>,
    /// The line at which the file is cut off.
    pub cut: Option<u64>,
}

impl Columns {
    /// Reads up to the first row.
    ///
    /// # Errors
    /// If there is no table with such columns.
    pub fn begin(
        source: &Source,
        reading: &Reading,
        quantity: Quantity,
    ) -> Result<(Parser, Lines<Text>), RecordingError> {
        let mut lines = Lines::new(source.text()?);
        let begun = Parser::begin(&mut lines, source.name(), reading, Input::File(quantity));
        let blame = |(line, problem)| source.error(line, problem);
        begun.map(|parser| (parser, lines)).map_err(blame)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it is no table of numbers, its times go back, or it is too large.
    pub fn read(
        source: &Source,
        reading: &Reading,
        quantity: Quantity,
    ) -> Result<Self, RecordingError> {
        if let Some(rate) = reading.rate
            && !(1e-3..=1e7).contains(&rate)
        {
            let rule = "rate must lie in [0.001, 1e7] Hz";
            return Err(source.error(None, RecordingProblem::must(rule, rate, "--rate HZ")));
        }
        let (parser, mut lines) = Self::begin(source, reading, quantity)?;
        let blame = |(line, problem)| source.error(line, problem);
        let across = if reading.across { 48.0 } else { 0.0 };
        let mut columns = Self {
            row_bytes: 16.0 * (1.0 + parser.layout.axes.len() as f64) + 24.0 + across,
            times: Vec::new(),
            axes: vec![Vec::new(); parser.layout.axes.len()],
            parser,
            skipped: Skipped::default(),
            rows: 0,
            seen: None,
            window: None,
        };
        let is_part = reading.from.or(reading.to).is_some();
        while let Some(line) = lines.next().map_err(blame)? {
            if columns.rows == 0 && !is_part {
                let rows = source.size() as f64 / (line.bytes.len() + 1) as f64;
                let fits = columns.check_memory(rows);
                fits.map_err(|problem| source.error(None, problem))?;
                columns.reserve(rows as usize);
            }
            if !columns.take(line, reading).map_err(blame)? {
                break;
            }
        }
        let checked = columns.check(reading);
        checked.map_err(|problem| source.error(None, problem))?;
        Ok(columns)
    }

    /// Takes a line; returns whether there may be more to take.
    #[inline]
    fn take(&mut self, line: Line, reading: &Reading) -> Result<bool, Located> {
        let located = |problem| (Some(line.number), problem);
        let Some(row) = self
            .parser
            .read(line.bytes, line.is_ended)
            .map_err(located)?
        else {
            self.skipped.cut = Some(line.number);
            return Ok(false);
        };
        let time = match reading.rate {
            Some(rate) => Some(self.rows as f64 / rate),
            None => row.time,
        };
        self.rows += 1;
        let is_empty = row.axes.iter().all(Option::is_none);
        self.skipped.missing += u64::from(row.is_missing && is_empty);
        self.skipped.blank += u64::from(!row.is_missing && (is_empty || time.is_none()));
        let Some(time) = time else {
            return Ok(true);
        };
        self.seen = Some((self.seen.map_or(time, |(first, _)| first), time));
        let (from, to) = match self.window {
            Some(window) => window,
            None => {
                let zero = self.parser.clock.zero().filter(|_| reading.rate.is_none());
                let at = |time: Option<When>, end| time.map_or(Ok(end), |time| time.seconds(zero));
                let from = at(reading.from, f64::NEG_INFINITY).map_err(located)?;
                let to = at(reading.to, f64::INFINITY).map_err(located)?;
                *self.window.insert((from, to))
            }
        };
        if time > to {
            return Ok(false);
        }
        if is_empty || time < from {
            return Ok(true);
        }
        if let Some(&from) = self.times.last() {
            if time < from {
                return Err(located(RecordingProblem::TimeBack { from, to: time }));
            }
            if time == from {
                self.skipped.first_repeat.get_or_insert(line.number);
            }
        }
        self.times.push(time);
        for (column, value) in self.axes.iter_mut().zip(row.axes) {
            column.push(value.unwrap_or(f64::NAN));
        }
        if self.times.len().is_power_of_two() {
            self.check_memory(self.times.len() as f64)
                .map_err(located)?;
        }
        Ok(true)
    }

    fn reserve(&mut self, rows: usize) {
        self.times.reserve(rows);
        self.axes.iter_mut().for_each(|axis| axis.reserve(rows));
    }

    fn check_memory(&self, rows: f64) -> Result<(), RecordingProblem> {
        check_memory(rows, self.row_bytes)
    }

    /// Checks the rate of the clock. If no unit is stated, seconds are assumed, and a rate that no such sensor has
    /// is refused. A stated unit is refused only for impossible rates.
    pub fn check_clock(&self, rate: f64) -> Result<(), RecordingProblem> {
        let Some(time) = self.parser.layout.time else {
            return Ok(());
        };
        let is_stated = self.parser.clock.is_unit_stated();
        let believed = if is_stated { 1e-3..=1e7 } else { 2.0..=5e4 };
        if believed.contains(&rate) {
            return Ok(());
        }
        let unit = self.parser.clock.unit();
        let a_tick = rate / unit.per_second();
        let is_usual = |unit: &TimeUnit| (2.0..=5e4).contains(&(a_tick * unit.per_second()));
        Err(RecordingProblem::Rate {
            column: self.parser.layout.columns[time].name.clone(),
            unit,
            rate,
            likely: TimeUnit::NAMES
                .map(|(unit, _)| unit)
                .into_iter()
                .find(is_usual),
        })
    }

    fn check(&self, reading: &Reading) -> Result<(), RecordingProblem> {
        let got = self.times.len() as u64;
        let is_part = reading.from.or(reading.to).is_some();
        match (self.seen, self.window) {
            (Some((first, last)), Some((from, to))) if got < 2 && is_part => {
                Err(RecordingProblem::NothingLeft {
                    from: from.max(first),
                    to: to.min(last),
                    got,
                    first,
                    last,
                })
            }
            _ => Ok(()),
        }
    }
}

/// Refuses what would not fit.
pub(super) fn check_memory(rows: f64, bytes: f64) -> Result<(), RecordingProblem> {
    if rows * bytes > MOST_MEMORY {
        let gigabytes = rows * bytes / 1e9;
        return Err(RecordingProblem::TooLarge { gigabytes });
    }
    Ok(())
}
