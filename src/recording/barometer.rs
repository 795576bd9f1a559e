//! The pressure of the air, as a barometer recorded it: a table of its own, or a column beside the acceleration.

use super::error::{Names, RecordingError, RecordingProblem};
use super::layout::Quantity;
use super::pressure::{self, Pressure, PressureUnit, is_on_earth};
use super::reading::Reading;
use super::source::Source;
use super::table::Columns;
use super::{archive, container};
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
    /// What was assumed, or left out.
    pub warnings: Vec<BarometerWarning>,
}

/// What a barometer's table left open, or has of no use.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum BarometerWarning {
    #[error(
        "the barometer's columns have no names: they were taken for time and pressure (name them in a header)"
    )]
    NoNames,
    #[error(
        "the barometer's column \"{column}\" is read, and not {others} (--barometer-column COLUMN chooses)"
    )]
    Several { column: String, others: Names },
    #[error("{0} rows of the barometer have NaN for the pressure (they are left out)")]
    Missing(u64),
    #[error("{0} readings of the barometer repeat a time (the first of each is kept)")]
    Repeated(usize),
    #[error("{0} readings of the barometer are of no air on earth (they are left out)")]
    NoAir(usize),
    #[error("the barometer's table ends within a row (it is left out)")]
    CutOff,
}

impl Barometer {
    /// Readings in order of time that come from no file.
    pub fn of_readings(readings: Vec<Pressure>) -> Self {
        Self {
            readings,
            file: String::new(),
            column: String::new(),
            unit: PressureUnit::Pascal,
            clock_offset: None,
            warnings: Vec::new(),
        }
    }

    /// Reads a file; of several columns the one of this name.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn open(path: &Path, column: Option<&str>) -> Result<Self, RecordingError> {
        let reading = Reading {
            acceleration: column.map(str::to_owned),
            ..Reading::default()
        };
        Self::of(&table(Source::file(path)?, &reading)?, &reading)
    }

    /// Reads a file held in memory; messages call it `name`.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn from_bytes(name: &str, bytes: impl Into<Arc<[u8]>>) -> Result<Self, RecordingError> {
        let reading = Reading::default();
        let source = table(Source::memory(name, bytes.into()), &reading)?;
        Self::of(&source, &reading)
    }

    /// The barometer that was recorded with an acceleration: a column of the same table, a table of the same archive, or a
    /// table beside it that is called alike. An altitude may be that of a satellite, and is none.
    ///
    /// # Errors
    /// If one is there and cannot be read, or if there are several.
    pub fn recorded_with(acceleration: &Path) -> Result<Option<Self>, RecordingError> {
        let reading = Reading::default();
        let source = Source::file(acceleration);
        let source = match source.and_then(|it| table(it, &reading)) {
            Err(error) if error.is_among(archive::BAROMETERS) => return Err(error),
            source => source.ok(),
        };
        let is_named = |it: &Source| {
            let begun = Columns::begin(it, &reading, Quantity::Pressure);
            begun.is_ok_and(|(parser, _)| !parser.layout.is_guessed)
        };
        let found = match (source.filter(is_named), &called_alike(acceleration)[..]) {
            (Some(source), _) => Self::of(&source, &reading)?,
            (None, [path]) => Self::open(path, None)?,
            (None, []) => return Ok(None),
            (None, several) => {
                let names = several.iter().map(|it| it.to_string_lossy());
                let names: Vec<_> = names.collect();
                let problem = RecordingProblem::Among {
                    what: "several barometers lie beside it:",
                    names: Names::of(names.iter().map(|it| &**it)),
                    remedy: "--barometer FILE, or --no-barometer",
                };
                return Err(Source::file(acceleration)?.error(None, problem));
            }
        };
        Ok(Some(found).filter(|it| it.unit != PressureUnit::Metres))
    }

    fn of(source: &Source, reading: &Reading) -> Result<Self, RecordingError> {
        let columns = Columns::read(source, reading, Quantity::Pressure)?;
        let layout = &columns.parser.layout;
        let place = layout.axes[0].1;
        let (column, axis) = (&layout.columns[place].name, &columns.axes[0]);
        let unit = PressureUnit::of(column, axis);
        let unit = unit.ok_or_else(|| {
            let problem = RecordingProblem::Cell {
                column: column.clone(),
                rule: "be the pressure of the air on earth",
                got: axis.first().map_or("nothing".to_owned(), f64::to_string),
                remedy: "name its unit in the header, as `pressure (hPa)`: Pa, hPa, kPa, mmHg, inHg, or m of an altitude",
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
        let no_air = all - readings.len();
        readings.dedup_by_key(|it| it.time);
        let repeated = all - no_air - readings.len();
        if readings.is_empty() {
            let problem = RecordingProblem::must(
                "pressures must be those of the air on earth, 400 to 1600 hPa",
                "none",
                "check the unit in the header",
            );
            return Err(source.error(None, problem));
        }
        let others = pressure::columns(&layout.columns).into_iter();
        let others = others.filter(|it| *it != place && reading.acceleration.is_none());
        let others: Vec<&str> = others.map(|it| &*layout.columns[it].name).collect();
        let missing = columns.skipped.missing;
        let warnings = [
            layout.is_guessed.then_some(BarometerWarning::NoNames),
            (!others.is_empty()).then(|| BarometerWarning::Several {
                column: column.clone(),
                others: Names::of(others),
            }),
            (missing > 0).then_some(BarometerWarning::Missing(missing)),
            (repeated > 0).then_some(BarometerWarning::Repeated(repeated)),
            (no_air > 0).then_some(BarometerWarning::NoAir(no_air)),
            columns.skipped.cut.map(|_| BarometerWarning::CutOff),
        ];
        Ok(Self {
            warnings: warnings.into_iter().flatten().collect(),
            readings,
            file: source.name().to_owned(),
            column: column.clone(),
            unit,
            clock_offset: columns.parser.clock.offset(),
        })
    }
}

fn table(source: Source, reading: &Reading) -> Result<Source, RecordingError> {
    container::table(source, reading, Quantity::Pressure)
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
