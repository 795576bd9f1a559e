//! Dates and times of day as text.

/// A moment as text, ns: since 1970 if it has a date, else since midnight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stamp {
    pub nanoseconds: i64,
    pub has_date: bool,
}

/// A day, ns.
pub(super) const DAY: i64 = 86_400_000_000_000;

/// Reads `2023-10-24T14:23:00.005Z`, `24-Oct-2023 14:23:00.005`, `24.10.2023 14:23:00`, `14:23:00.005` and the
/// like. Of `10/24/2023` and `24/10/2023` the first number is the month, unless it is above 12. Zones are left
/// out: only differences of times matter.
pub(super) fn read(cell: &[u8]) -> Option<Stamp> {
    let text = std::str::from_utf8(cell).ok()?.trim();
    if text.len() > 40 || !text.contains(':') || !text.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let (date, time) = match text.split_once(['T', ' ']) {
        Some((date, time)) => (Some(date), time.trim_start()),
        None => (None, text),
    };
    let days = date.map(days).unwrap_or(Some(0))?;
    Some(Stamp {
        nanoseconds: days * DAY + time_of_day(time)?,
        has_date: date.is_some(),
    })
}

/// `14:23:00.005`, with or without a zone, ns.
fn time_of_day(text: &str) -> Option<i64> {
    let text = text
        .strip_suffix('Z')
        .or(text.strip_suffix(" UTC"))
        .unwrap_or(text);
    let text = text
        .split_once(['+', '-'])
        .map_or(text, |(time, _zone)| time);
    let mut parts = text.trim_end().splitn(3, ':');
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
    Some(seconds * 1_000_000_000 + fraction)
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
    if year < 1900 || month == 0 || day == 0 {
        return None;
    }
    // Years that begin in March end with the leap day.
    let (year, month) = if month < 3 {
        (year - 1, month + 9)
    } else {
        (year, month - 3)
    };
    let leaps = year / 4 - year / 100 + year / 400;
    Some(365 * year + leaps + (153 * month + 2) / 5 + day - 719_469)
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
            "25.11.2013 12:30:00",
            "11/25/2013 12:30:00",
            "25/11/2013 12:30:00",
            "2013/11/25 12:30:00+02:00",
        ] {
            assert_eq!(seconds(text), Some(1385382600.0), "{text}");
        }
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
            "9999-01-01 00:00:00",
            "1:2:3.4.5",
            "a:b:c",
        ] {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
