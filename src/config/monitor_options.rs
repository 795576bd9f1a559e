//! What `detect` and `monitor` are told: how a recording is read, and the settings of the monitor.
//!
//! Every key has a default; an unknown one is refused.

use super::error::Problem;
use super::source::{ConfigError, Source};
use super::value::{Named, Number, Whole};
use crate::monitor::{Settings, SettingsError};
use crate::signal::recording::{Axis, Reading, TimeUnit, Unit, UnitError};
use serde::Deserialize;
use serde::de::{Deserializer, Error, Visitor};
use std::fmt;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// How a recording is read, and how it is watched.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MonitorOptions {
    /// What the file is told about its columns.
    pub reading: Reading,
    /// What the monitor is told.
    pub settings: Settings,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct OptionsFile {
    recording: RecordingTable,
    samples: SamplesTable,
    whitening: WhiteningTable,
    detector: DetectorTable,
    monitor: MonitorTable,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct RecordingTable {
    time: Option<String>,
    acceleration: Option<String>,
    time_unit: Option<Named<TimeUnit>>,
    unit: Option<Spanned<String>>,
    scale: Option<Spanned<Number>>,
    offset: Option<Spanned<Number>>,
    axis: Option<Named<Axis>>,
    resample: Option<Number>,
    member: Option<String>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SamplesTable {
    reference: Option<Spanned<Whole>>,
    shift: Option<Spanned<Whole>>,
    scale: Option<Spanned<Whole>>,
    gap: Option<Spanned<Whole>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WhiteningTable {
    order: Option<Spanned<OrderValue>>,
    training: Option<Spanned<Whole>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct DetectorTable {
    alpha: Option<Spanned<Number>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct MonitorTable {
    block: Option<Spanned<Number>>,
    least_speed: Option<Spanned<Number>>,
    least_acceleration: Option<Spanned<Number>>,
    most_acceleration: Option<Spanned<Number>>,
    longest_motion: Option<Spanned<Number>>,
    longest_slack: Option<Spanned<Number>>,
}

/// `"auto"`, or a whole number.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OrderValue(Option<usize>);

impl MonitorOptions {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// Where it cannot be read, is no TOML, has a key that means nothing, or a value out of its range.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::from_source(Source::load(path)?)
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`MonitorOptions::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        Self::from_source(Source::new(name, text))
    }

    fn from_source(source: Source) -> Result<Self, ConfigError> {
        let file: OptionsFile = source.read_all()?;
        let settings = file.settings();
        settings
            .check()
            .map_err(|error| source.at(file.place(&error), Problem::Watch(error)))?;
        Ok(Self {
            reading: file.recording.reading(&source)?,
            settings,
        })
    }
}

impl OptionsFile {
    fn settings(&self) -> Settings {
        let number = |given: &Option<Spanned<Number>>, default: f64| {
            given.as_ref().map_or(default, |value| value.get_ref().0)
        };
        let size = |given: &Option<Spanned<Whole>>, default: usize| {
            (given.as_ref()).map_or(default, |value| value.get_ref().size())
        };
        let default = Settings::default();
        let (samples, monitor) = (&self.samples, &self.monitor);
        let order = self.whitening.order.as_ref();
        Settings {
            block: number(&monitor.block, default.block),
            reference: size(&samples.reference, default.reference),
            shift: size(&samples.shift, default.shift),
            scale: size(&samples.scale, default.scale),
            gap: size(&samples.gap, default.gap),
            alpha: number(&self.detector.alpha, default.alpha),
            training: size(&self.whitening.training, default.training),
            order: order.map_or(default.order, |order| order.get_ref().0),
            least_speed: number(&monitor.least_speed, default.least_speed),
            least_acceleration: number(&monitor.least_acceleration, default.least_acceleration),
            most_acceleration: number(&monitor.most_acceleration, default.most_acceleration),
            longest_motion: number(&monitor.longest_motion, default.longest_motion),
            longest_slack: number(&monitor.longest_slack, default.longest_slack),
        }
    }

    /// Where the value stands that an error is about.
    fn place(&self, error: &SettingsError) -> Option<Range<usize>> {
        let (samples, monitor) = (&self.samples, &self.monitor);
        match error.key() {
            "reference" => span(&samples.reference),
            "shift" => span(&samples.shift),
            "scale" => span(&samples.scale),
            "gap" => span(&samples.gap),
            "order" => span(&self.whitening.order),
            "training" => span(&self.whitening.training),
            "alpha" => span(&self.detector.alpha),
            "block" => span(&monitor.block),
            "least_speed" => span(&monitor.least_speed),
            "least_acceleration" => span(&monitor.least_acceleration),
            "most_acceleration" => span(&monitor.most_acceleration),
            "longest_motion" => span(&monitor.longest_motion),
            "longest_slack" => span(&monitor.longest_slack),
            _ => None,
        }
    }
}

impl RecordingTable {
    fn reading(self, source: &Source) -> Result<Reading, ConfigError> {
        let unit = self.unit().map_err(|error| {
            let place = match error.key() {
                "scale" => span(&self.scale),
                "offset" => span(&self.offset),
                _ => span(&self.unit).or(span(&self.offset)),
            };
            source.at(place, Problem::Unit(error))
        })?;
        Ok(Reading {
            unit: unit.unwrap_or_default(),
            time: self.time,
            acceleration: self.acceleration,
            time_unit: self.time_unit.map(|unit| unit.0),
            axis: self.axis.map_or_else(Axis::default, |axis| axis.0),
            resample: self.resample.map(|rate| rate.0),
            member: self.member,
        })
    }

    fn unit(&self) -> Result<Option<Unit>, UnitError> {
        let number = |given: &Option<Spanned<Number>>| given.as_ref().map(|n| n.get_ref().0);
        let name = self.unit.as_ref().map(|name| name.get_ref().as_str());
        Unit::told(name, number(&self.scale), number(&self.offset))
    }
}

/// Where a value stands.
fn span<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
    value.as_ref().map(Spanned::span)
}

impl<'de> Deserialize<'de> for OrderValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OrderVisitor;
        impl Visitor<'_> for OrderVisitor {
            type Value = OrderValue;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("\"auto\" or a whole number")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<OrderValue, E> {
                usize::try_from(value)
                    .map(|order| OrderValue(Some(order)))
                    .map_err(|_| E::invalid_value(serde::de::Unexpected::Signed(value), &self))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<OrderValue, E> {
                match value {
                    "auto" => Ok(OrderValue(None)),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(value), &self)),
                }
            }
        }
        deserializer.deserialize_any(OrderVisitor)
    }
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
                "lift.toml:2:8: recording.axis: must be auto, x, y, z or gravity, got \"up\"",
            ),
        ] {
            let refused = reading(lines).unwrap_err();
            assert!(refused.contains(message), "{lines}: {refused}");
        }
    }
}
