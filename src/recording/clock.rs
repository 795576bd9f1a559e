//! The time column: numbers in some unit, or dates and times as text.

use super::cell::{Cell, DecimalMark};
use super::stamp::{self, DAY};
use super::unit::TimeUnit;
use serde::{Deserialize, Serialize};

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
            Some(stamp) => Ok(Some(self.text(stamp))),
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
        if self.is_shifted && first / self.unit().per_second() > EPOCH {
            self.origin = first;
        }
    }

    fn text(&mut self, stamp: stamp::Stamp) -> f64 {
        let moment = stamp.nanoseconds;
        if self.is_text.is_none() {
            self.is_text = Some(true);
            self.last_text = moment;
            if self.is_shifted {
                self.text_origin = moment;
            }
        }
        // Midnight.
        if !stamp.has_date && moment < self.last_text - DAY / 2 {
            self.added_text = self.added_text.saturating_add(DAY);
        }
        self.last_text = moment;
        (moment - self.text_origin).saturating_add(self.added_text) as f64 / 1e9
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

    #[test]
    fn one_kind_of_time() {
        let mut clock = Clock::of_file(None);
        assert_eq!(clock.read(b""), Ok(None));
        assert_eq!(clock.read(b"0.5"), Ok(Some(0.5)));
        assert_eq!(clock.read(b"14:23:00"), Err(Cell::Text));
        assert_eq!(clock.read(b"inf"), Err(Cell::Infinite));
        let mut stream = Clock::of_stream(None);
        assert_eq!(stream.read(b"1434934563.5"), Ok(Some(1434934563.5)));
    }
}
