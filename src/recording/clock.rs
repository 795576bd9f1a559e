//! The time column: numbers in some unit, or dates and times as text.

use super::cell::{Cell, DecimalMark};
use super::moment::Moment;
use super::stamp::{self, DAY, Stamp, Zone};
use super::unit::TimeUnit;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Reads the cells of a time column one after another.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Clock {
    /// As the file or the reader says.
    stated: Option<TimeUnit>,
    /// By the size of the first time, which is since 1970.
    found: Option<TimeUnit>,
    /// Whether large times count from the first.
    is_shifted: bool,
    /// Whether times are text; none read yet if `None`.
    is_text: Option<bool>,
    /// Whether they are dates, and in which zone.
    zone: Option<Zone>,
    mark: DecimalMark,
    /// Subtracted: numbers in their unit, text in ns.
    origin: f64,
    text_origin: i64,
    /// As written, with what wraps have added.
    last: f64,
    last_text: i64,
    added: f64,
    added_text: i64,
    pub wraps: u64,
}

/// A counter of 32 bits begins again at 0.
const WRAP: f64 = 4_294_967_296.0;

/// A start beyond this many seconds, three years, is a date.
const EPOCH: f64 = 1e8;

/// Since 1970, s, from 2001 to 2096. Others may count from elsewhere: Apple's clocks do from 2001.
const SINCE_1970: Range<f64> = 1e9..4e9;

impl Clock {
    /// Of a file, in which times since 1970 count from the first.
    pub fn of_file(stated: Option<TimeUnit>) -> Self {
        Self {
            stated,
            is_shifted: true,
            ..Self::default()
        }
    }

    /// Of a stream, whose times stay as they are.
    pub fn of_stream(stated: Option<TimeUnit>) -> Self {
        Self {
            stated,
            ..Self::default()
        }
    }

    pub fn is_unit_stated(&self) -> bool {
        self.stated.or(self.found).is_some() || self.is_text == Some(true)
    }

    pub fn unit(&self) -> TimeUnit {
        self.stated.or(self.found).unwrap_or(TimeUnit::Seconds)
    }

    /// The time subtracted, s.
    pub fn offset(&self) -> Option<f64> {
        let offset = match self.is_text {
            Some(true) => self.text_origin as f64 / 1e9,
            _ => self.origin / self.unit().per_second(),
        };
        (offset != 0.0).then_some(offset)
    }

    /// The moment of time 0, where the clock has dates.
    pub fn zero(&self) -> Option<Moment> {
        let nanoseconds = match self.is_text {
            Some(true) => self.text_origin,
            // No number resolves less than a microsecond.
            _ => (1e6 * self.origin / self.unit().per_second()).round() as i64 * 1000,
        };
        self.zone.map(|zone| Moment::new(nanoseconds, zone))
    }

    /// The time in a cell, s.
    #[inline]
    pub fn read(&mut self, cell: &[u8]) -> Result<Option<f64>, Cell> {
        if self.is_text != Some(true) {
            match self.mark.read(cell) {
                Cell::Number(number) => return Ok(Some(self.number(number))),
                Cell::Blank | Cell::Missing => return Ok(None),
                Cell::Text if self.is_text.is_none() => {}
                refused => return Err(refused),
            }
        }
        match stamp::read(cell) {
            Some(stamp) => self.text(stamp).map(Some).ok_or(Cell::Text),
            None if cell.trim_ascii().is_empty() => Ok(None),
            None => Err(Cell::Text),
        }
    }

    fn number(&mut self, number: f64) -> f64 {
        if self.is_text.is_none() {
            self.is_text = Some(false);
            self.begin(number);
        }
        let may_wrap = self.stated != Some(TimeUnit::Seconds) && self.last < WRAP;
        if may_wrap && self.last > WRAP * 15.0 / 16.0 && (0.0..WRAP / 16.0).contains(&number) {
            self.added += WRAP;
            self.wraps += 1;
        }
        self.last = number;
        (number - self.origin + self.added) / self.unit().per_second()
    }

    fn begin(&mut self, first: f64) {
        // From 2001 to 2096 in ms, us and ns.
        let unit = [
            (1e12, TimeUnit::Milliseconds),
            (1e15, TimeUnit::Microseconds),
            (1e18, TimeUnit::Nanoseconds),
        ];
        let found = unit
            .into_iter()
            .find(|(size, _)| (*size..4.0 * size).contains(&first));
        self.found = found.map(|(_, unit)| unit);
        let seconds = first / self.unit().per_second();
        if self.is_shifted && seconds > EPOCH {
            self.origin = first;
        }
        self.zone = SINCE_1970.contains(&seconds).then_some(Zone::Utc);
    }

    /// The time of a stamp, s; none if it has a zone and the first had none, or the other way round.
    fn text(&mut self, stamp: Stamp) -> Option<f64> {
        let moment = stamp.nanoseconds;
        if self.is_text.is_none() {
            self.is_text = Some(true);
            self.zone = stamp.has_date.then_some(stamp.zone);
            self.last_text = moment;
            if self.is_shifted {
                self.text_origin = moment;
            }
        }
        let has_zone = |zone: Zone| zone != Zone::Local;
        let zone = stamp.has_date.then_some(stamp.zone);
        if zone.map(has_zone) != self.zone.map(has_zone) {
            return None;
        }
        // Midnight.
        if !stamp.has_date && moment < self.last_text - DAY / 2 {
            self.added_text = self.added_text.saturating_add(DAY);
        }
        self.last_text = moment;
        Some((moment - self.text_origin).saturating_add(self.added_text) as f64 / 1e9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(unit: Option<TimeUnit>, cells: &[&str]) -> Vec<f64> {
        let mut clock = Clock::of_file(unit);
        cells
            .iter()
            .map(|cell| clock.read(cell.as_bytes()).unwrap().unwrap())
            .collect()
    }

    #[test]
    fn numbers_keep_their_origin_unless_it_is_1970() {
        assert_eq!(
            all(Some(TimeUnit::Milliseconds), &["20", "40"]),
            [0.02, 0.04]
        );
        assert_eq!(all(None, &["1434934563", "1434934564.5"]), [0.0, 1.5]);
        assert_eq!(all(None, &["1434934563000", "1434934564500"]), [0.0, 1.5]);
        assert_eq!(
            all(None, &["1700000000000000000", "1700000001000000000"]),
            [0.0, 1.0]
        );
    }

    #[test]
    fn counters_wrap_and_days_end() {
        let times = all(
            Some(TimeUnit::Microseconds),
            &["4294960000", "4294967295", "7000"],
        );
        assert_eq!(times, [4294.96, 4294.967295, 4294.974296]);
        assert_eq!(all(None, &["23:59:59.5", "00:00:00.5"]), [0.0, 1.0]);
    }

    /// What a file with this first time calls time 0.
    fn zero(first: &str) -> Option<String> {
        let mut clock = Clock::of_file(None);
        clock.read(first.as_bytes()).unwrap();
        clock.zero().map(|zero| zero.to_string())
    }

    #[test]
    fn dates_have_a_zero() {
        for (first, expected) in [
            ("2013-11-25T12:30:00Z", "2013-11-25T12:30:00.000Z"),
            ("25.11.2013 12:30:00,5", "2013-11-25T12:30:00.500"),
            ("2013-11-25 12:30:00+02", "2013-11-25T12:30:00.000+02:00"),
            ("1385382600", "2013-11-25T12:30:00.000Z"),
            ("1385382600.005", "2013-11-25T12:30:00.005Z"),
            ("1385382600005", "2013-11-25T12:30:00.005Z"),
            ("1385382600005000", "2013-11-25T12:30:00.005Z"),
            ("1385382600005000000", "2013-11-25T12:30:00.005Z"),
        ] {
            assert_eq!(zero(first).as_deref(), Some(expected), "{first}");
        }
        // A time of day, a counter, Apple's seconds since 2001.
        for first in ["12:30:00", "0.5", "700000000.5"] {
            assert_eq!(zero(first), None, "{first}");
        }
        let mut stream = Clock::of_stream(None);
        let time = stream
            .read(b"2013-11-25T12:30:00.5+02:00")
            .unwrap()
            .unwrap();
        let moment = stream.zero().unwrap().after(time);
        assert_eq!(moment.to_string(), "2013-11-25T12:30:00.500+02:00");
    }

    /// An hour that comes twice is one hour with zones, and goes back without.
    #[test]
    fn days_and_clocks_change() {
        let zoned = ["2026-10-25T02:59:59+02:00", "2026-10-25T02:00:01+01:00"];
        assert_eq!(all(None, &zoned), [0.0, 2.0]);
        let local = ["2026-10-25 02:59:59", "2026-10-25 02:00:01"];
        assert_eq!(all(None, &local), [0.0, -3598.0]);
        let days = [
            "2024-02-28T23:59:59.5",
            "2024-02-29T00:00:00",
            "2024-03-01T00:00:00",
        ];
        assert_eq!(all(None, &days), [0.0, 0.5, 86400.5]);
        // Time goes back after a leap second, which is refused then.
        let leap = [
            "2016-12-31T23:59:59.5Z",
            "2016-12-31T23:59:60.5Z",
            "2017-01-01T00:00:00Z",
        ];
        assert_eq!(all(None, &leap), [0.0, 1.0, 0.5]);
    }

    #[test]
    fn one_kind_of_time() {
        let mut clock = Clock::of_file(None);
        assert_eq!(clock.read(b""), Ok(None));
        assert_eq!(clock.read(b"0.5"), Ok(Some(0.5)));
        assert_eq!(clock.read(b"14:23:00"), Err(Cell::Text));
        assert_eq!(clock.read(b"inf"), Err(Cell::Infinite));
        let mut stream = Clock::of_stream(None);
        assert_eq!(stream.read(b"1434934563.5"), Ok(Some(1434934563.5)));
        for (first, other) in [
            ("2013-11-25 12:30:00", "2013-11-25 12:30:00Z"),
            ("2013-11-25 12:30:00Z", "2013-11-25 12:30:00"),
            ("2013-11-25 12:30:00", "12:30:00"),
            ("12:30:00", "2013-11-25 12:30:00"),
        ] {
            let mut clock = Clock::of_file(None);
            assert!(clock.read(first.as_bytes()).is_ok());
            assert_eq!(clock.read(other.as_bytes()), Err(Cell::Text), "{other}");
        }
    }
}
