//! The vertical acceleration, row by row.

use super::error::{RecordingError, RecordingProblem};
use super::layout::Layout;
use super::reading::TimeUnit;
use super::source::Source;
use super::table::Table;
use super::vertical::Direction;
use std::sync::Arc;

/// One reading of the vertical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s, by the file's clock.
    pub time: f64,
    /// m/s², up positive; bias and any gravity are left in.
    pub acceleration: f64,
}

/// No recording of a lift has times or accelerations beyond these: 30 000 years, and ten thousand times the
/// range of a shock sensor.
const LATEST: (u8, f64) = (12, 1e12);
const STRONGEST: (u8, f64) = (9, 1e9);

/// Rows that gave no sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Skipped {
    /// A cell was blank.
    pub blank: u64,
    /// The time was that of the row before.
    pub repeated: u64,
    /// The line of the first repeated time.
    pub first_repeat: Option<u64>,
    /// The line at which the file is cut off.
    pub cut: Option<u64>,
}

/// The samples of a table as they were recorded, times increasing. Ends with the first error.
pub(super) struct Series {
    readings: Readings,
    direction: Direction,
    last: Option<f64>,
    skipped: Skipped,
    is_over: bool,
}

impl Series {
    pub fn open(
        source: &Source,
        layout: &Arc<Layout>,
        direction: &Direction,
    ) -> Result<Self, RecordingError> {
        Ok(Self {
            readings: Readings::open(source, layout)?,
            direction: direction.clone(),
            last: None,
            skipped: Skipped::default(),
            is_over: false,
        })
    }

    /// The rows skipped so far.
    pub fn skipped(&self) -> Skipped {
        Skipped {
            cut: self.readings.table.cut(),
            ..self.skipped
        }
    }

    fn advance(&mut self) -> Result<Option<Sample>, RecordingError> {
        while self.readings.table.advance()? {
            let time = self.readings.time()?;
            let acceleration = self.acceleration()?;
            if self.readings.table.cut().is_some() {
                break;
            }
            let (Some(time), Some(acceleration)) = (time, acceleration) else {
                self.skipped.blank += 1;
                continue;
            };
            match self.last {
                Some(from) if time < from => {
                    let problem = RecordingProblem::TimeBack { from, to: time };
                    return Err(self.readings.table.error(problem));
                }
                // Of several readings at one time the first is kept, since nothing shows which one is right.
                Some(from) if time == from => {
                    self.skipped.repeated += 1;
                    let line = self.readings.table.line();
                    self.skipped.first_repeat.get_or_insert(line);
                }
                _ => {
                    self.last = Some(time);
                    return Ok(Some(Sample { time, acceleration }));
                }
            }
        }
        Ok(None)
    }

    #[inline]
    fn acceleration(&mut self) -> Result<Option<f64>, RecordingError> {
        match &self.direction {
            Direction::Along { column, sign, .. } => {
                Ok(self.readings.acceleration(*column)?.map(|a| a * sign))
            }
            Direction::Projected { columns, up } => {
                let mut sum = Some(0.0);
                for (column, up) in columns.iter().zip(up) {
                    let along = self.readings.acceleration(*column)?;
                    sum = sum.zip(along).map(|(sum, along)| sum + up * along);
                }
                Ok(sum)
            }
        }
    }
}

impl Iterator for Series {
    type Item = Result<Sample, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        let next = self.advance().transpose();
        self.is_over = !matches!(next, Some(Ok(_)));
        next
    }
}

/// The rows of a table in s and m/s².
pub(super) struct Readings {
    pub table: Table,
    layout: Arc<Layout>,
    per_second: f64,
}

impl Readings {
    pub fn open(source: &Source, layout: &Arc<Layout>) -> Result<Self, RecordingError> {
        Ok(Self {
            table: Table::open(source, layout)?,
            layout: layout.clone(),
            per_second: TimeUnit::per_second(layout.time_unit),
        })
    }

    /// s.
    #[inline]
    pub fn time(&mut self) -> Result<Option<f64>, RecordingError> {
        let Some(time) = self.table.number(self.layout.time)? else {
            return Ok(None);
        };
        self.within(self.layout.time, time / self.per_second, LATEST, "s")
    }

    /// m/s².
    #[inline]
    pub fn acceleration(&mut self, column: usize) -> Result<Option<f64>, RecordingError> {
        let Some(reading) = self.table.number(column)? else {
            return Ok(None);
        };
        let acceleration = self.layout.unit.convert(reading);
        self.within(column, acceleration, STRONGEST, "m/s^2")
    }

    #[inline]
    fn within(
        &self,
        column: usize,
        got: f64,
        (exponent, limit): (u8, f64),
        unit: &'static str,
    ) -> Result<Option<f64>, RecordingError> {
        if got.abs() <= limit {
            return Ok(Some(got));
        }
        let is_clock = column == self.layout.time;
        let remedy = match (is_clock && !self.layout.is_time_unit_stated, got.abs()) {
            // Times since 1970 are 1e9 to 1e10 s.
            (true, 1e12..1e13) => "--time-unit ms, if these are milliseconds since 1970",
            (true, 1e15..1e16) => "--time-unit us, if these are microseconds since 1970",
            (true, 1e18..1e19) => "--time-unit ns, if these are nanoseconds since 1970",
            _ if is_clock => "check the unit: --time-unit s, ms, us or ns",
            _ => "check the unit: --unit m/s^2, g, mg or counts",
        };
        let column = self.layout.columns[column].name.clone();
        Err(self.table.error(RecordingProblem::OutOfRange {
            column,
            exponent,
            unit,
            got,
            remedy,
        }))
    }
}
