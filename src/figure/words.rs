//! What a picture says about its curves: legend, axis, caption.

use super::frame::CAPTION;
use super::sheet::text_width;
use crate::config::Parameter;
use crate::results::{Manifest, Row};

pub(super) fn axis_label(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Delta => "Δ/σ_ξ",
        Parameter::Duration => "duration of the acceleration, samples",
        Parameter::Offset => "start of the acceleration after X, samples",
        Parameter::Nu => "ν, probability of an impulse per sample",
        Parameter::Theta => "θ/σ_ξ",
        Parameter::Quantum => "quantisation step, σ_ξ",
        Parameter::Range => "range of the sensor, σ_ξ",
        Parameter::Training => "training length, samples",
        Parameter::Order => "order m of the whitening filter",
        Parameter::AllSamples => "N = M_1 = M_2, samples",
        Parameter::Reference => "N, samples",
        Parameter::Shift => "M_1, samples",
        Parameter::Scale => "M_2, samples",
        Parameter::Gap => "gap, samples",
        Parameter::Decimation => "decimation, observations per sample",
        Parameter::Alpha => "α",
        Parameter::Rule => "decision rule",
    }
}

/// A label that is more than a number speaks for itself; a number is followed by what the curve
/// does not share with the others.
pub(super) fn legend(rows: &[&Row], all: &[&Row], axis: Parameter) -> String {
    let row = rows[0];
    if row.label.parse::<f64>().is_err() {
        return row.label.clone();
    }
    let differs = |value: fn(&Row) -> String| all.iter().any(|other| value(other) != value(row));
    let mut parts = Vec::new();
    if axis != Parameter::Nu && differs(|row| row.nu.to_string()) {
        parts.push(format!("ν = {}", row.nu));
    }
    if axis != Parameter::Theta && differs(|row| row.theta.to_string()) {
        parts.push(format!("θ/σ_ξ = {}", row.theta));
    }
    if differs(|row| row.noise.clone()) {
        parts.push(row.noise.clone());
    }
    if differs(|row| row.fit.clone()) {
        parts.push(row.fit.clone());
    }
    match parts.is_empty() {
        true => row.label.clone(),
        false => format!("{}:  {}", row.label, parts.join(", ")),
    }
}

/// What all points share, and what the bands are.
pub(super) fn caption(
    rows: &[&Row],
    axis: Parameter,
    manifest: &Manifest,
    width: f64,
) -> Vec<String> {
    let row = rows[0];
    let same = |value: &dyn Fn(&Row) -> String| rows.iter().all(|other| value(other) == value(row));
    let mut parts = Vec::new();
    if axis != Parameter::Alpha && same(&|row| row.alpha.to_string()) {
        parts.push(match same(&|row| row.size.to_string()) {
            true => format!("α = {} (exact size {:.6})", row.alpha, row.size),
            false => format!("α = {}", row.alpha),
        });
    }
    if same(&|row| row.rule.clone()) {
        parts.push(format!("rule {}", rule_name(row)));
    }
    if same(&|row| format!("{}/{}/{}", row.reference, row.shift, row.scale)) {
        parts.push(sizes(row));
    }
    if same(&|row| row.noise.clone()) {
        parts.push(format!("{} noise", row.noise));
    }
    if same(&|row| format!("{} {} {}", row.fit, row.order, row.training)) {
        parts.push(match row.training {
            0 => format!("known filter of order {}", row.order),
            training => format!(
                "{} filter of order {} fitted on {training} samples",
                row.fit, row.order
            ),
        });
    }
    let (trials, confidence) = (thousands(row.trials), 100.0 * row.confidence);
    let band = if axis == Parameter::Rule {
        "bars"
    } else {
        "bands"
    };
    parts.push(format!("{trials} trials per point, seed {}", manifest.seed));
    parts.push(format!("{band}: pointwise exact {confidence} % intervals"));
    if rows.iter().all(|row| row.is_at_rest()) {
        parts.push("line: the nominal level".to_owned());
    }
    wrap(&parts, width)
}

/// The parts in lines of at most `width` points, broken between parts.
fn wrap(parts: &[String], width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        let longer = lines.last().map(|line| format!("{line}; {part}"));
        match longer.filter(|line| text_width(line, CAPTION) <= width) {
            Some(line) => *lines.last_mut().expect("there is a line") = line,
            None => lines.push(part.clone()),
        }
    }
    lines
}

fn sizes(row: &Row) -> String {
    let (n, m1, m2) = (row.reference, row.shift, row.scale);
    match n == m1 && m1 == m2 {
        true => format!("N = M_1 = M_2 = {n}"),
        false => format!("N = {n}, M_1 = {m1}, M_2 = {m2}"),
    }
}

/// 200000 as 200 000, with thin spaces.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or(""))
        .collect();
    groups.join("\u{2009}")
}

/// The rule without its table.
pub(super) fn rule_name(row: &Row) -> String {
    row.rule.split('(').next().unwrap_or_default().to_owned()
}
