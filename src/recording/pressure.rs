//! The pressure of the air, as a barometer recorded it: a table of its own, or a column beside the acceleration.

use super::archive;
use super::error::{RecordingError, RecordingProblem};
use super::json;
use super::names::Column;
use super::reading::{Quantity, Reading};
use super::sheet;
use super::source::Source;
use super::table::Columns;
use std::ffi::OsStr;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A reading of a barometer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressure {
    /// s, by the file's clock.
    pub time: f64,
    /// Pa
    pub pascal: f64,
}

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

/// The unit of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressureUnit {
    /// Pa
    Pascal,
    /// hPa, or mbar.
    Hectopascal,
    /// kPa
    Kilopascal,
    /// mmHg
    Mercury,
    /// inHg
    InchesOfMercury,
    /// An altitude above the sea in the standard atmosphere, m.
    Metres,
}

/// The air at the lowest and the highest place where lifts are, a mine 4 km deep and a plateau 6 km high, Pa.
const ON_EARTH: (f64, f64) = (40_000.0, 160_000.0);

/// Parts of the names of columns with the pressure, and with the altitude that an app made of it.
const PRESSURES: [&str; 4] = ["press", "druck", "baro", "presi"];
const ALTITUDES: [&str; 3] = ["altitud", "height", "höhe"];

/// The names of units, in lower case.
const UNITS: [(&str, PressureUnit); 9] = [
    ("pa", PressureUnit::Pascal),
    ("hpa", PressureUnit::Hectopascal),
    ("mbar", PressureUnit::Hectopascal),
    ("kpa", PressureUnit::Kilopascal),
    ("mmhg", PressureUnit::Mercury),
    ("torr", PressureUnit::Mercury),
    ("inhg", PressureUnit::InchesOfMercury),
    ("m", PressureUnit::Metres),
    ("metres", PressureUnit::Metres),
];

/// The standard atmosphere as eq. (5) of [1] has it: the height at which no air would be left, m, the exponent of the
/// pressure over that at the sea, and the latter, Pa.
const TOP: f64 = 44_330.0;
const EXPONENT: f64 = 1.0 / 5.255;
const AT_SEA: f64 = 101_325.0;

/// A millimetre of mercury, Pa.
const MERCURY: f64 = 133.322;

impl Pressure {
    /// The altitude above the sea, m, in the standard atmosphere: eq. (5) of the monitor with accelerometer and barometer, in
    /// the form of the sensor's data sheet. Its air is colder than that of a building.
    pub fn standard_altitude(&self) -> f64 {
        TOP * (1.0 - libm::pow(self.pascal / AT_SEA, EXPONENT))
    }
}

impl PressureUnit {
    /// That of a column: by its name, or by its readings.
    fn of(name: &str, readings: &[f64]) -> Option<Self> {
        let named = unit_name(name);
        if let Some(named) = named {
            let known = UNITS.iter().find(|(unit, _)| *unit == named);
            return known.map(|(_, unit)| *unit);
        }
        if is_one(&ALTITUDES, name) && !is_one(&PRESSURES, name) {
            return Some(Self::Metres);
        }
        let mut sorted: Vec<f64> = readings.to_vec();
        sorted.sort_by(f64::total_cmp);
        let median = *sorted.get(sorted.len() / 2)?;
        let units = [Self::Pascal, Self::Hectopascal, Self::Kilopascal];
        units
            .into_iter()
            .find(|unit| is_on_earth(unit.pascal(median)))
    }

    fn pascal(self, reading: f64) -> f64 {
        match self {
            Self::Pascal => reading,
            Self::Hectopascal => 100.0 * reading,
            Self::Kilopascal => 1000.0 * reading,
            Self::Mercury => MERCURY * reading,
            Self::InchesOfMercury => 25.4 * MERCURY * reading,
            Self::Metres => AT_SEA * libm::pow((1.0 - reading / TOP).max(0.0), 1.0 / EXPONENT),
        }
    }
}

impl fmt::Display for PressureUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Pascal => "Pa",
            Self::Hectopascal => "hPa",
            Self::Kilopascal => "kPa",
            Self::Mercury => "mmHg",
            Self::InchesOfMercury => "inHg",
            Self::Metres => "m in the standard atmosphere",
        })
    }
}

impl Barometer {
    /// Reads a file.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let source = table(Source::file(path)?)?;
        Self::of(&source)
    }

    /// Reads a file held in memory; messages call it `name`.
    ///
    /// # Errors
    /// If it is no recording of a barometer.
    pub fn from_bytes(name: &str, bytes: impl Into<Arc<[u8]>>) -> Result<Self, RecordingError> {
        let source = table(Source::memory(name, bytes.into()))?;
        Self::of(&source)
    }

    /// The barometer that was recorded with an acceleration: a column of the same table, a table of the same archive, or a
    /// table beside it that is called alike. None if there is none, or more than one. An altitude may be that of a satellite,
    /// and is none.
    ///
    /// # Errors
    /// If one is there and cannot be read.
    pub fn recorded_with(acceleration: &Path) -> Result<Option<Self>, RecordingError> {
        let source = Source::file(acceleration).and_then(table);
        let source = source
            .ok()
            .filter(|it| Columns::begin(it, &reading()).is_ok());
        let found = match (source, &beside(acceleration)[..]) {
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

/// The table of a file, of whatever kind.
fn table(source: Source) -> Result<Source, RecordingError> {
    let reading = reading();
    let source = match archive::members(&source)? {
        Some(members) if sheet::is_book(&members) => sheet::table(&source, &members, &reading)?,
        Some(members) => archive::table(&source, &members, &reading)?,
        None => source,
    };
    json::table(source, &reading)
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
fn beside(acceleration: &Path) -> Vec<PathBuf> {
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

/// The place of the column with the pressure, or else with an altitude.
pub(super) fn column(columns: &[Column]) -> Option<usize> {
    let units = |of: &Column| {
        UNITS
            .iter()
            .find(|(unit, _)| unit_name(&of.name).as_deref() == Some(unit))
    };
    let is_pressure = |of: &&Column| {
        let unit = units(of).map(|(_, unit)| *unit);
        unit.is_some_and(|unit| unit != PressureUnit::Metres)
            || unit.is_none() && is_one(&PRESSURES, &of.name)
    };
    let is_altitude = |of: &&Column| is_one(&ALTITUDES, &of.name);
    let place = |is_it: &dyn Fn(&&Column) -> bool| columns.iter().position(|of| is_it(&of));
    place(&is_pressure).or_else(|| place(&is_altitude))
}

/// The unit in brackets behind a name.
fn unit_name(name: &str) -> Option<String> {
    let (_, unit) = name.trim_end_matches([')', ']']).rsplit_once(['(', '['])?;
    Some(unit.trim().to_lowercase())
}

fn is_one(parts: &[&str], name: &str) -> bool {
    let name = name.to_lowercase();
    parts.iter().any(|part| name.contains(part))
}

fn is_on_earth(pascal: f64) -> bool {
    (ON_EARTH.0..=ON_EARTH.1).contains(&pascal)
}
