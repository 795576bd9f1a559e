//! Numbers and places in words.

use super::Comparison;
use crate::format::{minus, thousands};

/// A number and its interval, `0.8231 [0.8214, 0.8248]`, with two digits of the half-width. An exact number stands alone; one
/// of which nothing is known says so.
pub fn interval(value: f64, low: f64, high: f64) -> String {
    if low == high {
        return exact(value);
    }
    if (low, high) == (f64::NEG_INFINITY, f64::INFINITY) {
        return format!("{} (no interval)", significant(value, 3));
    }
    let decimals = decimals(low, high);
    let [value, low, high] = [value, low, high].map(|number| fixed(number, decimals));
    format!("{value} [{low}, {high}]")
}

/// Six significant digits.
pub fn exact(value: f64) -> String {
    significant(value, 6)
}

/// So many significant digits without trailing zeros; tiny numbers as a power of ten.
fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return fixed(value, 0);
    }
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    if rounded != 0.0 && rounded.abs() < 1e-4 {
        minus(&format!("{rounded:e}"))
    } else {
        minus(&rounded.to_string())
    }
}

/// Decimals that show two digits of half the distance from `low` to `high`.
pub fn decimals(low: f64, high: f64) -> usize {
    let half_width = (high - low) / 2.0;
    if half_width.is_finite() && half_width > 0.0 {
        (1.0 - libm::log10(half_width).floor()).clamp(0.0, 12.0) as usize
    } else {
        2
    }
}

/// A number with `decimals` decimals; a number that rounds to zero has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    if value.is_nan() {
        return "unknown".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.to_owned();
    }
    let text = format!("{value:.decimals$}");
    match text.parse::<f64>() {
        Ok(0.0) => text.trim_start_matches('-').to_owned(),
        _ => minus(&text),
    }
}

/// `1 comparison`, `7 comparisons`.
pub fn count(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        _ => format!("{} {noun}s", thousands(number as u64)),
    }
}

/// The number of comparisons and whether they are paired: `7 paired comparisons`.
pub fn compared(comparisons: &[Comparison]) -> String {
    let paired = comparisons
        .iter()
        .filter(|c| c.first_only.is_some())
        .count();
    match paired {
        0 => count(comparisons.len(), "unpaired comparison"),
        all if all == comparisons.len() => count(all, "paired comparison"),
        some => format!(
            "{}, {some} of them paired",
            count(comparisons.len(), "comparison")
        ),
    }
}

/// `curve 5` for a number, `"known filter"` for a name.
pub fn curve(label: &str) -> String {
    match label.parse::<f64>() {
        Ok(_) => format!("curve {label}"),
        Err(_) => format!("\"{label}\""),
    }
}

/// `; 14 of 32 comparisons are counter-examples, the worst at Δ/σ_ξ = 0.6`, or an empty text without counter-examples.
pub fn counter_examples(number: usize, all: usize, noun: &str, worst: Option<String>) -> String {
    let all = count(all, noun);
    let at = worst.map(|worst| match number {
        1 => format!(", at {worst}"),
        _ => format!(", the worst at {worst}"),
    });
    let at = at.unwrap_or_default();
    match number {
        0 => String::new(),
        1 => format!("; 1 of {all} is a counter-example{at}"),
        _ => format!("; {number} of {all} are counter-examples{at}"),
    }
}
