//! Moments of the calendar, as RFC 3339 writes them.

use super::stamp::{self, Zone};
use jiff::Timestamp;
use jiff::fmt::temporal::DateTimePrinter;
use jiff::tz::Offset;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;

/// A moment, to the millisecond, or as fine as it was read.
///
/// Where it was read with a zone it is written in that zone. Without one it is the time of some clock on a wall: it is
/// written without a zone, and runs on evenly, though that clock may have been changed.
///
/// ```
/// use liftsim::recording::{Reading, Recording};
///
/// let text = "time,z\n2026-10-25T02:59:59.5+02:00,9.8\n2026-10-25T02:00:00.5+01:00,9.9\n";
/// let recording = Recording::from_bytes("example", text.as_bytes(), &Reading::default())?;
/// assert_eq!(recording.samples()[1].time, 1.0);
/// let zero = recording.facts().clock_zero.expect("the clock has dates");
/// assert_eq!(zero.to_string(), "2026-10-25T02:59:59.500+02:00");
/// assert_eq!(zero.after(1.0).to_string(), "2026-10-25T03:00:00.500+02:00");
/// # Ok::<(), liftsim::recording::RecordingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    /// Since 1970 by UTC, or by the clock on the wall.
    nanoseconds: i64,
    zone: Zone,
}

const MILLISECOND: i64 = 1_000_000;

impl Moment {
    pub(super) fn new(nanoseconds: i64, zone: Zone) -> Self {
        Self { nanoseconds, zone }
    }

    /// So many days after 1970 began by a clock on the wall, to the microsecond: a workbook resolves no less.
    pub(super) fn of_days(days: f64) -> Self {
        Self::new((86_400e6 * days).round() as i64 * 1000, Zone::Local)
    }

    /// So many seconds later, to the millisecond.
    #[must_use]
    pub fn after(self, seconds: f64) -> Self {
        let later = self.nanoseconds.saturating_add((1e9 * seconds) as i64);
        let past =
            (later.saturating_add(MILLISECOND / 2)).rem_euclid(MILLISECOND) - MILLISECOND / 2;
        Self::new(later - past, self.zone)
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_fine = self.nanoseconds % MILLISECOND != 0;
        let printer = DateTimePrinter::new().precision(Some(if is_fine { 9 } else { 3 }));
        let moment = Timestamp::from_nanosecond(self.nanoseconds.into());
        let moment = moment.map_err(|_| fmt::Error)?;
        f.write_str(&match self.zone {
            Zone::Local => printer.datetime_to_string(&Offset::UTC.to_datetime(moment)),
            Zone::Utc => printer.timestamp_to_string(&moment),
            Zone::Offset(offset) => printer.timestamp_with_offset_to_string(&moment, offset),
        })
    }
}

impl Serialize for Moment {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Moment {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let stamp = stamp::read(text.as_bytes()).filter(|stamp| stamp.has_date);
        let moment = stamp.map(|stamp| Self::new(stamp.nanoseconds, stamp.zone));
        moment.ok_or_else(|| de::Error::custom("must be a date and a time of RFC 3339"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written is read as the same moment.
    #[test]
    fn there_and_back() {
        for text in [
            "2013-11-25T12:30:00.000Z",
            "2013-11-25T12:30:00.005+02:00",
            "2013-11-25T12:30:00.005",
            "2013-11-25T12:30:00.123456789-09:30",
            "1969-12-31T23:59:59.999Z",
            "2024-02-29T23:59:59.999+05:45",
        ] {
            let json = format!("\"{text}\"");
            let moment: Moment = serde_json::from_str(&json).unwrap();
            assert_eq!(serde_json::to_string(&moment).unwrap(), json);
        }
        for text in ["14:23:00", "2013-11-25", "noon", "2013-02-30T00:00:00Z"] {
            let json = format!("\"{text}\"");
            assert!(serde_json::from_str::<Moment>(&json).is_err(), "{text}");
        }
    }

    #[test]
    fn later_and_earlier() {
        let zero = Moment::new(-1_500_000, Zone::Utc);
        assert_eq!(zero.to_string(), "1969-12-31T23:59:59.998500000Z");
        assert_eq!(zero.after(0.0).to_string(), "1969-12-31T23:59:59.999Z");
        assert_eq!(zero.after(0.0016).to_string(), "1970-01-01T00:00:00.000Z");
        assert_eq!(zero.after(86400.0).to_string(), "1970-01-01T23:59:59.999Z");
        assert_eq!(zero.after(-1.0).to_string(), "1969-12-31T23:59:58.999Z");
    }
}
