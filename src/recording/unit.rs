//! Units of time and of acceleration.

use super::axis::UnknownName;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A unit of time.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize, Deserialize)]
pub enum TimeUnit {
    /// s.
    Seconds,
    /// ms.
    Milliseconds,
    /// µs.
    Microseconds,
    /// ns.
    Nanoseconds,
}

impl TimeUnit {
    /// From the coarsest to the finest, with their names, the shown one first.
    pub(super) const NAMES: [(Self, &[&str]); 4] = [
        (Self::Seconds, &["s", "sec", "secs", "second", "seconds"]),
        (
            Self::Milliseconds,
            &["ms", "msec", "millis", "milliseconds"],
        ),
        (
            Self::Microseconds,
            &["us", "\u{b5}s", "\u{3bc}s", "micros", "microseconds"],
        ),
        (Self::Nanoseconds, &["ns", "nanos", "nanoseconds"]),
    ];

    /// The number of units in a second. Dividing by it turns 20 ms into the double nearest to 0.02 s, which
    /// multiplying by 0.001 would not.
    pub(super) fn per_second(self) -> f64 {
        [1.0, 1e3, 1e6, 1e9][self as usize]
    }
}

impl FromStr for TimeUnit {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let wanted = name.trim().to_lowercase();
        let found = (Self::NAMES.iter()).find(|(_, names)| names.contains(&&*wanted));
        let unknown = || UnknownName::new("s, ms, us or ns", name);
        found.map(|(unit, _)| *unit).ok_or_else(unknown)
    }
}

impl fmt::Display for TimeUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAMES[*self as usize].1[0])
    }
}

/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.80665;

/// A unit of acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Unit {
    /// The unit in the header, or m/s² by default.
    #[default]
    Found,
    /// m/s².
    MetresPerSecondSquared,
    /// g = 9.80665 m/s².
    Gravity,
    /// mg.
    Milligravity,
    /// Readings of a converter: (count − offset) · scale.
    Counts {
        /// m/s² per count; negative if counts fall as acceleration rises.
        scale: f64,
        /// The count at zero acceleration.
        offset: f64,
    },
}

/// Why a unit was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "what a message says is not said again")]
pub enum UnitError {
    #[error("unit: {0}")]
    Name(UnknownName),
    #[error("unit: counts need a scale (say how many m/s^2 one count is)")]
    NoScale,
    /// A scale or an offset for another unit than counts.
    #[error("{key}: is for counts alone, the unit is {unit} (leave one of them out)")]
    NotCounts { key: &'static str, unit: Unit },
    /// A scale or an offset out of range.
    #[error("unit: {key} must be {rule}, got {got}")]
    Counts {
        key: &'static str,
        rule: &'static str,
        got: f64,
    },
}

impl UnitError {
    /// The option at fault: unit, scale or offset.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Name(_) | Self::NoScale => "unit",
            Self::NotCounts { key, .. } | Self::Counts { key, .. } => key,
        }
    }
}

impl Unit {
    /// The unit from a user's options, or `None` without any. With a scale the name `counts` may be left out.
    ///
    /// # Errors
    /// If the name is unknown, counts have no scale, another unit has one, or a number is out of its range.
    pub fn told(
        name: Option<&str>,
        scale: Option<f64>,
        offset: Option<f64>,
    ) -> Result<Option<Self>, UnitError> {
        let of_counts = scale.map(|_| "scale").or(offset.map(|_| "offset"));
        let is_counts = |name: &&str| name.trim().eq_ignore_ascii_case("counts");
        if let Some(name) = name.filter(|name| !is_counts(name)) {
            let unknown = || UnitError::Name(UnknownName::new("m/s^2, g, mg or counts", name));
            let unit = Self::from_name(name).ok_or_else(unknown)?;
            return match of_counts {
                Some(key) => Err(UnitError::NotCounts { key, unit }),
                None => Ok(Some(unit)),
            };
        }
        if name.or(of_counts).is_none() {
            return Ok(None);
        }
        let (scale, offset) = (scale.ok_or(UnitError::NoScale)?, offset.unwrap_or(0.0));
        let counts = Self::Counts { scale, offset };
        counts.check().map(|()| Some(counts))
    }

    /// The unit with this name: m/s^2, g or mg, in the usual spellings.
    pub fn from_name(name: &str) -> Option<Self> {
        let name: String = name.to_lowercase().split_whitespace().collect();
        match name.as_str() {
            "m/s^2" | "m/s\u{b2}" | "m/s2" | "m/s/s" | "ms^-2" | "ms-2" | "m/s\u{fffd}" => {
                Some(Self::MetresPerSecondSquared)
            }
            "g" => Some(Self::Gravity),
            "mg" => Some(Self::Milligravity),
            _ => None,
        }
    }

    /// A reading in m/s².
    #[inline]
    pub fn convert(self, reading: f64) -> f64 {
        match self {
            Self::Found | Self::MetresPerSecondSquared => reading,
            Self::Gravity => reading * GRAVITY,
            Self::Milligravity => reading * (GRAVITY / 1000.0),
            Self::Counts { scale, offset } => (reading - offset) * scale,
        }
    }

    /// # Errors
    /// If a scale or an offset is out of range.
    pub(super) fn check(self) -> Result<(), UnitError> {
        let Self::Counts { scale, offset } = self else {
            return Ok(());
        };
        let (key, rule, got) = if !(1e-12..=1e12).contains(&scale.abs()) {
            ("scale", "between 1e-12 and 1e12 in size", scale)
        } else if offset.is_nan() || offset.abs() > 1e15 {
            ("offset", "at most 1e15 in size", offset)
        } else {
            return Ok(());
        };
        Err(UnitError::Counts { key, rule, got })
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found | Self::MetresPerSecondSquared => f.write_str("m/s^2"),
            Self::Gravity => f.write_str("g"),
            Self::Milligravity => f.write_str("mg"),
            Self::Counts { scale, offset } => {
                let [scale, offset] = [scale, offset].map(|number| six_digits(*number));
                write!(f, "counts of {scale} m/s^2, zero at {offset}")
            }
        }
    }
}

fn six_digits(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert() {
        assert_eq!(Unit::Gravity.convert(1.0), GRAVITY);
        assert!((Unit::Milligravity.convert(18.0) - 0.1765197).abs() < 1e-12);
        let counts = Unit::Counts {
            scale: -0.5,
            offset: 2048.0,
        };
        assert_eq!(counts.convert(2046.0), 1.0);
        let counts = Unit::Counts {
            scale: GRAVITY / 16384.0,
            offset: 0.0,
        };
        assert_eq!(counts.to_string(), "counts of 0.00059855 m/s^2, zero at 0");
        assert_eq!(20.0 / TimeUnit::Milliseconds.per_second(), 0.02);
    }

    #[test]
    fn names_are_known() {
        assert_eq!(" MS".parse(), Ok(TimeUnit::Milliseconds));
        let refused = "h".parse::<TimeUnit>().unwrap_err().to_string();
        assert_eq!(refused, "must be s, ms, us or ns, got \"h\"");
        assert_eq!(Unit::from_name("m/s²"), Some(Unit::MetresPerSecondSquared));
        assert_eq!(Unit::from_name("rad/s"), None);
    }

    #[test]
    fn words_of_a_unit() {
        let counts = |scale, offset| Ok(Some(Unit::Counts { scale, offset }));
        assert_eq!(Unit::told(None, None, None), Ok(None));
        assert_eq!(
            Unit::told(Some("mg"), None, None),
            Ok(Some(Unit::Milligravity))
        );
        assert_eq!(
            Unit::told(Some("counts"), Some(0.5), Some(9.0)),
            counts(0.5, 9.0)
        );
        assert_eq!(Unit::told(None, Some(0.5), None), counts(0.5, 0.0));
        let refused = |name, scale, offset| {
            let error = Unit::told(name, scale, offset).unwrap_err();
            (error.key(), error.to_string())
        };
        let no_scale = "unit: counts need a scale (say how many m/s^2 one count is)";
        for name in [None, Some("counts")] {
            assert_eq!(refused(name, None, Some(9.0)), ("unit", no_scale.into()));
        }
        let beside = "scale: is for counts alone, the unit is g (leave one of them out)";
        assert_eq!(
            refused(Some("g"), Some(0.5), Some(9.0)),
            ("scale", beside.into())
        );
        assert_eq!(refused(Some("g"), None, Some(9.0)).0, "offset");
        let unknown = "unit: must be m/s^2, g, mg or counts, got \"ft\"";
        assert_eq!(refused(Some("ft"), None, None), ("unit", unknown.into()));
        assert_eq!(refused(None, Some(0.0), None).0, "scale");
    }

    #[test]
    fn refusals() {
        let check = |scale, offset| {
            Unit::Counts { scale, offset }
                .check()
                .unwrap_err()
                .to_string()
        };
        assert!(check(0.0, 0.0).contains("scale"));
        assert!(check(f64::NAN, 0.0).contains("NaN"));
        assert!(check(1.0, f64::INFINITY).contains("offset"));
    }
}
