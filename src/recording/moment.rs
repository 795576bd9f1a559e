//! Moments of the calendar, as RFC 3339 writes them.

use super::error::RecordingProblem;
use super::stamp::{self, Zone};
use jiff::Timestamp;
use jiff::fmt::temporal::DateTimePrinter;
use jiff::tz::Offset;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use std::str::FromStr;

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

    /// How long after `zero` it is, s. Without a zone it is read on the clock of `zero`; `None` if only that has none.
    fn since(self, zero: Self) -> Option<f64> {
        let ahead = match (self.zone, zero.zone) {
            (Zone::Local, Zone::Offset(offset)) => offset.seconds(),
            (Zone::Local, _) | (Zone::Utc | Zone::Offset(_), Zone::Utc | Zone::Offset(_)) => 0,
            (_, Zone::Local) => return None,
        };
        let nanoseconds = self.nanoseconds.saturating_sub(zero.nanoseconds);
        Some(nanoseconds as f64 / 1e9 - f64::from(ahead))
    }

    fn read(text: &str) -> Option<Self> {
        let stamp = stamp::read(text.as_bytes()).filter(|stamp| stamp.has_date)?;
        Some(Self::new(stamp.nanoseconds, stamp.zone))
    }
}

/// A time of a record: as it is printed, or by the calendar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// s.
    Seconds(f64),
    /// Of a record that has dates.
    At(Moment),
}

impl When {
    /// As it is printed, s, where `zero` is the moment of time 0.
    pub(super) fn seconds(self, zero: Option<Moment>) -> Result<f64, RecordingProblem> {
        let (rule, remedy) = match (self, zero) {
            (Self::Seconds(seconds), _) => return Ok(seconds),
            (Self::At(_), None) => (
                "--from and --to must be in s: the times of this record have no date",
                "as times are printed",
            ),
            (Self::At(moment), Some(zero)) => match moment.since(zero) {
                Some(seconds) => return Ok(seconds),
                None => (
                    "--from and --to must have no zone: the times of this record have none",
                    "leave Z or the offset out",
                ),
            },
        };
        Err(RecordingProblem::must(rule, self, remedy))
    }
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Seconds(seconds) => seconds.fmt(f),
            Self::At(moment) => moment.fmt(f),
        }
    }
}

impl FromStr for When {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.parse::<f64>() {
            Ok(seconds) if seconds.is_finite() => Ok(Self::Seconds(seconds)),
            _ => Moment::read(text)
                .map(Self::At)
                .ok_or("must be in s, or a date and a time such as 2026-11-30T14:05:00"),
        }
    }
}

impl Serialize for When {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Seconds(seconds) => seconds.serialize(serializer),
            Self::At(moment) => moment.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for When {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Seconds(f64),
            Text(String),
        }
        match Written::deserialize(deserializer)? {
            Written::Seconds(seconds) => Ok(Self::Seconds(seconds)),
            Written::Text(text) => text.parse().map_err(de::Error::custom),
        }
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
        Self::read(&text).ok_or_else(|| de::Error::custom("must be a date and a time of RFC 3339"))
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

    /// Between zones, and on the clock of the record.
    #[test]
    fn times_of_a_record() {
        let moment = |text: &str| Moment::read(text).unwrap();
        let seconds = |text: &str, zero| {
            let when: When = text.parse().unwrap();
            when.seconds(zero).map_err(|error| error.to_string())
        };
        let summer = Some(moment("2026-07-01T12:00:00+02:00"));
        let (utc, local) = (
            Some(moment("2026-07-01T10:00:00Z")),
            Some(moment("2026-07-01T12:00:00")),
        );
        for zero in [summer, utc] {
            assert_eq!(seconds("2026-07-01T10:00:30.5Z", zero), Ok(30.5));
            assert_eq!(seconds("2026-07-01T05:59:00-04:00", zero), Ok(-60.0));
        }
        assert_eq!(seconds("2026-07-01T12:00:01", summer), Ok(1.0));
        assert_eq!(seconds("2026-07-01T10:00:01", utc), Ok(1.0));
        assert_eq!(seconds("2026-07-01T12:00:01", local), Ok(1.0));
        assert!(
            seconds("2026-07-01T10:00:01Z", local)
                .unwrap_err()
                .contains("must have no zone")
        );
        assert!(
            seconds("2026-07-01T10:00:01Z", None)
                .unwrap_err()
                .contains("no date")
        );
        assert_eq!(seconds("-1.5", None), Ok(-1.5));
        for text in ["", "inf", "NaN", "noon", "12:00", "2026-07-01"] {
            assert!(text.parse::<When>().is_err(), "{text}");
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
