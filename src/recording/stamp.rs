//! Dates and times of day as text.

use jiff::civil::Date;
use jiff::tz::Offset;
use serde::{Deserialize, Serialize};

/// The zone that a text is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Zone {
    /// None is written: what the clocks on the wall say, wherever that is.
    #[default]
    Local,
    /// `Z`
    Utc,
    /// `+02:00`
    Offset(#[serde(with = "in_seconds")] Offset),
}

/// An offset as it is saved: the seconds from UTC.
mod in_seconds {
    use jiff::tz::Offset;
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::Serializer;

    pub fn serialize<S: Serializer>(offset: &Offset, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_i32(offset.seconds())
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Offset, D::Error> {
        let seconds = i32::deserialize(deserializer)?;
        Offset::from_seconds(seconds).map_err(D::Error::custom)
    }
}

/// A moment as text, ns: since 1970 if it has a date, else since midnight. With a zone it is by UTC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stamp {
    pub nanoseconds: i64,
    pub zone: Zone,
    pub has_date: bool,
}

/// A day, ns.
pub(super) const DAY: i64 = 86_400_000_000_000;

/// Reads RFC 3339 (`2023-10-24T14:23:00.005+02:00`), `24-Oct-2023 14:23:00.005`, `24.10.2023 14:23:00`, `14:23:00.005`
/// and the like. Of `10/24/2023` and `24/10/2023` the first number is the month, unless it is above 12. The second 60 of a
/// minute is the first of the next, since clocks count no leap seconds.
pub(super) fn read(cell: &[u8]) -> Option<Stamp> {
    let text = std::str::from_utf8(cell).ok()?.trim();
    if text.len() > 40 || !text.contains(':') || !text.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    // Not the letter of a month.
    let is_between = |at: &usize| text.as_bytes()[at - 1].is_ascii_digit();
    let mut places = text.match_indices(['T', 't', ' ']).map(|(at, _)| at);
    let (date, time) = match places.find(is_between) {
        Some(at) => (Some(&text[..at]), text[at + 1..].trim_start()),
        None => (None, text),
    };
    let days = date.map(days).unwrap_or(Some(0))?;
    let end = time.find(|c: char| !c.is_ascii_digit() && !matches!(c, ':' | '.' | ','));
    let (time, written) = time.split_at(end.unwrap_or(time.len()));
    let zone = zone(written.trim())?;
    let ahead = match zone {
        Zone::Offset(offset) => i64::from(offset.seconds()) * SECOND,
        Zone::Utc | Zone::Local => 0,
    };
    Some(Stamp {
        nanoseconds: days * DAY + time_of_day(time)? - ahead,
        zone,
        has_date: date.is_some(),
    })
}

const SECOND: i64 = 1_000_000_000;

/// `14:23:00.005`, ns.
fn time_of_day(text: &str) -> Option<i64> {
    let mut parts = text.splitn(3, ':');
    let hours = number(parts.next()?, 23)?;
    let minutes = number(parts.next()?, 59)?;
    let seconds = parts.next()?;
    let (seconds, fraction) = seconds.split_once(['.', ',']).unwrap_or((seconds, ""));
    let seconds = (hours * 60 + minutes) * 60 + number(seconds, 60)?;
    if fraction.len() > 12 || !fraction.bytes().all(|c| c.is_ascii_digit()) {
        return None;
    }
    let digits = &fraction[..fraction.len().min(9)];
    let fraction = digits.parse().unwrap_or(0) * 10i64.pow(9 - digits.len() as u32);
    Some(seconds * SECOND + fraction)
}

/// Nothing, `Z`, `UTC`, `+02:00`, `+0200` or `+02`; the name of a place behind it says no more.
fn zone(text: &str) -> Option<Zone> {
    let text = text.split_once('[').map_or(text, |(zone, _place)| zone);
    if !text.is_ascii() {
        return None;
    }
    let sign = match text {
        "" => return Some(Zone::Local),
        "Z" | "z" | "UTC" | "GMT" => return Some(Zone::Utc),
        _ if text.starts_with('+') => 1,
        _ if text.starts_with('-') => -1,
        _ => return None,
    };
    let (hours, minutes) = match text[1..].split_once(':') {
        Some(parts) => parts,
        None if text.len() == 5 => (&text[1..3], &text[3..]),
        None => (&text[1..], "0"),
    };
    let minutes = number(hours, 23)? * 60 + number(minutes, 59)?;
    let offset = Offset::from_seconds(sign * 60 * minutes as i32);
    offset.ok().map(Zone::Offset)
}

/// A date in days since 1970.
fn days(text: &str) -> Option<i64> {
    let parts: Vec<&str> = text.split(['-', '/', '.']).collect();
    let [a, b, c] = parts[..] else { return None };
    let (year, month, day) = match (a.len(), number(b, 12)) {
        (4, month) => (number(a, 2199)?, month?, number(c, 31)?),
        (_, None) if b.len() == 3 => (number(c, 2199)?, named_month(b)?, number(a, 31)?),
        (_, Some(month)) if !text.contains('/') || number(a, 12).is_none() => {
            (number(c, 2199)?, month, number(a, 31)?)
        }
        (_, _) => (number(c, 2199)?, number(a, 12)?, number(b, 31)?),
    };
    let date = Date::new(year as i16, month as i8, day as i8).ok()?;
    let since = date.duration_since(Date::constant(1970, 1, 1)).as_secs();
    (year >= 1900).then_some(since / 86_400)
}

fn named_month(name: &str) -> Option<i64> {
    let months = "janfebmaraprmayjunjulaugsepoctnovdec";
    let place = months.find(&name.to_lowercase())?;
    (place % 3 == 0).then_some(place as i64 / 3 + 1)
}

fn number(text: &str, most: i64) -> Option<i64> {
    let is_number = (1..=4).contains(&text.len()) && text.bytes().all(|c| c.is_ascii_digit());
    text.parse()
        .ok()
        .filter(|number| is_number && *number <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times() {
        let seconds =
            |text: &str| read(text.as_bytes()).map(|stamp| stamp.nanoseconds as f64 / 1e9);
        // 2013-11-25 12:30:00 UTC is 1385382600.
        for text in [
            "2013-11-25T12:30:00Z",
            "2013-11-25 12:30:00",
            "25-Nov-2013 12:30:00.000",
            "25-NOV-2013T12:30:00",
            "25.11.2013 12:30:00",
            "11/25/2013 12:30:00",
            "25/11/2013 12:30:00",
            "2013-11-25t12:30:00z",
            "2013/11/25 14:30:00+02:00",
            "2013-11-25 14:30:00 +0200",
            "2013-11-25T03:00:00-09:30",
            "2013-11-26T02:30:00+14",
            "2013-11-25T13:30:00+01:00[Europe/Berlin]",
            "2013-11-25 12:29:60",
        ] {
            assert_eq!(seconds(text), Some(1385382600.0), "{text}");
        }
        assert_eq!(
            seconds("24-Oct-2023 00:00:00"),
            seconds("24-OCT-2023 00:00:00")
        );
        assert_eq!(seconds("24-Oct-2023 00:00:00"), Some(1698105600.0));
        assert_eq!(seconds("2000-03-01 00:00:00"), Some(951868800.0));
        assert_eq!(seconds("2000-02-29 00:00:00.5"), Some(951782400.5));
        assert_eq!(seconds("1970-01-01 00:00:00"), Some(0.0));
        assert_eq!(seconds("14:23:00.005"), Some(51780.005));
        assert!(!read(b"14:23:00").unwrap().has_date);
        for text in [
            "",
            "12:30",
            "25:00:00",
            "2013-13-01 00:00:00",
            "-1:2:3",
            "2013-02-30 00:00:00",
            "9999-01-01 00:00:00",
            "2013-11-25 12:30:00 CET",
            "2013-11-25 12:30:00+2:5:7",
            "2013-11-25 12:30:00+99:00",
            "2013-11-25 12:30:00 PM",
            "1:2:3.4.5",
            "a:b:c",
        ] {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
