//! Rates by noise; delays by shift.

use super::delay::Delay;
use super::table::{Row, Table};
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Mark, Panel, Place, Plot, Point, Style, ends};
use crate::study::dots;
use crate::study::outcomes::facts;
use libm::{log10, sqrt};

/// The picture of a study.
pub fn rates(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let named = table.noise.iter().map(|noise| {
        let here = |row: &&Row| row.label == noise.label && row.outcome == "over_promised";
        let row = rows.iter().find(here);
        let estimate = row.map(|row| [row.low, row.estimate, row.high]);
        let estimates = if noise.promised {
            vec![estimate, None]
        } else {
            vec![None, estimate]
        };
        (noise.label.clone(), estimates)
    });
    let threshold = format!("h = {}", rows[0].threshold);
    let records = format!("records of {} blocks", thousands(table.blocks));
    let facts = facts(rows, &records, seed, "bars");
    let caption = [vec![threshold], facts.to_vec()].concat();
    let series = ["promised", "not promised: coloured"];
    dots::plot(
        &named.collect(),
        series.map(str::to_owned).to_vec(),
        "false alarms over what was asked for",
        &caption,
    )
}

/// The delays in seconds against Δ/σ per sample: `long` of a long reference, as a line, and those of the reference at hand.
/// A block lasts 1/`rate` s and is the mean of `samples` samples.
pub fn delays(
    long: &[(f64, f64)],
    short: &[Delay],
    [rate, samples]: [f64; 2],
    caption: &[String],
) -> Plot {
    let place = |shift: f64, blocks: f64| (shift / sqrt(samples), log10(blocks / rate));
    let line: Vec<_> = long
        .iter()
        .map(|(shift, blocks)| place(*shift, *blocks))
        .collect();
    let markers = short.iter().filter(|delay| delay.is_nearly_always_seen());
    let markers = markers.map(|delay| Point::at(place(delay.change.shift, delay.mean)));
    let markers: Vec<Point> = markers.collect();
    let (low, high) = ends(line.iter().map(|(x, _)| *x));
    let x = Axis::linear(low.min(0.0), 1.03 * high, 8).labelled("Δ/σ of a sample");
    let shown = line
        .iter()
        .map(|(_, y)| *y)
        .chain(markers.iter().map(|it| it.y));
    let (least, most) = ends(shown);
    let y = Axis::decades(least - 0.1, most + 0.1).labelled("mean delay, s");
    let mut plot = Plot::of(vec![Panel::new(200.0, x, y)], 1);
    let [exact, simulated] = [0, 1].map(Style::of);
    plot.add(0, Mark::Grid);
    plot.add(0, Mark::Line(line, exact));
    plot.add(0, Mark::Markers(markers, simulated));
    plot.add(0, Mark::Axes);
    let entries = [
        Entry::new("a long reference, exact".to_owned(), exact, Key::Line),
        Entry::new(
            "this reference, simulated".to_owned(),
            simulated,
            Key::Marker,
        ),
    ];
    plot.add_legend(entries, Place::Free);
    plot.set_caption(caption);
    plot
}
