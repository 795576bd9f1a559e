//! How a recording is to be read; whatever is left open is found in the file.

use super::axis::Axis;
use super::error::RecordingProblem;
use std::fmt;

/// How a file is to be read. The default finds everything.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The name of the time column. Columns of a file without a header are named "1", "2", ….
    pub time: Option<String>,
    /// The name of the one column that holds the vertical acceleration.
    pub acceleration: Option<String>,
    /// What time is counted in.
    pub time_unit: Option<TimeUnit>,
    /// What acceleration is counted in.
    pub unit: Unit,
    /// Which way is up, where a file has three axes.
    pub axis: Axis,
    /// Hz, of a uniform grid to bring the signal to; as recorded where absent.
    pub resample: Option<f64>,
    /// The file to read within a zip archive.
    pub member: Option<String>,
}

/// What time is counted in.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
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
    /// The unit of a name: s, ms, us or ns.
    pub fn from_name(name: &str) -> Option<Self> {
        match name.trim().to_lowercase().as_str() {
            "s" | "sec" | "secs" | "second" | "seconds" => Some(Self::Seconds),
            "ms" | "msec" | "millis" | "milliseconds" => Some(Self::Milliseconds),
            "us" | "\u{b5}s" | "\u{3bc}s" | "micros" | "microseconds" => Some(Self::Microseconds),
            "ns" | "nanos" | "nanoseconds" => Some(Self::Nanoseconds),
            _ => None,
        }
    }

    /// How many of them make a second. Dividing by it keeps 20 ms the double nearest to 0.02 s, which
    /// multiplying by 0.001 would not.
    pub(super) fn per_second(self) -> f64 {
        match self {
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e3,
            Self::Microseconds => 1e6,
            Self::Nanoseconds => 1e9,
        }
    }
}

impl fmt::Display for TimeUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Seconds => "s",
            Self::Milliseconds => "ms",
            Self::Microseconds => "us",
            Self::Nanoseconds => "ns",
        })
    }
}

/// Standard gravity, m/s².
pub(super) const GRAVITY: f64 = 9.80665;

/// What acceleration is counted in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Unit {
    /// As the header says; m/s² where it says nothing.
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
        /// m/s² a count; negative where counts fall as acceleration rises.
        scale: f64,
        /// The count of no acceleration.
        offset: f64,
    },
}

impl Unit {
    /// The unit of a name: m/s^2, g or mg, in their usual spellings.
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
    pub(super) fn convert(self, reading: f64) -> f64 {
        match self {
            Self::Found | Self::MetresPerSecondSquared => reading,
            Self::Gravity => reading * GRAVITY,
            Self::Milligravity => reading * (GRAVITY / 1000.0),
            Self::Counts { scale, offset } => (reading - offset) * scale,
        }
    }

    /// # Errors
    /// Where a scale or an offset is no number to calculate with.
    pub(super) fn check(self) -> Result<(), RecordingProblem> {
        let Self::Counts { scale, offset } = self else {
            return Ok(());
        };
        let refused = |name, rule, got| Err(RecordingProblem::Counts { name, rule, got });
        match () {
            () if !(1e-12..=1e12).contains(&scale.abs()) => {
                refused("scale", "between 1e-12 and 1e12 in size", scale)
            }
            () if offset.is_nan() || offset.abs() > 1e15 => {
                refused("offset", "at most 1e15 in size", offset)
            }
            () => Ok(()),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found | Self::MetresPerSecondSquared => f.write_str("m/s^2"),
            Self::Gravity => f.write_str("g"),
            Self::Milligravity => f.write_str("mg"),
            Self::Counts { scale, offset } => {
                write!(f, "counts of {scale} m/s^2, zero at {offset}")
            }
        }
    }
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
        assert_eq!(20.0 / TimeUnit::Milliseconds.per_second(), 0.02);
    }

    #[test]
    fn names_are_known() {
        assert_eq!(TimeUnit::from_name(" MS"), Some(TimeUnit::Milliseconds));
        assert_eq!(TimeUnit::from_name("h"), None);
        assert_eq!(Unit::from_name("m/s²"), Some(Unit::MetresPerSecondSquared));
        assert_eq!(Unit::from_name("rad/s"), None);
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
