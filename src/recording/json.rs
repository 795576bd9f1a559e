//! JSON as a table of text: an array of readings, as Sensor Logger exports, or one object a line.

use super::cell::shorten;
use super::error::{Names, RecordingError, RecordingProblem};
use super::lines::Lines;
use super::reading::Reading;
use super::source::Source;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt;
use std::io::BufRead;

/// The largest JSON, bytes, of which its numbers are a part.
const LARGEST: u64 = 1 << 30;

/// The most keys of an object, and the most sensors.
const MOST: usize = 64;

/// The source itself, unless it is JSON.
///
/// # Errors
/// If it is JSON of another kind, or has no accelerometer.
pub(super) fn table(source: Source, reading: &Reading) -> Result<Source, RecordingError> {
    let unreadable = |error| source.error(None, RecordingProblem::Unreadable(error));
    let mut text = source.text()?;
    let start = text.fill_buf().map_err(unreadable)?.trim_ascii_start();
    let is_array = start.starts_with(b"[");
    if !is_array && !start.starts_with(b"{") {
        return match &reading.member {
            Some(member) if source.member().is_none() => {
                Err(source.error(None, RecordingProblem::NotAnArchive(member.clone())))
            }
            _ => Ok(source),
        };
    }
    if source.size() > LARGEST {
        return Err(source.error(None, too_large()));
    }
    if is_array {
        return of_array(&source, reading);
    }
    let table = of_lines(text).map_err(|(line, problem)| source.error(line, problem))?;
    Ok(source.converted(table, None, 1))
}

fn too_large() -> RecordingProblem {
    RecordingProblem::Json("must be at most 1 GB large, as a table too".to_owned())
}

/// Messages name the element of the array where they name a line.
fn of_array(source: &Source, reading: &Reading) -> Result<Source, RecordingError> {
    let sensor = |object: &Map<String, Value>| match object.get("sensor") {
        Some(Value::String(sensor)) => sensor.clone(),
        _ => String::new(),
    };
    let refused = |problem| source.error(None, problem);
    let mut sensors = BTreeSet::new();
    each(source, |object| {
        if sensors.len() < MOST {
            sensors.insert(sensor(&object));
        }
    })?;
    let wanted = match &reading.member {
        Some(member) => sensors.get(member),
        // The one with gravity shows which way is up.
        None => [
            "TotalAcceleration",
            "Accelerometer",
            "AccelerometerUncalibrated",
            "",
        ]
        .iter()
        .find_map(|name| sensors.get(*name)),
    };
    let Some(wanted) = wanted else {
        let names = Names(sensors.into_iter().collect());
        return Err(refused(RecordingProblem::NoSensor(names)));
    };
    let mut table = Table::default();
    each(source, |object| {
        if sensor(&object) == *wanted {
            table.row(&object);
        } else {
            table.text.push(b'\n');
        }
    })?;
    let member = Some(&**wanted).filter(|name| !name.is_empty());
    let table = table.whole().map_err(refused)?;
    Ok(source.converted(table, member, 1))
}

/// Hands every object of an array over as it is read.
fn each(source: &Source, mut take: impl FnMut(Map<String, Value>)) -> Result<(), RecordingError> {
    struct Objects<'a>(&'a mut dyn FnMut(Map<String, Value>));
    impl<'de> DeserializeSeed<'de> for Objects<'_> {
        type Value = ();
        fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
            deserializer.deserialize_seq(self)
        }
    }
    impl<'de> Visitor<'de> for Objects<'_> {
        type Value = ();
        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("an array of readings")
        }
        fn visit_seq<A: SeqAccess<'de>>(self, mut array: A) -> Result<(), A::Error> {
            while let Some(object) = array.next_element()? {
                (self.0)(object);
            }
            Ok(())
        }
    }
    let mut json = serde_json::Deserializer::from_reader(source.text()?);
    let read = Objects(&mut take)
        .deserialize(&mut json)
        .and_then(|()| json.end());
    read.map_err(|error| source.error(None, RecordingProblem::Json(error.to_string())))
}

fn of_lines(text: impl BufRead) -> Result<Vec<u8>, (Option<u64>, RecordingProblem)> {
    let mut lines = Lines::new(text);
    let mut table = Table::default();
    loop {
        let number = lines.number() + 1;
        let line = match lines.next() {
            Ok(Some(line)) => line,
            Ok(None) => return table.whole().map_err(|problem| (None, problem)),
            Err(reason) => return Err((Some(number), reason.into())),
        };
        if line.bytes.trim_ascii().is_empty() {
            table.text.push(b'\n');
            continue;
        }
        match serde_json::from_slice(line.bytes) {
            Ok(object) => table.row(&object),
            // The file was cut off; a line with too few cells says so.
            Err(_) if !line.is_ended && number > 2 => table.text.extend(b"{"),
            Err(error) => {
                let got = shorten(line.bytes);
                let problem = RecordingProblem::Json(format!("{error}, got \"{got}\""));
                return Err((Some(number), problem));
            }
        }
    }
}

/// A table whose columns are the keys of the first object.
#[derive(Default)]
struct Table {
    keys: Vec<String>,
    text: Vec<u8>,
}

impl Table {
    fn row(&mut self, object: &Map<String, Value>) {
        // Short objects may stand for many blank cells; `whole` refuses what is cut here.
        if self.text.len() as u64 > LARGEST {
            return;
        }
        let mut cells = Vec::new();
        flatten("", object, &mut cells);
        if self.keys.is_empty() {
            self.keys = cells
                .iter()
                .take(MOST)
                .map(|(key, _)| key.clone())
                .collect();
        }
        for (place, key) in self.keys.iter().enumerate() {
            if place > 0 {
                self.text.push(b'\t');
            }
            let cell = cells.iter().find(|(name, _)| name == key);
            self.text
                .extend(cell.map_or("", |(_, cell)| cell).as_bytes());
        }
        self.text.push(b'\n');
    }

    /// With the line of names.
    fn whole(mut self) -> Result<Vec<u8>, RecordingProblem> {
        if self.text.len() as u64 > LARGEST {
            return Err(too_large());
        }
        let names = self.keys.join("\t") + "\n";
        self.text.splice(..0, names.into_bytes());
        Ok(self.text)
    }
}

/// Numbers and texts with the keys on the way to them, joined by points.
fn flatten(path: &str, object: &Map<String, Value>, cells: &mut Vec<(String, String)>) {
    let clean = |text: &str| text.replace(|c: char| c.is_control() || c == '"', " ");
    for (key, value) in object {
        let path = format!("{path}{}", clean(key));
        match value {
            Value::Object(inner) => flatten(&format!("{path}."), inner, cells),
            Value::String(text) => cells.push((path, clean(text))),
            Value::Number(number) => cells.push((path, number.to_string())),
            Value::Null | Value::Bool(_) | Value::Array(_) => cells.push((path, String::new())),
        }
    }
}
