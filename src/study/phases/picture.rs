//! What is asked of trips, by condition, vibration and way; a threshold to a series.

use super::row::Row;
use super::table::{Measure, Table};
use super::trial::Way;
use crate::plot::Plot;
use crate::study::dots;
use crate::study::outcomes::facts;

/// A threshold with which less than one trip in so many is told is left out.
const SHOWN: u64 = 10;

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let (outcome, axis) = match table.measure {
        Measure::Spacing => ("error", "mean size of the error, m"),
        Measure::Phases => ("time_wrong", "share of the time whose phase is wrong"),
    };
    let mut named = Vec::new();
    for condition in &table.condition {
        for vibration in &table.vibration {
            for way in [Way::Printed, Way::Track] {
                let outcome = format!("{outcome}_{}", way.name());
                let of = |threshold: &f64| {
                    let here = |row: &&Row| {
                        let of = (row.condition, row.vibration, row.threshold);
                        of == (*condition, *vibration, *threshold) && row.outcome == outcome
                    };
                    let row = rows.iter().find(here)?;
                    let is_told = SHOWN * row.count >= row.trials;
                    is_told.then_some([row.low, row.estimate, row.high])
                };
                // No threshold is any of `track`'s.
                let thresholds = match way {
                    Way::Track => &table.threshold[..1],
                    _ => &table.threshold[..],
                };
                let shaken = match table.vibration.len() {
                    1 => String::new(),
                    _ => format!("{vibration} m/s², "),
                };
                let name = format!("{condition}, {shaken}{}", way.name()).replace('_', " ");
                named.push((name, thresholds.iter().map(of).collect()));
            }
        }
    }
    let facts = facts(rows, "trips", seed, "bars");
    let caption = [
        vec![format!("trips of {} m", table.distance)],
        facts.to_vec(),
    ]
    .concat();
    let series = table.threshold.iter().map(|it| format!("{it} m/s²"));
    dots::plot(&named, series.collect(), axis, &caption)
}
