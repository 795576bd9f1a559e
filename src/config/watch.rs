//! What `detect` and `monitor` are told: how a recording is read, and the settings of the monitor.
//!
//! Every key has a default; an unknown one is refused.

use super::error::{ConfigError, Problem, Source};
use super::value::{Number, Whole};
use crate::monitor::{Settings, SettingsError};
use crate::signal::recording::{Axis, Reading, TimeUnit, Unit};
use serde::Deserialize;
use serde::de::{Deserializer, Error, Visitor};
use std::fmt;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// How a recording is read, and how it is watched.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WatchConfig {
    /// What the file is told about its columns.
    pub reading: Reading,
    /// What the monitor is told.
    pub settings: Settings,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WatchFile {
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
    time_unit: Option<TimeUnitName>,
    unit: Option<UnitName>,
    scale: Option<Number>,
    offset: Option<Number>,
    axis: Option<AxisName>,
    resample: Option<Number>,
    member: Option<String>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
enum TimeUnitName {
    #[serde(rename = "s")]
    Seconds,
    #[serde(rename = "ms")]
    Milliseconds,
    #[serde(rename = "us")]
    Microseconds,
    #[serde(rename = "ns")]
    Nanoseconds,
}

#[derive(Clone, Copy, Debug, Deserialize)]
enum UnitName {
    #[serde(rename = "m/s^2")]
    MetresPerSecondSquared,
    #[serde(rename = "g")]
    Gravity,
    #[serde(rename = "mg")]
    Milligravity,
    #[serde(rename = "counts")]
    Counts,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum AxisName {
    Auto,
    X,
    Y,
    Z,
    Gravity,
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

impl WatchConfig {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// Where it cannot be read, is no TOML, has a key that means nothing, or a value out of its range.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        match std::fs::read_to_string(path) {
            Ok(text) => Self::parse(&name, &text),
            Err(error) => Err(Source::new(&name, "").at(None, Problem::Unreadable(error))),
        }
    }

    /// Checks a file's text; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`WatchConfig::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ConfigError> {
        let source = Source::new(name, text);
        let file: WatchFile = source.read()?;
        let settings = file.settings();
        settings
            .check()
            .map_err(|error| source.at(file.place(&error), Problem::Watch(error)))?;
        Ok(Self {
            reading: file.recording.reading(),
            settings,
        })
    }
}

impl WatchFile {
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
        fn span<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
            value.as_ref().map(Spanned::span)
        }
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
    fn reading(self) -> Reading {
        let number = |given: Option<Number>, default| given.map_or(default, |value| value.0);
        let counts = Unit::Counts {
            scale: number(self.scale, 1.0),
            offset: number(self.offset, 0.0),
        };
        Reading {
            time: self.time,
            acceleration: self.acceleration,
            time_unit: self.time_unit.map(|unit| match unit {
                TimeUnitName::Seconds => TimeUnit::Seconds,
                TimeUnitName::Milliseconds => TimeUnit::Milliseconds,
                TimeUnitName::Microseconds => TimeUnit::Microseconds,
                TimeUnitName::Nanoseconds => TimeUnit::Nanoseconds,
            }),
            unit: match self.unit {
                Some(UnitName::MetresPerSecondSquared) => Unit::MetresPerSecondSquared,
                Some(UnitName::Gravity) => Unit::Gravity,
                Some(UnitName::Milligravity) => Unit::Milligravity,
                Some(UnitName::Counts) => counts,
                None if self.scale.is_some() || self.offset.is_some() => counts,
                None => Unit::Found,
            },
            axis: match self.axis.unwrap_or(AxisName::Auto) {
                AxisName::Auto => Axis::Auto,
                AxisName::X => Axis::X,
                AxisName::Y => Axis::Y,
                AxisName::Z => Axis::Z,
                AxisName::Gravity => Axis::Gravity,
            },
            resample: self.resample.map(|rate| rate.0),
            member: self.member,
        }
    }
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
