//! Recordings of real lifts: what a phone or a logger wrote down, as one signal.
//!
//! A [`Recording`] is a table of text: from phyphox, Science Journal or Sensor Logger, or plainly
//! `time,acceleration`; by itself or in a zip archive; its cells parted by commas, semicolons or tabs,
//! with decimal points or commas, in UTF-8 or UTF-16. Opening it reads it through once or twice, in bounded
//! memory whatever its size: to find which way is up, and to gather the [`Facts`] and [`Warning`]s that
//! should be known before the signal is trusted. [`Recording::samples`] then reads it once more.
//!
//! What is read is in s and m/s², up positive, times strictly increasing; nothing else is changed. In
//! particular:
//!
//! - a row whose time or acceleration is blank gives no sample, since apps write a row for every sensor;
//! - of rows with one time the first counts, and a time that goes back is refused, since no order of
//!   the rows is then to be trusted;
//! - a last row that is cut short is left out with a warning. A number that lost its last digits and is
//!   still a number cannot be told from a whole one;
//! - everything else that is no finite number is refused with its line;
//! - only where [`Reading::resample`] asks for it are samples brought to a uniform grid: each is then the
//!   mean over a block of 1/rate of the straight lines that join the readings, and where a gap reaches
//!   into a block there is none.
//!
//! A [`LineReader`] reads what comes through a pipe, a line at a time.
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

/// A file that has been looked through, and can be read.
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
    /// Looks through a file.
    ///
    /// # Errors
    /// If it is no recording, or cannot be read as asked.
    pub fn open(path: &Path, reading: &Reading) -> Result<Self, RecordingError> {
        Self::look_through(Source::file(path)?, reading)
    }

    /// The same of a file that is held in memory, under the name that messages give it.
    ///
    /// # Errors
    /// If it is no recording, or cannot be read as asked.
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

    /// What is known of the signal as it was recorded.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// What should be known before it is trusted.
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

    /// The name of the time column, and what it is counted in.
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

    /// What accelerations are counted in, never [`Unit::Found`].
    pub fn unit(&self) -> Unit {
        self.layout.unit
    }

    /// Which way is up, and how that is known.
    pub fn vertical(&self) -> &Vertical {
        &self.vertical
    }

    /// Hz: of the samples that are read, resampled if that was asked.
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

/// Which way is up: said, or found in a pass of its own.
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

/// Seconds are a guess where nothing is said, and a rate that no sensor of lifts has shows it to be wrong.
/// What is said is believed, but for rates that no clock can tell.
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

/// The coarsest unit in which a clock would be that of a sensor.
fn likely_unit(unit: TimeUnit, rate: f64) -> Option<TimeUnit> {
    let a_tick = rate / unit.per_second();
    TimeUnit::ALL
        .into_iter()
        .find(|unit| (2.0..=5e4).contains(&(a_tick * unit.per_second())))
}

/// A grid must not be finer than the clock's own numbers, nor pretend to what was not recorded.
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
