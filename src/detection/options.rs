//! The file of `detect --config` and `monitor --config`: how a recording is read, and the settings of the monitor.
//!
//! Every key has a default; an unknown one is refused.

use crate::config::{ConfigError, Node, Source};
use crate::fields::names;
use crate::monitor::Settings;
use crate::recording::{Axis, Reading, TimeUnit, Unit, When};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use std::fmt::Display;
use std::path::Path;
use std::str::FromStr;

/// How a recording is read, and how it is watched.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub struct MonitorOptions {
    pub reading: Reading,
    pub settings: Settings,
}

/// The one table that is none of [`Settings`].
const RECORDING: &str = "recording";

/// `[recording]`: how a recording is read.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RecordingTable {
    /// The column of times, by its name.
    time: Option<String>,
    /// The column of accelerations, by its name.
    acceleration: Option<String>,
    /// Of the times: s, ms, us or ns.
    #[serde(deserialize_with = "named")]
    #[schemars(with = "Option<String>")]
    time_unit: Option<TimeUnit>,
    /// Of the accelerations: m/s^2, g, mg or counts.
    unit: Option<String>,
    /// m/s² a count.
    scale: Option<f64>,
    /// The count at 0 m/s².
    offset: Option<f64>,
    /// Which axis is vertical: auto, gravity, x, y, z, -x, -y or -z.
    #[serde(deserialize_with = "named")]
    #[schemars(with = "Option<String>")]
    axis: Option<Axis>,
    /// Whether to turn the vertical upside down.
    invert: Option<bool>,
    /// The time to begin at, s as printed, or a moment where the recording has dates.
    #[schemars(schema_with = "time")]
    from: Option<When>,
    /// The time to end at.
    #[schemars(schema_with = "time")]
    to: Option<When>,
    /// Rows per second, where they are evenly spaced; their times are then not read.
    rate: Option<f64>,
    /// Samples per second to resample to.
    resample: Option<f64>,
    /// The file in an archive.
    member: Option<String>,
}

impl MonitorOptions {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// Where it cannot be read, is not TOML, or has an unknown key or a value out of its range.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::from_source(&Source::load(path)?)
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`MonitorOptions::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        Self::from_source(&Source::new(name, text))
    }

    fn from_source(source: &Source) -> Result<Self, ConfigError> {
        let tree = source.parse()?;
        let known = [RECORDING].iter().chain(names::<Settings>()).copied();
        if let Some((span, among)) = tree.unknown(known) {
            return Err(source.at(Some(span), format!("unknown key {among}")));
        }
        let settings: Settings = source.read(&tree.only(|key| key != RECORDING), "")?;
        let recording: RecordingTable = match tree.get(RECORDING) {
            Some(table) => source.read(table, RECORDING)?,
            None => RecordingTable::default(),
        };
        let span = |path: &str| tree.get(path).map(|node| node.span.clone());
        (settings.check()).map_err(|error| source.at(span(error.key()), error))?;
        Ok(Self {
            reading: recording.reading(source, &tree)?,
            settings,
        })
    }
}

impl RecordingTable {
    fn reading(self, source: &Source, tree: &Node) -> Result<Reading, ConfigError> {
        let unit = Unit::told(self.unit.as_deref(), self.scale, self.offset);
        let unit = unit.map_err(|error| {
            let mut keys = [error.key(), "unit", "offset"].into_iter();
            let place = keys.find_map(|key| tree.get(&format!("recording.{key}")));
            source.at(
                place.map(|node| node.span.clone()),
                format!("recording.{error}"),
            )
        })?;
        Ok(Reading {
            unit: unit.unwrap_or_default(),
            time: self.time,
            acceleration: self.acceleration,
            time_unit: self.time_unit,
            axis: self.axis.unwrap_or_default(),
            invert: self.invert.unwrap_or_default(),
            from: self.from,
            to: self.to,
            rate: self.rate,
            resample: self.resample,
            member: self.member,
            ..Reading::default()
        })
    }
}

/// Seconds, or a moment as text.
fn time(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": ["number", "string", "null"] })
}

/// What its own type reads from a name.
fn named<'de, T: FromStr<Err: Display>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    let name = String::deserialize(deserializer)?;
    name.parse().map(Some).map_err(D::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(lines: &str) -> Result<Reading, String> {
        let read = MonitorOptions::parse("lift.toml", &format!("[recording]\n{lines}"));
        read.map(|config| config.reading)
            .map_err(|error| error.to_string())
    }

    #[test]
    fn names_are_those_of_the_recording() {
        let read = reading(
            "time_unit = \"ms\"\nunit = \"counts\"\nscale = 0.5\noffset = 9\naxis = \"gravity\"",
        );
        let expected = Reading {
            time_unit: Some(TimeUnit::Milliseconds),
            unit: Unit::Counts {
                scale: 0.5,
                offset: 9.0,
            },
            axis: Axis::Gravity,
            ..Reading::default()
        };
        assert_eq!(read, Ok(expected));
    }

    #[test]
    fn refusals_point_at_the_value() {
        for (lines, message) in [
            (
                "unit = \"g\"\nscale = 0.5",
                "lift.toml:3:9: recording.scale: is for counts alone, the unit is g",
            ),
            (
                "offset = 9.0",
                "lift.toml:2:10: recording.unit: counts need a scale",
            ),
            (
                "unit = \"counts\"",
                "lift.toml:2:8: recording.unit: counts need a scale",
            ),
            (
                "unit = \"ft\"",
                "lift.toml:2:8: recording.unit: must be m/s^2, g, mg or counts, got \"ft\"",
            ),
            (
                "scale = 0.0",
                "lift.toml:2:9: recording.unit: scale must be between",
            ),
            (
                "time_unit = \"h\"",
                "lift.toml:2:13: recording.time_unit: must be s, ms, us or ns, got \"h\"",
            ),
            (
                "axis = \"up\"",
                "lift.toml:2:8: recording.axis: must be auto, x, y, z, -x, -y, -z or gravity, got \"up\"",
            ),
        ] {
            let refused = reading(lines).unwrap_err();
            assert!(refused.contains(message), "{lines}: {refused}");
        }
    }
}
