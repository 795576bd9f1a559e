//! How the file was read, and what the record shows of the sensor.

use super::numbers::fixed;
use super::parts::section as titled;
use crate::detection::Recorded;
use crate::format::thousands;
use crate::recording::GRAVITY;
use crate::track::{Barometric, Level, Scatter, TrackReport, calibrated};
use maud::{Markup, html};
use std::path::Path;

pub(super) fn section(report: &TrackReport) -> Markup {
    let facts = [
        read(&report.recording),
        shown(&report.recording, &report.level),
        calibrated(&report.calibration, report.is_followed)
            .into_iter()
            .collect(),
        report.barometer.as_ref().map(barometer).unwrap_or_default(),
    ];
    titled(
        "sensor",
        "The sensor",
        html! {
            dl.facts { @for (name, value) in facts.into_iter().flatten() {
                div { dt { (name) } dd { (value) } }
            } }
        },
    )
}

type Fact = (&'static str, String);

fn read(it: &Recorded) -> Vec<Fact> {
    let columns: Vec<String> = it.acceleration.iter().map(|it| format!("“{it}”")).collect();
    let zero = it.counts_from.as_ref();
    let zero = zero.map(|zero| ("Clock", format!("times count from {zero}")));
    let facts = vec![
        ("Format", it.format.clone()),
        ("Time", format!("“{}”, in {}", it.time, it.time_unit)),
        (
            "Acceleration",
            format!("{}, in {}", columns.join(", "), it.unit),
        ),
        ("Vertical", it.vertical.clone()),
    ];
    facts.into_iter().chain(zero).collect()
}

fn shown(it: &Recorded, level: &Level) -> Vec<Fact> {
    let (from, to) = (fixed(it.start, 2), fixed(it.end, 2));
    let seconds = fixed(it.end - it.start, 2);
    let gravity = if it.has_gravity {
        "in the record"
    } else {
        "not in the record"
    };
    let step = it.quantum.map(|step| format!("{step:.4} m/s²"));
    let longest = format!(
        "the longest interval is {} s",
        fixed(it.longest_interval, 3)
    );
    let missing = match it.missing {
        0 => format!("none; {longest}"),
        count => format!(
            "{}{} samples, {} %; {longest}",
            if it.more_may_be_missing {
                "at least "
            } else {
                ""
            },
            thousands(count),
            fixed(100.0 * it.missing_share, 1)
        ),
    };
    vec![
        (
            "Record",
            format!(
                "{} samples, {from} to {to} s, {seconds} s long",
                thousands(it.samples)
            ),
        ),
        (
            "Rate",
            format!(
                "{} Hz, jitter {} % of an interval",
                fixed(it.rate, 1),
                fixed(100.0 * it.jitter, 1)
            ),
        ),
        ("Missing", missing),
        ("Gravity", gravity.to_owned()),
        (
            "Reads at rest",
            format!("{} m/s² along the vertical", fixed(level.bias, 4)),
        ),
        ("Noise at rest", noise(&level.rest)),
        ("Noise in uniform motion", noise(&level.motion)),
        ("Step", step.unwrap_or_else(|| "none shows".to_owned())),
        ("High-pass filter", filter(it)),
    ]
}

/// As a data sheet has it: one-sided.
fn noise(of: &Scatter) -> String {
    if of.density <= 0.0 {
        return "not known: the record holds too little of it".to_owned();
    }
    let density = (2.0 * of.density).sqrt();
    let (mm, micro_g) = (fixed(1e3 * density, 1), fixed(1e6 * density / GRAVITY, 0));
    format!("{mm} mm/s²/√Hz ({micro_g} µg/√Hz), below 2 Hz")
}

fn filter(it: &Recorded) -> String {
    match it.high_pass {
        Some(seconds) => format!(
            "a time constant of about {} s; the record was restored",
            fixed(seconds, 2)
        ),
        None if it.is_filter_sought => "none shows".to_owned(),
        None => "not looked for: too much moves the sensor".to_owned(),
    }
}

fn barometer(of: &Barometric) -> Vec<Fact> {
    let file = Path::new(of.file).file_name().unwrap_or_default();
    let file = file.to_string_lossy();
    let readings = thousands(of.readings as u64);
    let clock = of.alignment.map_or(String::new(), |it| format!("; {it}"));
    let text = format!(
        "{file}, “{}”, in {}; {readings} readings, {}{clock}",
        of.column,
        of.unit,
        of.fineness(),
    );
    vec![("Barometer", text), ("Air", of.air.to_string())]
}
