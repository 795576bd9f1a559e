//! What is shown of rides before the monitor; of a trade-off, the time between false motions against the delay.

use super::measure::Measure;
use super::row::Row;
use super::table::Table;
use crate::format::thousands;
use crate::plot::{Limit, Plot, literal};
use crate::study::along::{self, Kind, Outcome, Shown};

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let outcomes = rows.iter().map(|row| Outcome::of(row, row.curve, row.x));
    let axis = match table.measure {
        Measure::Tradeoff => {
            "median delay from a start to the first decision for motion, s".to_owned()
        }
        _ => key_in_words(&table.axis),
    };
    along::plot(
        outcomes,
        &table.labels,
        shown(table.measure),
        &axis,
        &caption(rows, table, seed),
    )
}

/// The panels of a measurement, from the top.
fn shown(measure: Measure) -> Vec<Shown> {
    let share = |outcome, label, height| Shown::new(outcome, label, Kind::Share, height);
    let delay = |outcome, label| Shown::new(outcome, label, Kind::Delay, 105.0);
    let positive = |outcome, label, limit| Shown::new(outcome, label, Kind::Positive(limit), 210.0);
    match measure {
        Measure::Rides => vec![
            share("found", "P(every trip is found)", 130.0),
            delay("start_delay", "start to its report, s"),
        ],
        Measure::Rest => {
            let decided = "decisions for motion per hour";
            let told = "false motions per hour";
            vec![
                positive("rule_alarms", decided, Limit::Upper),
                positive("false_motions", told, Limit::Upper),
            ]
        }
        Measure::Tradeoff => {
            let label = "decisions for motion per hour of rest";
            vec![Shown {
                against: Some("rule_delay_50"),
                ..positive("rule_alarms", label, Limit::Upper)
            }]
        }
        Measure::Jam => vec![
            share("alarmed", "P(a jam alarms)", 130.0),
            delay("alarm_delay", "jam to alarm, s"),
        ],
        Measure::SwitchedOn => vec![
            share("misled", "P(says rest in motion)", 115.0),
            share("knew", "P(knows it stands at last)", 115.0),
        ],
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
fn caption(rows: &[Row], table: &Table, seed: u64) -> Vec<String> {
    let measure = table.measure;
    let mut parts = along::shared(rows.iter().map(|row| facts(measure, row)));
    parts.push(format!("{} trials per point", thousands(rows[0].trials)));
    parts.push(format!("seed {seed}"));
    if measure == Measure::Tradeoff {
        let (first, last) = (rows[0].x, rows[rows.len() - 1].x);
        let key = key_in_words(&table.axis);
        parts.push(format!("along each curve {key}, from {first} to {last}"));
    }
    let percent = 100.0 * rows[0].confidence;
    parts.push(match measure {
        Measure::Rides | Measure::Jam => {
            format!(
                "bands: exact {percent} % intervals above, 5 % to 95 % of the delays below, where \
                 so many were told"
            )
        }
        Measure::Rest | Measure::Tradeoff | Measure::SwitchedOn => {
            format!("bands: exact {percent} % intervals")
        }
    });
    parts
}

/// The parameters of a point in words, always as many; `None` for what goes without saying.
fn facts(measure: Measure, row: &Row) -> Vec<Option<String>> {
    let Row {
        trips,
        distance,
        speed,
        acceleration,
        jerk,
        ..
    } = row;
    let sigma = (1e4 * row.sigma).round() / 1e4;
    let rides = measure.rides();
    vec![
        rides.then(|| format!("{trips} trips of {distance} m at {speed} m/s")),
        rides.then(|| format!("{acceleration} m/s², {jerk} m/s³")),
        measure
            .rests()
            .then(|| format!("rests of {} s", row.length)),
        (measure == Measure::Jam).then(|| format!("jams within {} s", row.jam_within)),
        Some(format!("{} Hz", row.rate)),
        Some(format!("σ = {sigma} m/s²")),
        (!row.sensor.ends_with("()")).then(|| row.sensor.clone()),
        (row.vibration > 0.0).then(|| format!("vibration {} σ", row.vibration)),
        (row.nu > 0.0).then(|| format!("ν = {}, θ = {} σ", row.nu, row.theta)),
        (row.footfalls > 0.0)
            .then(|| format!("footfalls {} per sample, {} σ", row.footfalls, row.jolt)),
        Some(row.rule.clone()),
        Some(format!("α = {}", row.alpha)),
        Some(format!(
            "N, M_1, M_2 = {}, {}, {}",
            row.reference, row.shift, row.scale
        )),
        Some(format!("blocks of {} s", row.block)),
        Some(format!("motions from {} m/s", row.least_speed)),
    ]
}
