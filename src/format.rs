//! Numbers as a typesetter writes them.

/// 200000 as 200 000, with thin spaces.
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

/// Eight significant digits: more than any count supports, fewer than the last bits of a bisection.
pub fn eight_digits(value: f64) -> f64 {
    format!("{value:.7e}").parse().unwrap_or(value)
}

/// A hyphen is no minus.
pub fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// At most 200 characters of what a user wrote, for a message.
pub fn shortened(text: &str) -> std::borrow::Cow<'_, str> {
    const MOST: usize = 200;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
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
}
