//! JSON as a table of text: an array of readings, as Sensor Logger exports, or one object a line.

use super::cell::shorten;
use super::error::{Located, Names, RecordingError, RecordingProblem};
use super::layout::Quantity;
use super::lines::{LONGEST_LINE, Lines};
use super::reading::Reading;
use super::source::Source;
use super::text_table::{LARGEST, MOST_COLUMNS, MOST_LETTERS, TextTable, too_large};
use serde::de::{DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt;
use std::io::BufRead;

/// The sensors to be read, the best first: the one with gravity shows which way is up.
const SENSORS: [&str; 4] = [
    "TotalAcceleration",
    "Accelerometer",
    "AccelerometerUncalibrated",
    "",
];

/// Those of a barometer.
const BAROMETERS: [&str; 1] = ["Barometer"];

/// The source itself, unless it is JSON.
///
/// # Errors
/// If it is JSON of another kind, or has no accelerometer.
pub(super) fn table(
    source: Source,
    reading: &Reading,
    quantity: Quantity,
) -> Result<Source, RecordingError> {
    let mut text = source.text()?;
    let start = text
        .fill_buf()
        .map_err(|error| source.error(None, error.into()))?;
    let start = start.trim_ascii_start().first().copied();
    match (start, &reading.member) {
        (Some(b'[' | b'{'), _) if source.size() > LARGEST as u64 => {
            Err(source.error(None, damaged(too_large())))
        }
        (Some(b'['), member) => {
            let (sensor, table) = of_array(text, member.as_deref(), quantity)
                .map_err(|problem| source.error(None, problem))?;
            let part = Some(&*sensor).filter(|sensor| !sensor.is_empty());
            Ok(source.converted(table, part, 1))
        }
        (Some(b'{'), _) => {
            let table = of_lines(text).map_err(|(line, problem)| source.error(line, problem))?;
            Ok(source.converted(table, None, 1))
        }
        (_, Some(member)) if source.part().is_none() => {
            let got = format!("\"{}\"", shorten(member.as_bytes()));
            let problem = RecordingProblem::must("has no members", got, "leave out --member");
            Err(source.error(None, problem))
        }
        _ => Ok(source),
    }
}

fn damaged(error: String) -> RecordingProblem {
    RecordingProblem::Damaged {
        what: "JSON",
        error,
        remedy: "export as CSV",
    }
}

/// The table of one sensor of an array, and its name. Messages name the element where they name a line.
fn of_array(
    text: impl BufRead,
    member: Option<&str>,
    quantity: Quantity,
) -> Result<(String, Vec<u8>), RecordingProblem> {
    let mut tables = Tables::default();
    let mut json = serde_json::Deserializer::from_reader(text);
    (&mut tables)
        .deserialize(&mut json)
        .and_then(|()| json.end())
        .map_err(|error| damaged(error.to_string()))?;
    let mut tables = tables.0;
    let sensors = match quantity {
        Quantity::Acceleration => &SENSORS[..],
        Quantity::Pressure => &BAROMETERS,
    };
    let wanted = match member {
        Some(member) => Some(member),
        None => sensors
            .iter()
            .copied()
            .find(|name| tables.contains_key(*name)),
    };
    if let Some((sensor, table)) = wanted.and_then(|sensor| tables.remove_entry(sensor)) {
        return Ok((sensor, table.whole()));
    }
    let names = tables.keys().map(String::as_str);
    Err(match member {
        Some(member) => RecordingProblem::unknown("member", member, names),
        None => RecordingProblem::Among {
            what: match quantity {
                Quantity::Acceleration => "JSON: no sensor is an accelerometer, there are",
                Quantity::Pressure => "JSON: no sensor is a barometer, there are",
            },
            names: Names::of(names),
            remedy: match quantity {
                Quantity::Acceleration => "--member NAME",
                Quantity::Pressure => "give the barometer's own table",
            },
        },
    })
}

/// The tables of all sensors, which are filled as the array is read.
#[derive(Default)]
struct Tables(BTreeMap<String, Table>);

impl<'de> DeserializeSeed<'de> for &mut Tables {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for &mut Tables {
    type Value = ();
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an array of readings")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut array: A) -> Result<(), A::Error> {
        let mut number = 0;
        while let Some(text) = array.next_element::<Box<RawValue>>()? {
            number += 1;
            let object = object(text.get().as_bytes()).map_err(A::Error::custom)?;
            let sensor = object.get("sensor").and_then(Value::as_str).unwrap_or("");
            if self.0.len() < MOST_COLUMNS || self.0.contains_key(sensor) {
                let table = self.0.entry(sensor.to_owned()).or_default();
                table.row(number, &object).map_err(A::Error::custom)?;
                let size: usize = self.0.values().map(|table| table.rows.size()).sum();
                if size > LARGEST {
                    return Err(A::Error::custom(too_large()));
                }
            }
        }
        Ok(())
    }
}

/// An object, of a size that bounds the memory it takes.
fn object(text: &[u8]) -> Result<Map<String, Value>, String> {
    if text.len() > LONGEST_LINE {
        return Err(format!(
            "a reading must be at most {LONGEST_LINE} bytes long"
        ));
    }
    serde_json::from_slice(text).map_err(|error| error.to_string())
}

fn of_lines(text: impl BufRead) -> Result<Vec<u8>, Located> {
    let mut lines = Lines::new(text);
    let mut table = Table::default();
    while let Some(line) = lines.next()? {
        let refused = |error: String| (Some(line.number), damaged(error));
        match object(line.bytes) {
            Ok(object) => table.row(line.number as usize, &object).map_err(refused)?,
            Err(_) if !line.is_ended && line.number > 1 => {
                table.rows.cut_off(line.number as usize).map_err(refused)?;
            }
            Err(error) => {
                let got = shorten(line.bytes);
                return Err(refused(format!("{error}, got \"{got}\"")));
            }
        }
    }
    Ok(table.whole())
}

/// A table whose columns are the keys of the first object.
#[derive(Default)]
struct Table {
    keys: Vec<String>,
    rows: TextTable,
}

impl Table {
    fn row(&mut self, number: usize, object: &Map<String, Value>) -> Result<(), String> {
        let mut cells = Vec::new();
        flatten("", object, &mut cells);
        if self.keys.is_empty() {
            let keys = cells.iter().take(MOST_COLUMNS);
            self.keys = keys.map(|(key, _)| key.clone()).collect();
        }
        self.rows.begin_row(number)?;
        for (place, key) in self.keys.iter().enumerate() {
            let cell = cells.iter().find(|(name, _)| name == key);
            self.rows.cell(place, cell.map_or("", |(_, cell)| cell))?;
        }
        self.rows.end_row(0);
        Ok(())
    }

    /// With the line of names.
    fn whole(self) -> Vec<u8> {
        let mut text = self.rows.into_text();
        let names = self.keys.join("\t") + "\n";
        text.splice(..0, names.into_bytes());
        text
    }
}

/// Numbers and texts with the keys on the way to them, joined by points.
fn flatten(path: &str, object: &Map<String, Value>, cells: &mut Vec<(String, String)>) {
    for (key, value) in object {
        let path: String = format!("{path}{key}").chars().take(MOST_LETTERS).collect();
        let path = path.replace(|c: char| c.is_control() || c == '"', " ");
        let cell = match value {
            Value::Object(inner) => {
                flatten(&format!("{path}."), inner, cells);
                continue;
            }
            Value::String(text) => text.clone(),
            Value::Number(number) => number.to_string(),
            Value::Null | Value::Bool(_) | Value::Array(_) => String::new(),
        };
        cells.push((path, cell));
    }
}
