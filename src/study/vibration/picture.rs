//! What is shown of lifts.

use super::measure::Measure;
use super::row::Row;
use super::table::Table;
use crate::format::thousands;
use crate::plot::{Limit, Plot, literal};
use crate::study::along::{self, Kind, Outcome, Shown};

/// The height of all panels of a picture and of what is between them, points.
const HEIGHT: f64 = 300.0;

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let outcomes = rows.iter().map(|row| Outcome::of(row, row.curve, row.x));
    along::plot(
        outcomes,
        &table.labels,
        shown(table.measure),
        &key_in_words(&table.axis),
        &caption(rows, table, seed),
    )
}

fn shown(measure: Measure) -> Vec<Shown> {
    let positive = Kind::Positive(Limit::Upper);
    let panels = match measure {
        Measure::Baseline => vec![
            ("off", "RMS error of μ", positive),
            ("false_windows", "windows above", positive),
            ("false_trips", "trips above", positive),
        ],
        Measure::Knock => vec![
            ("found", "D", Kind::Share),
            ("located", "RMS error, m", positive),
        ],
    };
    let height = HEIGHT / (panels.len() as f64 + 0.3);
    let panels = panels
        .into_iter()
        .map(|(outcome, label, kind)| Shown::new(outcome, label, kind, height));
    panels.collect()
}

fn key_in_words(key: &str) -> String {
    match key {
        "unlike" => "deviation of the logarithm of the energy from trip to trip",
        "uneven" => "deviation of the logarithm of the energy along the shaft",
        "joints" => "knock at the joints of the rails, m/s²",
        "size" => "size of the knock, m/s²",
        "trips" => "trips learnt",
        "alarm_rate" => "rate that is asked for, a window",
        "vibration" => "deviation of the vibration, m/s²",
        other => return literal(other),
    }
    .to_owned()
}

/// What all points share.
fn caption(rows: &[Row], table: &Table, seed: u64) -> Vec<String> {
    let mut parts = along::shared(rows.iter().map(|row| {
        let unlike = (row.unlike > 0.0).then(|| format!("trips unlike by {}", row.unlike));
        vec![
            Some(format!("vibration {} m/s²", row.vibration)),
            Some(format!("shaft uneven by {}", row.uneven)),
            Some(format!("joints {} m/s²", row.joints)),
            unlike,
            Some(format!("asked for: {} of the windows", row.alarm_rate)),
        ]
    }));
    parts.push(format!("{} lifts", thousands(rows[0].trials)));
    parts.push(format!("seed {seed}"));
    parts.push(format!("bands: {} % intervals", 100.0 * rows[0].confidence));
    if table.measure == Measure::Baseline {
        parts.push("100 ordinary trips of each beside its guard line".to_owned());
    }
    parts
}
