//! The pressure of the air, as a barometer recorded it: a table of its own, or a column beside the acceleration.

use super::container;
use super::error::{RecordingError, RecordingProblem};
use super::pressure::{Pressure, PressureUnit, is_on_earth};
use super::reading::{Quantity, Reading};
use super::source::Source;
use super::table::Columns;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The record of a barometer.
#[derive(Clone, Debug)]
pub struct Barometer {
    /// In order of time.
    pub readings: Vec<Pressure>,
    /// The file, and the part of it that was read.
    pub file: String,
    /// The name of the column.
    pub column: String,
    /// In which it was read.
    pub unit: PressureUnit,
    /// Subtracted from the times of the file, s.
    pub clock_offset: Option<f64>,
    /// How many readings no air on earth has, and were left out.
    pub left_out: usize,
}

impl Barometer {
    /// Reads a file.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let source = container::table(Source::file(path)?, &reading())?;
        Self::of(&source)
    }

    /// Reads a file held in memory; messages call it `name`.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn from_bytes(name: &str, bytes: impl Into<Arc<[u8]>>) -> Result<Self, RecordingError> {
        let source = container::table(Source::memory(name, bytes.into()), &reading())?;
        Self::of(&source)
    }

    /// The barometer that was recorded with an acceleration: a column of the same table, a table of the same archive, or a
    /// table beside it that is called alike. None if there is none, or more than one. An altitude may be that of a satellite,
    /// and is none.
    ///
    /// # Errors
    /// If one is there and cannot be read.
    pub fn recorded_with(acceleration: &Path) -> Result<Option<Self>, RecordingError> {
        let source = Source::file(acceleration);
        let source = source.and_then(|it| container::table(it, &reading()));
        let source = source
            .ok()
            .filter(|it| Columns::begin(it, &reading()).is_ok());
        let found = match (source, &called_alike(acceleration)[..]) {
            (Some(source), _) => Self::of(&source)?,
            (None, [path]) => Self::open(path)?,
            (None, _) => return Ok(None),
        };
        Ok(Some(found).filter(|it| it.unit != PressureUnit::Metres))
    }

    fn of(source: &Source) -> Result<Self, RecordingError> {
        let columns = Columns::read(source, &reading())?;
        let layout = &columns.parser.layout;
        let (column, axis) = (&layout.columns[layout.axes[0].1].name, &columns.axes[0]);
        let unit = PressureUnit::of(column, axis);
        let unit = unit.ok_or_else(|| {
            let problem = RecordingProblem::Cell {
                column: column.clone(),
                rule: "be the pressure of the air on earth",
                got: axis.first().map_or("nothing".to_owned(), f64::to_string),
                remedy: "name its unit in the header: Pa, hPa, kPa, mmHg or inHg in brackets",
            };
            source.error(None, problem)
        })?;
        let readings = columns.times.iter().zip(axis);
        let readings = readings.map(|(&time, reading)| Pressure {
            time,
            pascal: unit.pascal(*reading),
        });
        let mut readings: Vec<Pressure> = readings.collect();
        let all = readings.len();
        readings.retain(|it| is_on_earth(it.pascal));
        let left_out = all - readings.len();
        readings.dedup_by_key(|it| it.time);
        if readings.is_empty() {
            let problem = RecordingProblem::must(
                "pressures must be those of the air on earth, 400 to 1600 hPa",
                "none",
                "check the unit in the header",
            );
            return Err(source.error(None, problem));
        }
        Ok(Self {
            left_out,
            readings,
            file: source.name().to_owned(),
            column: column.clone(),
            unit,
            clock_offset: columns.parser.clock.offset(),
        })
    }
}

fn reading() -> Reading {
    Reading {
        quantity: Quantity::Pressure,
        ..Reading::default()
    }
}

/// What apps call the tables of their sensors.
const ACCELEROMETERS: [&str; 4] = [
    "totalacceleration",
    "linear accelerometer",
    "accelerometer",
    "acceleration",
];
const BAROMETERS: [&str; 2] = ["barometer", "pressure"];

/// The tables of a barometer beside a table of accelerations, whose names differ only by the sensor.
fn called_alike(acceleration: &Path) -> Vec<PathBuf> {
    let lower = |path: &Path| {
        let name = path.file_name().map(OsStr::to_string_lossy);
        name.unwrap_or_default().to_lowercase()
    };
    let name = lower(acceleration);
    let Some(sensor) = ACCELEROMETERS.iter().find(|it| name.contains(**it)) else {
        return Vec::new();
    };
    let alike = BAROMETERS.map(|barometer| name.replace(sensor, barometer));
    let folder = acceleration
        .parent()
        .filter(|folder| *folder != Path::new(""));
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new(".")));
    let entries = entries.into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths.filter(|path| alike.contains(&lower(path))).collect()
}
