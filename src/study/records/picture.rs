//! Classes one under the other, an outcome to a panel: each share with its interval.

use super::row::Row;
use super::table::Watch;
use crate::format::thousands;
use crate::plot::{Axis, Cell, Mark, Panel, Plot, Point, Style};
use libm::log10;

/// What a panel shows: a share, in words, and whether its axis is logarithmic.
type Shown = (&'static str, &'static str, bool);

const DETECTED: &[Shown] = &[
    ("found", "trips found", false),
    ("undecided", "trips undecided", false),
    ("missed_silently", "trips missed silently", true),
    ("false_records", "records with a false trip", true),
];

const WATCHED: &[Shown] = &[
    ("rest_in_motion", "records with rest said in motion", true),
    ("wrong_way", "records with a wrong direction", true),
    ("false_records", "records with a false ride", true),
    ("known", "rest that is told", false),
];

/// The height of a class, in points.
const LINE: f64 = 11.0;

/// The picture of a study: two panels side by side, with the names of the classes before the first.
pub fn plot(rows: &[Row], watch: Watch, seed: u64) -> Plot {
    let shown = match watch {
        Watch::Detect => DETECTED,
        Watch::Monitor => WATCHED,
    };
    let of = |outcome: &str| -> Vec<&Row> {
        let rows = rows.iter().filter(|row| row.outcome == outcome);
        rows.collect()
    };
    let panels = shown.iter().zip(0..);
    let panels = panels.map(|((outcome, title, is_logarithmic), index)| {
        let rows = of(outcome);
        let name = |row: &&Row| row.class.to_string().replace('_', " ");
        let y = Axis::names(rows.iter().rev().map(name).collect());
        let is_left = index % 2 == 0;
        let y = if is_left { y } else { y.unlabelled() };
        let height = LINE * rows.len() as f64;
        Panel::new(height, x_axis(&rows, *is_logarithmic), y).titled(title)
    });
    let mut plot = Plot::of(panels.collect(), 2);
    plot.margins.left = 84.0;
    plot.margins.top = 24.0;
    for (panel, (outcome, _, is_logarithmic)) in shown.iter().enumerate() {
        let left = plot.panels[panel].x.from;
        let (cells, points) = marks(&of(outcome), *is_logarithmic, left);
        plot.add(panel, Mark::Grid);
        plot.add(panel, Mark::Cells(cells));
        plot.add(panel, Mark::Markers(points, Style::of(0)));
        plot.add(panel, Mark::Axes);
    }
    let percent = 100.0 * rows[0].confidence;
    plot.set_caption(&[
        "shares by class".to_owned(),
        format!("{} records of each", thousands(rows[0].trials)),
        format!("times within {} s", rows[0].tolerance),
        format!("seed {seed}"),
        // That of rest told is a ratio's.
        match watch {
            Watch::Detect => format!("bars: exact {percent} % intervals"),
            Watch::Monitor => format!("bars: {percent} % intervals"),
        },
    ]);
    plot
}

/// From 0 to 1, or to 1 from a decade that leaves a bar to be seen of the least number.
fn x_axis(rows: &[&Row], is_logarithmic: bool) -> Axis {
    if !is_logarithmic {
        return Axis::linear(0.0, 1.0, 5).within(-0.02, 1.02);
    }
    let cases = rows.iter().filter(|row| row.exposure > 0.0);
    let least = cases.flat_map(|row| [row.low, row.high]);
    let least = least.filter(|share| *share > 0.0).fold(0.1, f64::min);
    Axis::decades((log10(least) - 0.5).floor(), 0.0)
}

/// The interval and the estimate of each row, the first on top; none of what could not happen. On a logarithmic axis an interval from 0 begins at
/// its left end, and an estimate of 0 has no marker.
fn marks(rows: &[&Row], is_logarithmic: bool, left: f64) -> (Vec<Cell>, Vec<Point>) {
    let at = |share: f64| {
        if is_logarithmic {
            log10(share).max(left)
        } else {
            share
        }
    };
    let (mut cells, mut points) = (Vec::new(), Vec::new());
    let places = rows.iter().rev().zip((0..).map(f64::from));
    for (row, y) in places.filter(|(row, _)| row.exposure > 0.0) {
        if row.low.is_finite() && row.high.is_finite() {
            let corners = [(at(row.low), y - 0.08), (at(row.high), y + 0.08)];
            cells.push((corners[0], corners[1], Style::of(0).colour));
        }
        if row.estimate > 0.0 || !is_logarithmic {
            points.push(Point::at((at(row.estimate), y)));
        }
    }
    (cells, points)
}
