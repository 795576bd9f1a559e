//! One cell of a table: a number, a time, nothing, or something else.

use serde::{Deserialize, Serialize};

/// The content of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cell {
    /// Nothing: the sensor was not read in this row.
    Blank,
    /// NaN, NA or null: the sensor was read and gave nothing.
    Missing,
    /// A finite number.
    Number(f64),
    /// An infinity, or a number beyond the range of a double.
    Infinite,
    /// Anything else.
    Text,
}

/// The longest text read as a number, bytes.
const LONGEST_NUMBER: usize = 64;

/// The decimal mark of a column, learnt from the first cell that has one. A column that uses both is refused,
/// since "1,234" would then be ambiguous; two columns may differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) enum DecimalMark {
    /// No cell has had one yet.
    #[default]
    Unknown,
    /// 9.81
    Point,
    /// 9,81
    Comma,
}

impl DecimalMark {
    /// Reads a cell and learns the mark from it.
    #[inline]
    pub fn read(&mut self, cell: &[u8]) -> Cell {
        if *self == Self::Unknown {
            *self = match cell.iter().find(|c| matches!(c, b'.' | b',')) {
                Some(b',') => Self::Comma,
                Some(_) => Self::Point,
                None => Self::Unknown,
            };
        }
        let mark = if *self == Self::Comma { b',' } else { b'.' };
        if let Some(number) = plain(cell, mark) {
            return Cell::Number(number);
        }
        if *self != Self::Comma {
            return read(cell);
        }
        if cell.len() > LONGEST_NUMBER || cell.contains(&b'.') {
            return Cell::Text;
        }
        let mut copy = [0; LONGEST_NUMBER];
        let copy = &mut copy[..cell.len()];
        copy.copy_from_slice(cell);
        for c in copy.iter_mut().filter(|c| **c == b',') {
            *c = b'.';
        }
        read(copy)
    }
}

/// The number in a cell of digits alone, with or without a sign and a decimal mark. A whole number below 2⁵³ and a
/// power of ten up to 10²² are exact, so that their quotient is the double nearest to the number (Clinger, How to read
/// floating point numbers accurately, 1990): what `str::parse` gives, in a third of the time.
#[inline]
fn plain(cell: &[u8], mark: u8) -> Option<f64> {
    let digits = cell.strip_prefix(b"-").unwrap_or(cell);
    // So many digits do not overflow.
    if digits.is_empty() || digits.len() > MOST_DIGITS {
        return None;
    }
    let (mut whole, mut decimals, mut has_mark) = (0u64, 0, false);
    for &c in digits {
        match c {
            b'0'..=b'9' => {
                whole = 10 * whole + u64::from(c - b'0');
                decimals += usize::from(has_mark);
            }
            _ if c == mark && !has_mark && digits.len() > 1 => has_mark = true,
            _ => return None,
        }
    }
    let number = whole as f64 / POWERS[decimals];
    let is_negative = digits.len() < cell.len();
    (whole < 1 << f64::MANTISSA_DIGITS).then_some(if is_negative { -number } else { number })
}

/// The most characters of a plain number.
const MOST_DIGITS: usize = 19;

const POWERS: [f64; MOST_DIGITS] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18,
];

/// Reads a cell whose decimal mark is a point.
fn read(cell: &[u8]) -> Cell {
    let cell = cell.trim_ascii();
    if cell.is_empty() {
        return Cell::Blank;
    }
    if cell.len() > LONGEST_NUMBER {
        return Cell::Text;
    }
    match std::str::from_utf8(cell).map(str::parse::<f64>) {
        Ok(Ok(number)) if number.is_finite() => Cell::Number(number),
        Ok(Ok(number)) if number.is_nan() => Cell::Missing,
        Ok(Ok(_)) => Cell::Infinite,
        _ if ["na", "n/a", "#n/a", "null"]
            .iter()
            .any(|word| is(cell, word)) =>
        {
            Cell::Missing
        }
        _ => Cell::Text,
    }
}

fn is(cell: &[u8], word: &str) -> bool {
    cell.eq_ignore_ascii_case(word.as_bytes())
}

/// The beginning of a text, with control characters escaped.
pub(super) fn shorten(text: &[u8]) -> String {
    const SHOWN: usize = 40;
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * SHOWN)]);
    let shown = text.chars().take(SHOWN);
    let mut short: String = shown
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(SHOWN).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// A plain number is what the standard library reads, to the bit.
        #[test]
        fn plain_numbers(text in "-?[0-9]{0,18}[.,]?[0-9]{0,18}") {
            let parsed = text.replace(',', ".").parse::<f64>().ok().map(f64::to_bits);
            let found = [b'.', b','].map(|mark| plain(text.as_bytes(), mark).map(f64::to_bits));
            for found in found {
                prop_assert!(found.is_none() || found == parsed, "{text}");
            }
            let digits = text.bytes().filter(u8::is_ascii_digit).count();
            prop_assert!(digits == 0 || digits > 15 || found != [None, None]);
        }
    }

    #[test]
    fn numbers_and_what_is_none() {
        assert_eq!(read(b" -1.5E-3 "), Cell::Number(-1.5e-3));
        assert_eq!(read(b" \t"), Cell::Blank);
        for text in ["NaN", "-nan", "NAN", "N/A", "null"] {
            assert_eq!(read(text.as_bytes()), Cell::Missing, "{text}");
        }
        for text in ["-inf", "1e999"] {
            assert_eq!(read(text.as_bytes()), Cell::Infinite, "{text}");
        }
        for text in ["1.234E", "9,81", "0x10", "1 2", "\u{2212}1"] {
            assert_eq!(read(text.as_bytes()), Cell::Text, "{text}");
        }
        assert_eq!(read(&[b'1'; 65]), Cell::Text);
        assert_eq!(read(&[0xff]), Cell::Text);
    }

    #[test]
    fn the_decimal_mark_is_learnt_and_kept() {
        let mut mark = DecimalMark::default();
        assert_eq!(mark.read(b"3"), Cell::Number(3.0));
        assert_eq!(mark.read(b"9,81"), Cell::Number(9.81));
        assert_eq!(mark.read(b"9.81"), Cell::Text);
        assert_eq!(mark.read(b"1,2,3"), Cell::Text);
        let mut mark = DecimalMark::default();
        assert_eq!(mark.read(b"9.81"), Cell::Number(9.81));
        assert_eq!(mark.read(b"9,81"), Cell::Text);
    }
}
