//! The rows of a file as columns in memory, in one pass.

use super::clock::Clock;
use super::error::{RecordingError, RecordingProblem};
use super::head::is_remark;
use super::layout::{Input, Layout};
use super::lines::Lines;
use super::parser::{Parser, Row};
use super::reading::Reading;
use super::source::Source;
use super::unit::TimeUnit;

/// The most memory taken for a recording, bytes.
const MOST_MEMORY: f64 = 2e9;

/// What was read of a file: times in s, accelerations in the unit of the file.
#[derive(Debug)]
pub(super) struct Columns {
    pub layout: Layout,
    pub clock: Clock,
    pub times: Vec<f64>,
    /// In the order of the layout; NaN where nothing was read.
    pub axes: Vec<Vec<f64>>,
    pub skipped: Skipped,
    /// Rows seen, kept or not.
    rows: u64,
    /// The last time seen, kept or not, s.
    last: Option<f64>,
    /// The first time seen, s.
    first: f64,
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
    /// Reads a file.
    ///
    /// # Errors
    /// If it is no table of numbers, its times go back, or it is too large.
    pub fn read(source: &Source, reading: &Reading) -> Result<Self, RecordingError> {
        if let Some(rate) = reading.rate
            && !(1e-3..=1e7).contains(&rate)
        {
            return Err(source.error(None, RecordingProblem::RowRate(rate)));
        }
        let mut lines = Lines::new(source.text()?);
        let begun = Parser::begin(&mut lines, source.name(), reading, Input::File);
        let (mut parser, kept) = begun.map_err(|(line, problem)| source.error(line, problem))?;
        let mut columns = Self {
            clock: Clock::default(),
            times: Vec::new(),
            axes: vec![Vec::new(); parser.layout.axes.len()],
            layout: parser.layout.clone(),
            skipped: Skipped::default(),
            rows: 0,
            last: None,
            first: 0.0,
        };
        let is_part = reading.from.is_some() || reading.to.is_some();
        if let (Some(row), false) = (kept.last(), is_part) {
            let rows = source.size() as f64 / (row.bytes.len() + 1) as f64;
            columns
                .check_memory(rows)
                .map_err(|problem| source.error(None, problem))?;
        }
        let mut goes_on = true;
        for line in &kept {
            let taken = columns.take(
                &mut parser,
                &line.bytes,
                line.is_ended,
                line.number,
                reading,
            );
            goes_on &= taken.map_err(|problem| source.error(Some(line.number), problem))?;
        }
        while goes_on {
            let number = lines.number() + 1;
            let taken = match lines.next() {
                Ok(Some(line)) if is_remark(line.bytes) => Ok(true),
                Ok(Some(line)) => {
                    columns.take(&mut parser, line.bytes, line.is_ended, number, reading)
                }
                Ok(None) => Ok(false),
                Err(reason) => Err(reason.into()),
            };
            goes_on = taken.map_err(|problem| source.error(Some(number), problem))?;
        }
        columns.clock = parser.clock;
        columns
            .check(reading)
            .map_err(|problem| source.error(None, problem))?;
        Ok(columns)
    }

    /// Takes a line; returns whether there may be more to take.
    #[inline]
    fn take(
        &mut self,
        parser: &mut Parser,
        line: &[u8],
        is_ended: bool,
        number: u64,
        reading: &Reading,
    ) -> Result<bool, RecordingProblem> {
        let Some(row) = parser.read(line, is_ended)? else {
            self.skipped.cut = Some(number);
            return Ok(false);
        };
        let Row {
            axes, is_missing, ..
        } = row;
        let time = match reading.rate {
            Some(rate) => Some(self.rows as f64 / rate),
            None => row.time,
        };
        self.rows += 1;
        if self.last.is_none() {
            self.first = time.unwrap_or(0.0);
        }
        let is_empty = axes.iter().all(Option::is_none);
        self.skipped.missing += u64::from(is_missing && is_empty);
        self.skipped.blank += u64::from(!is_missing && (is_empty || time.is_none()));
        let Some(time) = time else {
            return Ok(true);
        };
        self.last = Some(time);
        if reading.to.is_some_and(|to| time > to) {
            return Ok(false);
        }
        if is_empty || reading.from.is_some_and(|from| time < from) {
            return Ok(true);
        }
        match self.times.last() {
            Some(&from) if time < from => {
                return Err(RecordingProblem::TimeBack { from, to: time });
            }
            Some(&from) if time == from => {
                self.skipped.first_repeat.get_or_insert(number);
            }
            _ => {}
        }
        self.times.push(time);
        for (column, value) in self.axes.iter_mut().zip(axes) {
            column.push(value.unwrap_or(f64::NAN));
        }
        if self.times.len().is_power_of_two() {
            self.check_memory(self.times.len() as f64)?;
        }
        Ok(true)
    }

    /// Columns may hold twice what is in them while they grow; samples come to them in the end.
    fn check_memory(&self, rows: f64) -> Result<(), RecordingProblem> {
        check_memory(rows, 16.0 * (1.0 + self.axes.len() as f64) + 24.0)
    }

    /// Checks the rate of the clock. If no unit is stated, seconds are assumed, and a rate that no such sensor has
    /// is refused. A stated unit is refused only for impossible rates.
    pub fn check_clock(&self, rate: f64) -> Result<(), RecordingProblem> {
        let Some(time) = self.layout.time else {
            return Ok(());
        };
        let is_stated = self.clock.is_unit_stated();
        let believed = if is_stated { 1e-3..=1e7 } else { 2.0..=5e4 };
        if believed.contains(&rate) {
            return Ok(());
        }
        let unit = self.clock.unit();
        let a_tick = rate / unit.per_second();
        let is_usual = |unit: &TimeUnit| (2.0..=5e4).contains(&(a_tick * unit.per_second()));
        Err(RecordingProblem::Rate {
            column: self.layout.columns[time].name.clone(),
            unit,
            rate,
            likely: TimeUnit::ALL.into_iter().find(is_usual),
        })
    }

    fn check(&self, reading: &Reading) -> Result<(), RecordingProblem> {
        let got = self.times.len() as u64;
        if self.rows == 0 && self.skipped.cut.is_none() {
            return Err(RecordingProblem::HeaderOnly);
        }
        if got < 2
            && let (Some(last), true) = (self.last, reading.from.or(reading.to).is_some())
        {
            return Err(RecordingProblem::NothingLeft {
                from: reading.from.unwrap_or(self.first),
                to: reading.to.unwrap_or(last),
                got,
                first: self.first,
                last,
            });
        }
        Ok(())
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
