//! Typeset numbers and shortened texts.

use std::borrow::Cow;

/// Groups digits by thin spaces: 200 000.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// Rounds to eight significant digits: more than any count supports, and free of the last bits of a bisection.
pub fn eight_digits(value: f64) -> f64 {
    format!("{value:.7e}").parse().unwrap_or(value)
}

/// A number in a message.
pub fn brief(number: f64) -> String {
    shorten(&number.to_string()).into_owned()
}

/// A message in which the number that was got stands as it was written: `got 1.50`, not `got 1.5`.
pub fn as_written(message: String, written: &str) -> String {
    let number = written.replace('_', "").parse::<f64>();
    let Some(number) = number.ok().filter(|number| number.is_finite()) else {
        return message;
    };
    let got = format!("got {}", brief(number));
    let is_whole = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '.');
    match message.split_once(&got) {
        Some((before, rest)) if is_whole(rest) => {
            format!("{before}got {}{rest}", shorten(written))
        }
        _ => message,
    }
}

/// Writes the hyphen of a number as a minus sign.
pub fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// The most characters of user input that a message repeats.
const MOST_SHOWN: usize = 200;

/// The most characters of a number that a message writes out; those of a usual f64 are fewer.
const MOST_DIGITS: usize = 24;

/// `text`, or its two ends if it is too long for a message; a long number as a power of ten.
pub fn shorten(text: &str) -> Cow<'_, str> {
    let length = text.chars().count();
    if length > MOST_DIGITS
        && let Ok(number) = text.parse::<f64>()
        && number.is_finite()
    {
        return format!("{number:e}").into();
    }
    if length <= MOST_SHOWN {
        return text.into();
    }
    let tail = MOST_SHOWN / 3;
    let head: String = text.chars().take(MOST_SHOWN - tail - 1).collect();
    let tail: String = text.chars().skip(length - tail).collect();
    format!("{head}…{tail}").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_a_typesetter_writes_them() {
        assert_eq!(thousands(1_234_567), "1\u{2009}234\u{2009}567");
        assert_eq!(thousands(999), "999");
        assert_eq!(minus("-1e-7"), "−1e−7");
    }

    #[test]
    fn numbers_stay_as_they_were_written() {
        let said = |message: &str, written| as_written(message.to_owned(), written);
        assert_eq!(
            said("must be 1, got 1.5 (x)", "1.50"),
            "must be 1, got 1.50 (x)"
        );
        assert_eq!(said("a, got 100000", "1e5"), "a, got 1e5");
        assert_eq!(said("a, got 10", "1_0.00"), "a, got 1_0.00");
        for other in ["a, got 1.55", "a, got 1.5e9", "a, got \"1.5\"", "1.5"] {
            assert_eq!(said(other, "1.50"), other);
        }
        assert_eq!(said("a, got NaN", "nan"), "a, got NaN");
        assert_eq!(said("a, got b", "b"), "a, got b");
    }

    #[test]
    fn long_text_is_shortened() {
        let (fits, long) = ("ä".repeat(200), "ä".repeat(1_000_000) + "end");
        assert_eq!(shorten(&fits), fits);
        for number in [1e-300, -1e300, 1e-30] {
            assert_eq!(shorten(&number.to_string()), format!("{number:e}"));
        }
        assert_eq!(shorten("-0.0001234567890123456"), "-0.0001234567890123456");
        let short = shorten(&long);
        assert_eq!(short.chars().count(), 200);
        assert!(short.starts_with("ää") && short.contains("ä…ä") && short.ends_with("äend"));
    }
}
