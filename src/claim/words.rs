//! Numbers and places in words.

use crate::experiment::{Axis, Parameter};
use crate::format::{minus, thousands};
use crate::results::Comparison;

/// A number and its interval, `0.8231 [0.8214, 0.8248]`, with two digits of the half-width; an exact
/// number stands alone.
pub fn interval(value: f64, low: f64, high: f64) -> String {
    if low == high {
        return exact(value);
    }
    let decimals = decimals(low, high);
    let [value, low, high] = [value, low, high].map(|number| fixed(number, decimals));
    format!("{value} [{low}, {high}]")
}

/// Six significant digits, without noughts at the end; what is tiny as a power of ten.
pub fn exact(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded != 0.0 && rounded.abs() < 1e-4 {
        true => minus(&format!("{rounded:e}")),
        false => minus(&rounded.to_string()),
    }
}

/// Decimals that show two digits of half the distance from `low` to `high`.
pub fn decimals(low: f64, high: f64) -> usize {
    let half_width = (high - low) / 2.0;
    match half_width.is_finite() && half_width > 0.0 {
        true => (1.0 - libm::log10(half_width).floor()).clamp(0.0, 12.0) as usize,
        false => 2,
    }
}

/// A number with so many decimals; what rounds to nought has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
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

/// How many comparisons, and whether trial by trial: `7 paired comparisons`.
pub fn compared(comparisons: &[&Comparison]) -> String {
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

/// What an axis sweeps, as the paper writes it.
pub fn symbol(axis: Option<&Axis>) -> &'static str {
    match axis.map(|axis| axis.parameter) {
        None => "",
        Some(Parameter::Delta) => "Δ/σ_ξ",
        Some(Parameter::Nu) => "ν",
        Some(Parameter::Theta) => "θ/σ_ξ",
        Some(Parameter::Order) => "m",
        Some(Parameter::AllSamples) => "N = M₁ = M₂",
        Some(Parameter::ReferenceAndScale) => "N = M₂",
        Some(Parameter::Reference) => "N",
        Some(Parameter::Shift) => "M₁",
        Some(Parameter::Scale) => "M₂",
        Some(Parameter::Alpha) => "α",
        Some(other) => other.name(),
    }
}

/// `Δ/σ_ξ = 0.3`, `rule wilcoxon`.
pub fn at(axis: Option<&Axis>, value: &str) -> String {
    match value.parse::<f64>() {
        Ok(number) => format!("{} = {}", symbol(axis), minus(&number.to_string())),
        Err(_) => format!("{} {value}", symbol(axis)),
    }
}

/// `Δ/σ_ξ from 0.1 to 0.6`.
pub fn range(axis: Option<&Axis>, first: &str, last: &str) -> String {
    match first == last {
        true => at(axis, first),
        false => format!("{} in [{}, {}]", symbol(axis), minus(first), minus(last)),
    }
}

/// The values that are `chosen`, neighbours joined to ranges where they are numbers.
pub fn ranges(axis: Option<&Axis>, values: &[(&str, bool)]) -> String {
    let is_number = values.iter().all(|(value, _)| value.parse::<f64>().is_ok());
    let mut parts: Vec<(&str, &str)> = Vec::new();
    let mut is_running = false;
    for &(value, is_chosen) in values {
        match parts.last_mut() {
            Some((_, last)) if is_chosen && is_running => *last = value,
            _ if is_chosen => parts.push((value, value)),
            _ => {}
        }
        is_running = is_chosen && is_number;
    }
    let parts = parts.iter().map(|(first, last)| range(axis, first, last));
    parts.collect::<Vec<_>>().join(", ")
}
