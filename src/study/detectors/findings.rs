//! The table to print: a line for each detector and start in the first noise, and its worst rates at rest.

use super::compare::operating_point;
use super::start::Start;
use super::table::{Row, Table};
use crate::detect::running::Detector;
use crate::results::Quantity;
use crate::run;
use libm::{fabs, log};

const HEADER: &[&str] = &[
    "detector",
    "start",
    "Δ/σ for P = 0.9",
    "median delay, s",
    "worst rate over promised, white",
    "coloured",
];

/// All lines.
pub fn of(rows: &[Row], table: &Table, quantities: &[Quantity]) -> run::Table {
    let lines = table.detectors().map(|(detector, start)| {
        let [point, delay] = of_start(rows, table, detector, start);
        let rate = |kind: &str| {
            let name = format!("most_over_promised_{detector}_{kind}");
            let found = quantities.iter().find(|it| it.name == name);
            found.map_or(String::new(), |it| words([it.value, it.low, it.high]))
        };
        vec![
            detector.to_string(),
            start.label.clone(),
            point,
            delay,
            rate("white"),
            rate("coloured"),
        ]
    });
    (HEADER, lines.collect())
}

/// The operating point, and the delay at the Δ nearest to 1.
fn of_start(rows: &[Row], table: &Table, detector: Detector, start: &Start) -> [String; 2] {
    let noise = &table.noise[0].label;
    let point = operating_point(rows, detector, noise, &start.label);
    let name = detector.to_string();
    let delays = rows.iter().filter(|row| {
        (&*row.detector, &row.noise, &row.start) == (&*name, noise, &start.label)
            && row.outcome == "delay_50"
    });
    let nearest = delays.min_by(|one, other| {
        let [one, other] = [one, other].map(|row| fabs(log(row.delta)));
        one.total_cmp(&other)
    });
    let delay = nearest.map(|row| {
        let value = words([row.estimate, row.low, row.high]);
        format!("{value} at Δ/σ = {}", row.delta)
    });
    [words(point), delay.unwrap_or_default()]
}

fn words([value, low, high]: [f64; 3]) -> String {
    format!("{value:.2} [{low:.2}, {high:.2}]")
}
