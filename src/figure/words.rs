//! What a picture says about its curves: legend, axis, caption, all from the rows themselves.
//!
//! Every parameter is a [`Fact`] in words. What all points share stands in the caption, unless it is
//! a default nobody needs to be told; what tells curves apart stands in the legend.

use super::frame::CAPTION;
use super::text::{literal, text_width};
use crate::config::Parameter;
use crate::format::thousands;
use crate::results::{Manifest, Row};

/// One parameter in words.
#[derive(Clone)]
pub(super) struct Fact {
    /// The axes that would say the same.
    axes: &'static [Parameter],
    text: String,
    /// Whether a caption may leave it out.
    is_usual: bool,
}

/// The facts of a row, always the same ones in the same order.
fn facts(row: &Row) -> Vec<Fact> {
    use Parameter as P;
    let said = |axes: &'static [P], text: String| Fact {
        axes,
        text,
        is_usual: false,
    };
    let unless = |is_usual: bool, axes: &'static [P], text: String| Fact {
        axes,
        text,
        is_usual,
    };
    let rest = row.is_at_rest();
    let duration = (row.shift + row.gap).saturating_sub(row.offset);
    let delta = match row.delta_at.as_str() {
        "whitened" => format!("Δ(1 − β)/σ_ξ = {}", row.delta),
        _ => format!("Δ/σ_ξ = {}", row.delta),
    };
    let number = |value: Option<f64>| value.map_or("none".to_owned(), |v| v.to_string());
    vec![
        said(&[P::Alpha], format!("α = {}", row.alpha)),
        said(&[P::Rule], format!("rule {}", row.rule_name())),
        unless(
            row.alternative == "greater",
            &[],
            format!("alternative {}", row.alternative),
        ),
        said(
            &[P::AllSamples, P::ReferenceAndScale, P::Reference],
            format!("N = {}", row.reference),
        ),
        said(&[P::AllSamples, P::Shift], format!("M_1 = {}", row.shift)),
        said(
            &[P::AllSamples, P::ReferenceAndScale, P::Scale],
            format!("M_2 = {}", row.scale),
        ),
        unless(row.gap == 0, &[P::Gap], format!("gap {}", row.gap)),
        unless(
            row.decimation == 1,
            &[P::Decimation],
            format!("means of {}", row.decimation),
        ),
        unless(rest, &[P::Delta], delta),
        unless(
            rest || row.profile == "rectangular",
            &[],
            literal(&row.profile),
        ),
        unless(
            rest || row.duration == duration,
            &[P::Duration],
            format!("duration {}", row.duration),
        ),
        unless(
            rest || row.offset == 0,
            &[P::Offset],
            format!("offset {}", row.offset),
        ),
        unless(rest, &[P::Nu], format!("ν = {}", row.nu)),
        unless(
            rest || row.nu == 0.0,
            &[P::Theta],
            format!("θ/σ_ξ = {}", row.theta),
        ),
        unless(
            rest || row.during == "motion",
            &[],
            "impulses in Y_2 alone".to_owned(),
        ),
        said(&[], format!("{} noise", literal(&row.noise))),
        unless(
            row.sensor == "ar(-1.5365 -0.75056)",
            &[],
            row.sensor.clone(),
        ),
        unless(
            row.quantum.is_none(),
            &[P::Quantum],
            format!("step {} σ_ξ", number(row.quantum)),
        ),
        unless(
            row.range.is_none(),
            &[P::Range],
            format!("range {} σ_ξ", number(row.range)),
        ),
        unless(
            row.drift == 0.0,
            &[P::Drift],
            format!("drift {} σ_ξ per sample", row.drift),
        ),
        unless(
            row.swell == 1.0,
            &[P::Swell],
            format!("noise {} times as strong after X", row.swell),
        ),
        unless(
            row.footfalls == 0.0,
            &[P::Footfalls],
            format!(
                "footfalls {} per sample, of {} σ_ξ",
                row.footfalls, row.jolt
            ),
        ),
        unless(row.ties == "random", &[], format!("ties {}", row.ties)),
        unless(row.calibrate == "no", &[], calibration(row)),
        match row.fit.as_str() {
            "none" => said(&[], "no whitening".to_owned()),
            fit => said(&[], format!("{fit} filter")),
        },
        said(&[P::Order], format!("order {}", row.order)),
        unless(
            row.training == 0,
            &[P::Training],
            format!("training {}", row.training),
        ),
        unless(
            !row.includes_reference,
            &[],
            "X inside the training record".to_owned(),
        ),
    ]
}

/// What more than two thirds of the rows say, fact by fact; all of them, where a curve has a name, which
/// need not say in what it differs.
pub(super) fn common_facts(rows: &[&Row]) -> Vec<Option<Fact>> {
    let is_named = rows.iter().any(|row| row.label.parse::<f64>().is_err());
    let table: Vec<Vec<Fact>> = rows.iter().map(|row| facts(row)).collect();
    let common = |index: usize| {
        let column = || table.iter().map(move |facts| &facts[index]);
        let is_common = |fact: &&Fact| {
            let agreeing = column().filter(|other| other.text == fact.text).count();
            match is_named {
                true => agreeing == table.len(),
                false => 3 * agreeing > 2 * table.len(),
            }
        };
        column().find(is_common).cloned()
    };
    (0..table.first().map_or(0, Vec::len)).map(common).collect()
}

/// A label that is more than a number speaks for itself; a number is followed by what the curve does
/// not share with most others.
pub(super) fn legend(rows: &[&Row], common: &[Option<Fact>], axis: Parameter) -> String {
    let label = literal(&rows[0].label);
    if rows[0].label.parse::<f64>().is_err() {
        return label;
    }
    let table: Vec<Vec<Fact>> = rows.iter().map(|row| facts(row)).collect();
    let tells_apart = |(index, fact): &(usize, &Fact)| {
        let is_common = common[*index]
            .as_ref()
            .is_some_and(|common| common.text == fact.text);
        let is_constant = table.iter().all(|facts| facts[*index].text == fact.text);
        !fact.is_usual && !fact.axes.contains(&axis) && is_constant && !is_common
    };
    let here = table[0].iter().enumerate().filter(tells_apart);
    let parts: Vec<&str> = here.map(|(_, fact)| fact.text.as_str()).collect();
    match parts.is_empty() {
        true => label,
        false => format!("{label}:  {}", parts.join(", ")),
    }
}

/// What most points share, and what the bands are, in lines of at most `width` points.
pub(super) fn caption(
    rows: &[&Row],
    common: Vec<Option<Fact>>,
    axis: Parameter,
    manifest: &Manifest,
    width: f64,
) -> Vec<String> {
    let row = rows[0];
    let common = common.into_iter().flatten();
    let shown = common.filter(|fact| !fact.is_usual && !fact.axes.contains(&axis));
    let mut parts: Vec<String> = shown.map(|fact| fact.text).collect();
    if let Some(size) = row
        .size
        .filter(|_| rows.iter().all(|other| other.size == row.size))
    {
        parts.insert(1.min(parts.len()), format!("exact size {size:.6}"));
    }
    let band = if axis == Parameter::Rule {
        "bars"
    } else {
        "bands"
    };
    parts.push(format!("{} trials per point", thousands(row.trials)));
    parts.push(format!("seed {}", manifest.origin.seed));
    parts.push(format!(
        "{band}: pointwise exact {} % intervals, at times narrower than a line",
        100.0 * row.confidence
    ));
    if is_held_against_alpha(rows) {
        parts.push("line: the nominal level".to_owned());
    }
    wrap(&parts, width)
}

/// Whether these are false-alarm rates of one level.
pub(super) fn is_held_against_alpha(rows: &[&Row]) -> bool {
    rows.iter()
        .all(|row| row.is_at_rest() && row.alpha == rows[0].alpha)
}

/// The parts in lines of at most `width` points, broken between parts.
pub(super) fn wrap(parts: &[String], width: f64) -> Vec<String> {
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

/// The axis in words.
pub(super) fn axis_label(parameter: Parameter, is_whitened: bool) -> &'static str {
    match parameter {
        Parameter::Delta if is_whitened => "Δ(1 − β)/σ_ξ, the shift after whitening",
        Parameter::Delta => "Δ/σ_ξ",
        Parameter::Duration => "duration of the acceleration, samples",
        Parameter::Offset => "start of the acceleration after X, samples",
        Parameter::Nu => "ν, probability of an impulse per sample",
        Parameter::Theta => "θ/σ_ξ",
        Parameter::Quantum => "quantisation step, σ_ξ",
        Parameter::Range => "range of the sensor, σ_ξ",
        Parameter::Drift => "drift, σ_ξ per raw sample",
        Parameter::Swell => "deviation of the noise after X, relative to that before",
        Parameter::Footfalls => "probability of a footfall per raw sample",
        Parameter::Training => "training length, samples",
        Parameter::Order => "order m of the whitening filter",
        Parameter::AllSamples => "N = M_1 = M_2, samples",
        Parameter::ReferenceAndScale => "N = M_2, samples",
        Parameter::Reference => "N, samples",
        Parameter::Shift => "M_1, samples",
        Parameter::Scale => "M_2, samples",
        Parameter::Gap => "gap, samples",
        Parameter::Decimation => "decimation, raw observations per sample",
        Parameter::Alpha => "α",
        Parameter::Rule => "decision rule",
    }
}

/// How a region or threshold was found, where no exact law gave it.
fn calibration(row: &Row) -> String {
    match row.calibrate.as_str() {
        "promise" => "calibrated to keep α".to_owned(),
        _ => "threshold set by measured false alarms".to_owned(),
    }
}
