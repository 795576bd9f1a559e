//! Numbers as a page prints them.

use crate::format::minus;
use crate::monitor::Direction;
use maud::{Markup, html};
use serde_json::Value;

/// With so many decimals; never "−0.00".
pub(super) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.contains(|digit| ('1'..='9').contains(&digit)) {
        minus(&text)
    } else {
        text.trim_start_matches('-').to_owned()
    }
}

/// A size that rounds to nothing is not nothing.
pub(super) fn size(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    let least = 0.1f64.powi(decimals as i32);
    if value > 0.0 && value < 0.5 * least {
        format!("< {least:.decimals$}")
    } else {
        text
    }
}

/// Decimals of a column of metres whose deviations are these: the smallest has two digits, down to a millimetre.
pub(super) fn decimals(deviations: impl IntoIterator<Item = f64>) -> usize {
    let least = deviations.into_iter().fold(f64::INFINITY, f64::min);
    if least < 0.095 { 3 } else { 2 }
}

/// A value and its standard deviation.
pub(super) fn within(value: f64, deviation: f64, decimals: usize) -> Markup {
    html! {
        (fixed(value, decimals))
        span.within { " ± " (size(deviation, decimals)) }
    }
}

/// A time of the recording's clock, s.
pub(super) fn time(time: Option<f64>) -> Markup {
    match time {
        Some(time) => html! { (fixed(time, 2)) },
        None => html! { span.none { "not recorded" } },
    }
}

/// What is not there.
pub(super) fn none() -> Markup {
    html! { span.none { "–" } }
}

pub(super) fn direction(direction: Direction) -> &'static str {
    match direction {
        Direction::Up => "↑ up",
        Direction::Down => "↓ down",
    }
}

/// "no ride", "1 ride", "2 rides".
pub(super) fn count(number: usize, one: &str, more: &str) -> String {
    match number {
        0 => format!("no {one}"),
        1 => format!("1 {one}"),
        _ => format!("{number} {more}"),
    }
}

/// A value of a config, to six digits.
pub(super) fn plain(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => {
            let rounded = format!("{:.5e}", number.as_f64().unwrap_or(f64::NAN));
            let rounded: f64 = rounded.parse().unwrap_or(f64::NAN);
            minus(&Value::from(rounded).to_string())
        }
        Value::Null => "none".to_owned(),
        Value::String(text) => text.clone(),
        value => minus(&value.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_say_what_they_are() {
        assert_eq!(fixed(-0.004, 2), "0.00");
        assert_eq!(fixed(-1.005, 1), "−1.0");
        assert_eq!(size(0.0004, 3), "< 0.001");
        assert_eq!(
            (size(0.0, 2), size(0.096, 2)),
            ("0.00".to_owned(), "0.10".to_owned())
        );
        assert_eq!(decimals([0.3, 0.02]), 3);
        assert_eq!((decimals([0.1]), decimals([])), (2, 2));
        assert_eq!(count(0, "ride", "rides"), "no ride");
    }
}
