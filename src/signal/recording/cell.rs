//! A cell of a table, read as a number.

/// The content of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cell {
    /// Nothing: the sensor was not read in this row.
    Blank,
    /// A finite number.
    Number(f64),
    /// NaN, an infinity, or a number beyond the range of a double.
    NotFinite,
    /// Anything else.
    Text,
}

/// The longest text read as a number, bytes.
const LONGEST_NUMBER: usize = 64;

impl Cell {
    /// Reads a cell whose decimal mark is a point.
    #[inline]
    pub fn read(cell: &[u8]) -> Self {
        let cell = cell.trim_ascii();
        if cell.is_empty() {
            return Self::Blank;
        }
        if cell.len() > LONGEST_NUMBER {
            return Self::Text;
        }
        match std::str::from_utf8(cell).map(str::parse::<f64>) {
            Ok(Ok(number)) if number.is_finite() => Self::Number(number),
            Ok(Ok(_)) => Self::NotFinite,
            _ => Self::Text,
        }
    }

    /// Reads a cell whose decimal mark is a comma.
    pub fn read_with_comma(cell: &[u8]) -> Self {
        let cell = cell.trim_ascii();
        if cell.len() > LONGEST_NUMBER || cell.contains(&b'.') {
            return Self::Text;
        }
        let mut copy = [0; LONGEST_NUMBER];
        let copy = &mut copy[..cell.len()];
        copy.copy_from_slice(cell);
        copy.iter_mut()
            .filter(|c| **c == b',')
            .for_each(|c| *c = b'.');
        Self::read(copy)
    }
}

/// The decimal mark of a file, learnt from the first cell that has one. If cells are separated by commas it
/// is a point. A file that uses both is refused, since "1,234" would then be ambiguous.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
        match self {
            Self::Comma => Cell::read_with_comma(cell),
            _ => Cell::read(cell),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_what_is_none() {
        assert_eq!(Cell::read(b" -1.5E-3 "), Cell::Number(-1.5e-3));
        assert_eq!(Cell::read(b" \t"), Cell::Blank);
        for text in ["NaN", "-inf", "1e999"] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::NotFinite, "{text}");
        }
        for text in ["1.234E", "9,81", "0x10", "1 2", "\u{2212}1"] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::Text, "{text}");
        }
        assert_eq!(Cell::read(&[b'1'; 65]), Cell::Text);
        assert_eq!(Cell::read(&[0xff]), Cell::Text);
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
