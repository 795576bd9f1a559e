//! What the picture of rides says beside its curves.

use crate::config::{Measure, RideStudy};
use crate::figure::frame::{CAPTION_LEFT, WIDTH};
use crate::figure::text::literal;
use crate::figure::words::wrap;
use crate::format::thousands;
use crate::results::Manifest;
use crate::study::rows::Ride as Row;

/// The axis in words.
pub(super) fn axis_label(study: &RideStudy) -> String {
    match study.measure {
        Measure::Tradeoff => "median delay from a start to H_1*, s".to_owned(),
        _ => key_in_words(study.axis),
    }
}

fn key_in_words(key: &str) -> String {
    match key {
        "delta_over_sigma" => "Δ/σ, acceleration of the drive in deviations of a sample",
        "sigma" => "σ, deviation of a sample, m/s²",
        "density" => "density of the noise, m/s²/√Hz",
        "rate" => "sampling rate, Hz",
        "alpha" => "α, level of each decision",
        "vibration" => "deviation of the vibration at full speed, σ",
        "least_speed" => "least speed of a motion, m/s",
        "least_acceleration" => "least acceleration of a start, m/s²",
        "speed" => "speed of the drive, m/s",
        "acceleration" => "acceleration of the drive, m/s²",
        "block" => "length of a block, s",
        "jam_within" => "time from jam to stand, s",
        other => return literal(other),
    }
    .to_owned()
}

/// What all points share, and what is drawn.
pub(super) fn caption(study: &RideStudy, rows: &[Row], manifest: &Manifest) -> Vec<String> {
    let facts: Vec<Vec<String>> = rows.iter().map(|row| facts(study.measure, row)).collect();
    let shared = |index: &usize| facts.iter().all(|other| other[*index] == facts[0][*index]);
    let common = (0..facts[0].len())
        .filter(shared)
        .map(|index| facts[0][index].clone());
    let mut parts: Vec<String> = common.filter(|fact| !fact.is_empty()).collect();
    let percent = 100.0 * rows[0].confidence;
    parts.push(format!("{} trials per point", thousands(rows[0].trials)));
    parts.push(format!("seed {}", manifest.origin.seed));
    if study.measure == Measure::Tradeoff {
        let (first, last) = (rows[0].x, rows[rows.len() - 1].x);
        let key = key_in_words(study.axis);
        parts.push(format!("along each curve {key}, from {first} to {last}"));
    }
    parts.push(match study.measure {
        Measure::Rides | Measure::Jam => {
            format!("bands: exact {percent} % intervals above, 5 % to 95 % of the delays below, where so many were told")
        }
        Measure::Rest | Measure::Tradeoff => {
            format!("bands: exact {percent} % intervals; arrows: limits where nothing happened")
        }
        Measure::SwitchedOn => format!("bands: exact {percent} % intervals"),
    });
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}

/// The parameters of a point in words, always as many; nothing for what goes without saying.
fn facts(measure: Measure, row: &Row) -> Vec<String> {
    let when = |is_told: bool, words: String| if is_told { words } else { String::new() };
    let rides = measure.rides();
    vec![
        when(
            rides,
            format!(
                "{} trips of {} m at {} m/s",
                row.trips, row.distance, row.speed
            ),
        ),
        when(
            rides,
            format!("{} m/s², {} m/s³", row.acceleration, row.jerk),
        ),
        when(measure.rests(), format!("rests of {} s", row.length)),
        when(
            measure == Measure::Jam,
            format!("jams within {} s", row.jam_within),
        ),
        format!("{} Hz", row.rate),
        format!("σ = {} m/s²", (1e4 * row.sigma).round() / 1e4),
        when(!row.sensor.ends_with("()"), row.sensor.clone()),
        when(
            row.vibration > 0.0,
            format!("vibration {} σ", row.vibration),
        ),
        when(row.nu > 0.0, format!("ν = {}, θ = {} σ", row.nu, row.theta)),
        when(
            row.footfalls > 0.0,
            format!("footfalls {} per sample, {} σ", row.footfalls, row.jolt),
        ),
        format!("α = {}", row.alpha),
        format!(
            "N, M_1, M_2 = {}, {}, {}",
            row.reference, row.shift, row.scale
        ),
        format!("blocks of {} s", row.block),
        format!("motions from {} m/s", row.least_speed),
    ]
}
