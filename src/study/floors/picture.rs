//! What is shown of buildings; of alarms the bound beside them.

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
        Measure::Alarm => vec![
            ("alarmed", Some("bound"), "D, at once", Kind::Share),
            (
                "alarmed_again",
                Some("bound_again"),
                "D, judged again",
                Kind::Share,
            ),
        ],
        Measure::Stops => vec![
            ("false_alarms", None, "false alarms per stop", positive),
            ("wrong_floors", None, "wrong floors per stop", positive),
        ],
        Measure::Position => vec![
            ("position", None, "car, m", positive),
            ("reckoned", None, "trips alone, m", positive),
            ("map", None, "floors, m", positive),
            ("nees", None, "NEES", Kind::Ratio),
        ],
        Measure::Healing => vec![("healed", None, "P(the floor is right)", Kind::Share)],
    };
    let height = HEIGHT / (panels.len() as f64 + 0.3);
    let panels = panels
        .into_iter()
        .map(|(outcome, beside, label, kind)| Shown {
            beside,
            ..Shown::new(outcome, label, kind, height)
        });
    panels.collect()
}

fn key_in_words(key: &str) -> String {
    match key {
        "offset" => "distance from the floor, m",
        "trips" => "trips after the sweep",
        "noise" => "true deviation of trips over the claimed one",
        "storey" => "height of a storey, m",
        "since" => "trips since one was missed",
        "level" => "σ_s, deviation of stops from their floor, m",
        "threshold" => "γ_s",
        "uneven" => "deviation of storeys, m",
        "vague" => "deviation of a floor's height from a plan, m",
        "floors" => "floors",
        "storeys" => "storeys of the trip",
        "next_storeys" => "storeys of the trip after it",
        "window" => "stops over whose median ξ is scaled",
        other => return literal(other),
    }
    .to_owned()
}

/// What all points share.
fn caption(rows: &[Row], table: &Table, seed: u64) -> Vec<String> {
    let mut parts = along::shared(rows.iter().map(|row| {
        let uneven = (row.uneven > 0.0).then(|| format!("storeys ± {} m", row.uneven));
        vec![
            Some(format!("{} floors, {} m apart", row.floors, row.storey)),
            uneven,
            Some(format!("σ_s = {} m", row.level)),
            Some(format!("{} trips after the sweep", row.trips)),
            Some(format!("γ_s = {}", row.threshold)),
        ]
    }));
    parts.push("trips drawn from the law of their errors".to_owned());
    parts.push(format!("{} buildings", thousands(rows[0].trials)));
    parts.push(format!("seed {seed}"));
    parts.push(format!("bands: {} % intervals", 100.0 * rows[0].confidence));
    if table.measure == Measure::Position {
        parts.push("errors are root mean squares".to_owned());
    }
    if table.measure == Measure::Alarm {
        parts.push("faint: the map exact, the start known to σ_s".to_owned());
    }
    parts
}
