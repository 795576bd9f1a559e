//! Recordings of real lifts by a phone or a logger, read as one signal.
//!
//! A [`Recording`] is a table of text: from phyphox, Science Journal or Sensor Logger, or plainly
//! `time,acceleration`; by itself or in a zip archive; its cells separated by commas, semicolons or tabs,
//! with decimal points or commas, in UTF-8 or UTF-16. Opening it reads it once or twice, in bounded memory
//! whatever its size, to find the vertical axis and to gather [`Facts`] and [`Warning`]s about the quality of
//! the signal. [`Recording::samples`] then reads it once more.
//!
//! Samples are in s and m/s², up positive, with strictly increasing times; nothing else is changed. In
//! particular:
//!
//! - a row whose time or acceleration is blank gives no sample, since apps write a row for every sensor;
//! - of rows with equal times the first counts, and a time that goes back is refused, since the order of the
//!   rows is then unreliable;
//! - a last row that is cut short is left out with a warning. A number that lost only some digits cannot be
//!   distinguished from a complete one;
//! - any other cell that is not a finite number is refused with its line;
//! - samples are resampled to a uniform grid only if [`Reading::resample`] is set: each is then the mean of
//!   the linear interpolation over a block of 1/rate, and blocks that a gap reaches into are left out.
//!
//! A [`LineReader`] reads from a pipe, line by line.
//!
//! ```
//! use liftsim::signal::recording::{Reading, Recording};
//!
//! let text = "time (ms),acceleration (g)\n0,1.00\n20,1.25\n40,1.00\n";
//! let recording = Recording::from_bytes("example", text.as_bytes(), &Reading::default())?;
//! assert_eq!(recording.facts().rate, 50.0);
//! let samples: Vec<_> = recording.samples()?.collect::<Result<_, _>>()?;
//! assert_eq!((samples[1].time, samples[1].acceleration), (0.02, 1.25 * 9.80665));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod archive;
mod axis;
mod bearings;
mod blocks;
mod cell;
mod choice;
mod column;
mod delimiter;
mod error;
mod facts;
mod intervals;
mod layout;
mod line_reader;
mod lines;
mod reading;
mod resample;
mod series;
mod source;
mod steps;
mod table;
#[cfg(test)]
mod tests;
mod unknown_name;
mod vertical;
mod warning;

pub use axis::Axis;
pub use error::{Names, RecordingError, RecordingProblem};
pub use facts::Facts;
pub use intervals::Gap;
pub use layout::Format;
pub use line_reader::{LineError, LineReader, LineReading};
pub use reading::{GRAVITY, Reading, TimeUnit, Unit, UnitError};
pub use series::Sample;
pub use unknown_name::UnknownName;
pub use vertical::{Direction, Reason, Vertical};
pub use warning::Warning;

use bearings::Bearings;
use choice::Accelerations;
use layout::Layout;
use resample::Resampled;
use series::Series;
use source::Source;
use std::path::Path;
use std::sync::Arc;

/// A recording that has been checked and can be read.
#[derive(Clone, Debug)]
pub struct Recording {
    source: Source,
    layout: Arc<Layout>,
    vertical: Vertical,
    facts: Facts,
    warnings: Vec<Warning>,
    resample: Option<f64>,
}

impl Recording {
    /// Opens and checks a file.
    ///
    /// # Errors
    /// If the file is not a recording, or cannot be read with these options.
    pub fn open(path: &Path, reading: &Reading) -> Result<Self, RecordingError> {
        Self::look_through(Source::file(path)?, reading)
    }

    /// Checks a file held in memory; messages call it `name`.
    ///
    /// # Errors
    /// If the file is not a recording, or cannot be read with these options.
    pub fn from_bytes(
        name: &str,
        bytes: impl Into<Arc<[u8]>>,
        reading: &Reading,
    ) -> Result<Self, RecordingError> {
        Self::look_through(Source::memory(name, bytes.into()), reading)
    }

    fn look_through(source: Source, reading: &Reading) -> Result<Self, RecordingError> {
        let source = archive::table(source, reading)?;
        let layout = Arc::new(Layout::find(&source, reading)?);
        let mut vertical = vertical(&source, &layout, reading)?;
        let mut series = Series::open(&source, &layout, &vertical.direction)?;
        let mut facts = Facts::of(&mut series, &source, layout.is_headed)?;
        if facts.has_gravity && facts.mean < 0.0 {
            vertical = vertical.turned();
            facts = facts.turned();
        }
        check_clock(&layout, &facts).map_err(|problem| source.error(None, problem))?;
        check_resample(reading, &facts).map_err(|problem| source.error(None, problem))?;
        let warnings = Warning::all(&facts, &layout, &vertical);
        Ok(Self {
            source,
            layout,
            vertical,
            facts,
            warnings,
            resample: reading.resample,
        })
    }

    /// Facts about the signal before any resampling.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// Warnings about the quality of the signal.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The app that wrote it.
    pub fn format(&self) -> Format {
        self.layout.format
    }

    /// The member of the archive that is read.
    pub fn member(&self) -> Option<&str> {
        self.source.member()
    }

    /// The name and the unit of the time column.
    pub fn time_column(&self) -> (&str, TimeUnit) {
        (
            &self.layout.columns[self.layout.time].name,
            self.layout.time_unit,
        )
    }

    /// The names of the columns that the acceleration is read from: one, or three where it is projected on
    /// the direction of gravity.
    pub fn acceleration_columns(&self) -> Vec<&str> {
        let columns = match &self.vertical.direction {
            Direction::Along { column, .. } => std::slice::from_ref(column),
            Direction::Projected { columns, .. } => columns,
        };
        columns
            .iter()
            .map(|&column| self.layout.columns[column].name.as_str())
            .collect()
    }

    /// The unit of the accelerations, never [`Unit::Found`].
    pub fn unit(&self) -> Unit {
        self.layout.unit
    }

    /// The vertical direction, and how it was found.
    pub fn vertical(&self) -> &Vertical {
        &self.vertical
    }

    /// The rate of the samples, Hz, after any resampling.
    pub fn rate(&self) -> f64 {
        self.resample.unwrap_or(self.facts.rate)
    }

    /// The samples, from the first.
    ///
    /// # Errors
    /// If the file can no longer be opened.
    pub fn samples(&self) -> Result<Samples, RecordingError> {
        let series = Series::open(&self.source, &self.layout, &self.vertical.direction)?;
        Ok(Samples(match self.resample {
            None => Kind::Recorded(series),
            Some(rate) => Kind::Resampled(Resampled::new(series, rate, self.facts.gap())),
        }))
    }
}

/// The samples of a [`Recording`], times strictly increasing, in bounded memory. An error, possible only
/// where the file has changed since it was opened, is the last item.
pub struct Samples(Kind);

enum Kind {
    Recorded(Series),
    Resampled(Resampled),
}

impl Iterator for Samples {
    type Item = Result<Sample, RecordingError>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        match &mut self.0 {
            Kind::Recorded(series) => series.next(),
            Kind::Resampled(resampled) => resampled.next(),
        }
    }
}

/// The vertical direction: given, or found in a separate pass.
fn vertical(
    source: &Source,
    layout: &Arc<Layout>,
    reading: &Reading,
) -> Result<Vertical, RecordingError> {
    let along = |column, axis, reason| Vertical {
        direction: Direction::Along {
            column,
            axis,
            sign: 1.0,
        },
        reason,
    };
    let axes = match &layout.acceleration {
        Accelerations::Named(column) => return Ok(along(*column, None, Reason::Given)),
        Accelerations::Only(column) => return Ok(along(*column, None, Reason::Only)),
        Accelerations::Axes(axes) => axes,
    };
    match (reading.axis, &axes[..]) {
        (Axis::Gravity, _) => Bearings::take(source, layout, axes)?
            .project()
            .map_err(|lacking| source.error(None, RecordingProblem::NoGravity(lacking))),
        (Axis::Auto, [(axis, column)]) => Ok(along(*column, Some(*axis), Reason::Only)),
        (Axis::Auto, _) => Ok(Bearings::take(source, layout, axes)?.find()),
        (_, axes) => {
            let (axis, column) = axes[0];
            Ok(along(column, Some(axis), Reason::Given))
        }
    }
}

/// Checks the rate of the clock. If no unit is stated, seconds are assumed, and a rate that no such sensor has
/// is refused. A stated unit is refused only for impossible rates.
fn check_clock(layout: &Layout, facts: &Facts) -> Result<(), RecordingProblem> {
    let believed = if layout.is_time_unit_stated {
        1e-3..=1e7
    } else {
        2.0..=5e4
    };
    if believed.contains(&facts.rate) {
        Ok(())
    } else {
        Err(RecordingProblem::Rate {
            column: layout.columns[layout.time].name.clone(),
            unit: layout.time_unit,
            rate: facts.rate,
            likely: likely_unit(layout.time_unit, facts.rate),
        })
    }
}

/// The coarsest unit in which the clock would have the rate of a sensor.
fn likely_unit(unit: TimeUnit, rate: f64) -> Option<TimeUnit> {
    let a_tick = rate / unit.per_second();
    TimeUnit::ALL
        .into_iter()
        .find(|unit| (2.0..=5e4).contains(&(a_tick * unit.per_second())))
}

/// Checks that the grid is neither finer than the clock resolves nor much finer than the recording.
fn check_resample(reading: &Reading, facts: &Facts) -> Result<(), RecordingProblem> {
    let latest = facts.start.abs().max(facts.end.abs());
    let limit = (10.0 * facts.rate).min(1.0 / (16.0 * f64::EPSILON * latest));
    match reading.resample {
        Some(got) if !(got > 0.0 && got <= limit) => Err(RecordingProblem::Resample {
            got,
            limit: (1e6 * limit).round() / 1e6,
        }),
        _ => Ok(()),
    }
}
