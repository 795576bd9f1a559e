//! The pressure of the air in the units in which it is recorded.

use super::names::Column;
use crate::stats::quantile::median;
use std::fmt;

/// A reading of a barometer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressure {
    /// s, by the file's clock.
    pub time: f64,
    /// Pa
    pub pascal: f64,
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
    pub(super) fn of(name: &str, readings: &[f64]) -> Option<Self> {
        if unit_name(name).is_some() {
            return Self::named(name);
        }
        if is_one(&ALTITUDES, name) && !is_one(&PRESSURES, name) {
            return Some(Self::Metres);
        }
        let median = median(readings.to_vec());
        let units = [Self::Pascal, Self::Hectopascal, Self::Kilopascal];
        units
            .into_iter()
            .find(|unit| is_on_earth(unit.pascal(median)))
    }

    /// That in brackets behind a name.
    fn named(name: &str) -> Option<Self> {
        let named = unit_name(name)?;
        let known = UNITS.iter().find(|(unit, _)| *unit == named);
        known.map(|(_, unit)| *unit)
    }

    pub(super) fn pascal(self, reading: f64) -> f64 {
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

/// The places of the columns with the pressure, or else with one in a unit that is not known, or else with an altitude.
pub(super) fn columns(columns: &[Column]) -> Vec<usize> {
    let rank = |of: &Column| {
        let is_named = is_one(&PRESSURES, &of.name);
        match (PressureUnit::named(&of.name), unit_name(&of.name)) {
            (Some(unit), _) if unit != PressureUnit::Metres => Some(0),
            (None, None) if is_named => Some(0),
            (None, Some(_)) if is_named => Some(1),
            _ => is_one(&ALTITUDES, &of.name).then_some(2),
        }
    };
    let ranks: Vec<Option<i32>> = columns.iter().map(rank).collect();
    let best = ranks.iter().flatten().min();
    let places =
        (0..columns.len()).filter(|place| best.is_some() && ranks[*place].as_ref() == best);
    places.collect()
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

pub(super) fn is_on_earth(pascal: f64) -> bool {
    (ON_EARTH.0..=ON_EARTH.1).contains(&pascal)
}
