//! `detector.calibrate`: false, true, or the noise to calibrate on.

use crate::signal::{Law, Noise, Sensor, SensorChoice};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use std::fmt;

/// The source of a threshold.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Calibration {
    /// The exact law.
    #[default]
    None,
    /// A pilot that promises α under every law of a list.
    Promise,
    /// A pilot that measures the false-alarm rate with one noise; parts left out in a file are the point's own.
    Measured {
        /// The sensor of that noise.
        sensor: Option<Sensor>,
        /// Its law.
        noise: Option<Noise>,
    },
}

/// The noise to calibrate on, where it is not the point's own.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Measured {
    /// The law of the noise.
    #[schemars(with = "Option<Law>")]
    law: Option<Noise>,
    /// The sensor.
    #[schemars(with = "Option<SensorChoice>")]
    sensor: Option<Sensor>,
}

impl Calibration {
    /// Fills in the parts of a measurement that were left out, from the point's own noise.
    pub(super) fn completed(self, own_sensor: &Sensor, own_noise: Noise) -> Self {
        match self {
            Self::Measured { sensor, noise } => Self::Measured {
                sensor: sensor.or_else(|| Some(own_sensor.clone())),
                noise: noise.or(Some(own_noise)),
            },
            other => other,
        }
    }
}

impl<'de> Deserialize<'de> for Calibration {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CalibrationVisitor)
    }
}

struct CalibrationVisitor;

impl<'de> Visitor<'de> for CalibrationVisitor {
    type Value = Calibration;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("true, false or a table such as { law = \"normal\" }")
    }

    fn visit_bool<E>(self, promises: bool) -> Result<Calibration, E> {
        Ok(if promises {
            Calibration::Promise
        } else {
            Calibration::None
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Calibration, A::Error> {
        let Measured { law, sensor } = Measured::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Calibration::Measured { sensor, noise: law })
    }
}

impl JsonSchema for Calibration {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Calibration".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let measured = generator.subschema_for::<Measured>();
        schemars::json_schema!({ "anyOf": [{ "type": "boolean" }, measured] })
    }
}

impl fmt::Display for Calibration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("no"),
            Self::Promise => f.write_str("promise"),
            Self::Measured {
                sensor: Some(sensor),
                noise: Some(noise),
            } => {
                write!(f, "measured({sensor} {noise})")
            }
            Self::Measured { .. } => f.write_str("measured"),
        }
    }
}
