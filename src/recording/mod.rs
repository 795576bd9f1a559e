//! Recordings of real lifts by a phone or a logger, read as one signal.
//!
//! A [`Recording`] is a table of text: as phyphox, Science Journal, Sensor Logger, Physics Toolbox, Xsens DOT,
//! Witmotion, a Campbell logger or an Arduino's serial monitor write it, or plainly `time,acceleration`; by
//! itself or in a zip archive; its cells separated by commas, semicolons, tabs or blanks, quoted or not, with
//! decimal points or commas, in UTF-8 or UTF-16. JSON and workbooks are turned into such tables. A file is read
//! once, into columns in memory; then its unit and its vertical are found, and [`Facts`] and [`Warning`]s
//! about the quality of the signal.
//!
//! Samples are in s and m/s², up positive, with strictly increasing times; nothing else is changed. In
//! particular:
//!
//! - a row whose time or acceleration is blank or NaN gives no sample, since apps write a row for every sensor;
//! - of rows with equal times the first counts, unless each time stands for many rows, which are then spread; a
//!   time that goes back is refused, unless a clock of 32 bits began again;
//! - times since 1970 and dates count from the first row, whose [`Moment`] is kept; dates without a zone are those of
//!   some clock on a wall;
//! - a last row that is cut short is left out with a warning. A number that lost only some digits cannot be
//!   distinguished from a complete one;
//! - any other cell that is not a finite number is refused with its line;
//! - samples are resampled to a uniform grid only if [`Reading::resample`] is set: each is then the mean of
//!   the linear interpolation over a block of 1/rate, and blocks that a gap reaches into are left out.
//!
//! A [`LineReader`] reads the same lines from a pipe, in constant memory.
//!
//! ```
//! use liftsim::recording::{Reading, Recording};
//!
//! let text = "time (ms),acceleration (g)\n0,1.00\n20,1.25\n40,1.00\n";
//! let recording = Recording::from_bytes("example", text.as_bytes(), &Reading::default())?;
//! assert_eq!(recording.facts().rate, 50.0);
//! let second = recording.samples()[1];
//! assert_eq!((second.time, second.acceleration), (0.02, 1.25 * 9.80665));
//! # Ok::<(), liftsim::recording::RecordingError>(())
//! ```

mod archive;
mod assumed;
mod axis;
mod barometer;
mod cell;
mod clock;
mod container;
mod error;
mod facts;
mod head;
mod json;
mod layout;
mod line_reader;
mod lines;
mod missing;
mod moment;
mod names;
mod parser;
mod pressure;
mod reading;
mod resample;
mod sample;
mod sheet;
mod source;
mod splitter;
mod spread;
mod stamp;
mod steps;
mod table;
#[cfg(test)]
mod tests;
mod text_table;
mod unit;
mod vertical;
mod warning;
mod windows;
mod xml;

pub use axis::{Axis, UnknownName};
pub use error::{Names, RecordingError, RecordingProblem};
pub use facts::{Facts, Gap};

pub use barometer::{Barometer, BarometerWarning};
pub use line_reader::{LineError, LineReader, LineReading, StreamColumns};
pub use moment::{Moment, When};
pub use pressure::{Pressure, PressureUnit};
pub use reading::Reading;
pub use sample::Sample;
pub use unit::{GRAVITY, TimeUnit, Unit, UnitError};

pub use vertical::{Reason, Vertical};
pub use warning::Warning;

use layout::Quantity;
use source::Source;
use std::path::Path;
use std::sync::Arc;
use table::Columns;
use windows::Windows;

/// A recording in memory.
#[derive(Clone, Debug)]
pub struct Recording {
    samples: Vec<Sample>,
    across: Option<[Vec<Sample>; 2]>,
    rate: f64,
    facts: Facts,
    warnings: Vec<Warning>,
    vertical: Vertical,
    format: &'static str,
    member: Option<String>,
    /// The name of the column, and its unit.
    time: (String, TimeUnit),
    accelerations: Vec<String>,
    unit: Unit,
}

impl Recording {
    /// Reads a file.
    ///
    /// # Errors
    /// If the file is not a recording, or cannot be read with these options.
    pub fn open(path: &Path, reading: &Reading) -> Result<Self, RecordingError> {
        Self::of(Source::file(path)?, reading)
    }

    /// Reads a file held in memory; messages call it `name`.
    ///
    /// # Errors
    /// If the file is not a recording, or cannot be read with these options.
    pub fn from_bytes(
        name: &str,
        bytes: impl Into<Arc<[u8]>>,
        reading: &Reading,
    ) -> Result<Self, RecordingError> {
        Self::of(Source::memory(name, bytes.into()), reading)
    }

    fn of(source: Source, reading: &Reading) -> Result<Self, RecordingError> {
        let source = container::table(source, reading, Quantity::Acceleration)?;
        let columns = Columns::read(&source, reading, Quantity::Acceleration)?;
        let recording = Self::of_columns(columns, source.part().map(str::to_owned), reading);
        let mut recording = recording.map_err(|problem| source.error(None, problem))?;
        recording.warnings.extend(tilt(&source, reading));
        Ok(recording)
    }

    fn of_columns(
        mut columns: Columns,
        member: Option<String>,
        reading: &Reading,
    ) -> Result<Self, RecordingProblem> {
        let mut windows = Windows::of(&columns);
        let assumed = assumed::unit(&columns.parser.layout, &windows)?;
        let unit = assumed.unit;
        windows.convert(unit, columns.axes.len());
        let is_reversed = assumed.is_reversed;
        let mut vertical = vertical::find(&columns, &windows, reading.axis, is_reversed)?;
        let along = vertical::project(&columns, &windows, unit, &vertical);
        let coarse_step = vertical::coarse_step(&columns, unit, &vertical);
        let across = || vertical::project_across(&columns, &windows, unit, &vertical);
        let across = reading.across.then(across).flatten();
        columns.axes.clear();
        let sign = if reading.invert { -1.0 } else { 1.0 };
        if reading.invert {
            vertical = vertical.inverted();
        }
        let mut samples = sample::series(&columns.times, along, sign);
        let mut across = across.map(|both| both.map(|it| sample::series(&columns.times, it, 1.0)));
        columns.skipped.blank += (columns.times.len() - samples.len()) as u64;
        columns.times = Vec::new();
        let whole_rows = samples.len() as u64;
        let repeats = spread::spread(&mut samples);
        across.iter_mut().flatten().for_each(|it| {
            spread::spread(it);
        });
        let facts = Facts::of(&samples, windows.has_gravity(), reading.rate)?;
        let facts = Facts {
            clock_offset: columns.parser.clock.offset(),
            clock_zero: columns.parser.clock.zero(),
            coarse_step: coarse_step.or(facts.coarse_step),
            ..facts
        };
        columns.check_clock(facts.rate)?;
        let mut warnings = warning::of_rows(&columns, repeats, whole_rows);
        warnings.extend(assumed.warning);
        let is_doubtful = is_reversed && !vertical.is_sign_known;
        let is_even = reading.resample.is_some();
        warnings.extend(warning::of_signal(&facts, &vertical, is_doubtful, is_even));
        if let Some(rate) = reading.resample {
            check_resample(rate, &facts)?;
            for series in [&mut samples]
                .into_iter()
                .chain(across.iter_mut().flatten())
            {
                *series = resample::resample(series, rate, facts.gap());
            }
        }
        let layout = &columns.parser.layout;
        let names = layout.acceleration_names().into_iter().zip(0..);
        let read = names.filter(|(_, place)| vertical.column.is_none_or(|column| column == *place));
        Ok(Self {
            samples,
            across,
            rate: reading.resample.unwrap_or(facts.rate),
            facts,
            warnings,
            format: layout.format,
            member,
            time: match layout.time {
                Some(time) => (
                    layout.columns[time].name.clone(),
                    columns.parser.clock.unit(),
                ),
                None => ("--rate".to_owned(), TimeUnit::Seconds),
            },
            accelerations: read.map(|(name, _)| name.to_owned()).collect(),
            vertical,
            unit,
        })
    }

    /// With up where a barometer has it, which may be down in the record.
    #[must_use]
    pub fn with_up(mut self, is_upside_down: bool) -> Self {
        if is_upside_down {
            let samples = self.samples.iter_mut();
            samples.for_each(|sample| sample.acceleration = -sample.acceleration);
            let facts = &mut self.facts;
            (facts.least, facts.greatest) = (-facts.greatest, -facts.least);
        }
        self.vertical = self.vertical.by_barometer(is_upside_down);
        self
    }

    /// The samples, times strictly increasing, after any resampling.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// What was read across the vertical in two directions, at their own times, with [`Reading::across`] and three axes.
    pub fn across(&self) -> Option<&[Vec<Sample>; 2]> {
        self.across.as_ref()
    }

    /// The rate of the samples, Hz, after any resampling.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Facts about the signal before any resampling.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// Warnings about the quality of the signal, and about what was assumed.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The app that wrote it.
    pub fn format(&self) -> &'static str {
        self.format
    }

    /// The member of the archive, the sheet or the sensor that is read.
    pub fn member(&self) -> Option<&str> {
        self.member.as_deref()
    }

    /// The name and the unit of the time column.
    pub fn time_column(&self) -> (&str, TimeUnit) {
        (&self.time.0, self.time.1)
    }

    /// The names of the columns that the acceleration is read from: one, or three where it is projected.
    pub fn acceleration_columns(&self) -> &[String] {
        &self.accelerations
    }

    /// The unit of the accelerations, never [`Unit::Found`].
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// The vertical direction, and how it was found.
    pub fn vertical(&self) -> &Vertical {
        &self.vertical
    }
}

/// Whether an axis that was chosen is not the vertical, by all three, where the file has them.
fn tilt(source: &Source, reading: &Reading) -> Option<Warning> {
    let Axis::Along { index, .. } = reading.axis else {
        return None;
    };
    if reading.acceleration.is_some() {
        return None;
    }
    let all = Reading {
        axis: Axis::Auto,
        ..reading.clone()
    };
    let columns = Columns::read(source, &all, Quantity::Acceleration).ok()?;
    let mut windows = Windows::of(&columns);
    let unit = assumed::unit(&columns.parser.layout, &windows).ok()?.unit;
    windows.convert(unit, columns.axes.len());
    let shown = vertical::find(&columns, &windows, Axis::Auto, false).ok()?;
    let is_whole = columns.axes.len() == 3;
    is_whole.then(|| warning::of_axis(reading.axis, index, &shown))?
}

/// Checks that the grid is neither finer than the clock resolves nor much finer than the recording, nor too much
/// for the memory.
fn check_resample(got: f64, facts: &Facts) -> Result<(), RecordingProblem> {
    let latest = facts.start.abs().max(facts.end.abs());
    let limit = (10.0 * facts.rate).min(1.0 / (16.0 * f64::EPSILON * latest));
    if !(got > 0.0 && got <= limit) {
        let limit = (1e6 * limit).round() / 1e6;
        return Err(RecordingProblem::Resample { got, limit });
    }
    table::check_memory(facts.samples as f64 * (got / facts.rate).max(1.0), 16.0)
}
