//! Outcomes against the axis, one panel under the other; of alarms the bound beside them.

use super::measure::Measure;
use super::row::Row;
use super::table::Table;
use crate::format::thousands;
use crate::plot::{
    Axis, Curve, Entry, Key, Limit, Mark, Place, Plot, Point, Style, add_bands, ends, is_long,
    literal,
};
use libm::log10;

/// What a panel shows.
struct Shown {
    outcome: &'static str,
    /// The outcome of the computed line beside it.
    beside: Option<&'static str>,
    /// Along its axis.
    label: &'static str,
    is_logarithmic: bool,
}

fn shown(measure: Measure) -> Vec<Shown> {
    let panel = |outcome, beside, label, is_logarithmic| Shown {
        outcome,
        beside,
        label,
        is_logarithmic,
    };
    match measure {
        Measure::Alarm => vec![
            panel("alarmed", Some("bound"), "D, at once", false),
            panel(
                "alarmed_again",
                Some("bound_again"),
                "D, judged again",
                false,
            ),
        ],
        Measure::Stops => vec![
            panel("false_alarms", None, "false alarms per stop", true),
            panel("wrong_floors", None, "wrong floors per stop", true),
        ],
        Measure::Position => vec![
            panel("position", None, "car, m", true),
            panel("reckoned", None, "trips alone, m", true),
            panel("map", None, "floors, m", true),
            panel("nees", None, "NEES", false),
        ],
        Measure::Healing => vec![panel("healed", None, "P(the floor is right)", false)],
    }
}

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let values: Vec<f64> = rows.iter().map(|row| row.x).collect();
    let is_long = is_long(&values);
    let at = |row: &Row| if is_long { log10(row.x) } else { row.x };
    let of = |curve: usize, outcome: &str| -> Vec<&Row> {
        let rows = rows.iter();
        rows.filter(|row| row.curve == curve + 1 && row.outcome == outcome)
            .collect()
    };
    let shown = shown(table.measure);
    let curves = |shown: &Shown| -> Vec<Curve> {
        let each = (0..table.labels.len()).map(|curve| {
            let rows = of(curve, shown.outcome).into_iter();
            let points = rows.map(|row| point(row, at(row), shown.is_logarithmic));
            Curve {
                style: Style::of(curve),
                points: points
                    .filter(|point| point.x.is_finite() && point.y.is_finite())
                    .collect(),
            }
        });
        each.collect()
    };
    let panels: Vec<(&Shown, Vec<Curve>)> = shown.iter().map(|of| (of, curves(of))).collect();
    let x = Axis::around(rows.iter().map(at).filter(|x| x.is_finite()), is_long);
    let height = 300.0 / (panels.len() as f64 + 0.3);
    let heights = panels
        .iter()
        .map(|(shown, curves)| (height, y_axis(shown, curves)));
    let mut plot = Plot::stack(&x.labelled(key_in_words(&table.axis)), heights);
    plot.margins.legend = (6.0, 6.0);
    for (panel, (shown, curves)) in panels.iter().enumerate() {
        plot.add(panel, Mark::Grid);
        for (curve, beside) in
            (0..table.labels.len()).flat_map(|curve| Some((curve, shown.beside?)))
        {
            let line = of(curve, beside)
                .into_iter()
                .map(|row| (at(row), row.estimate));
            plot.add(
                panel,
                Mark::Line(line.collect(), Style::of(curve).faded(0.6)),
            );
        }
        add_bands(&mut plot, panel, curves, false);
        plot.add(panel, Mark::Axes);
    }
    if table.labels != ["1"] {
        let names = table.labels.iter().map(|label| literal(label));
        plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Free);
    }
    plot.set_caption(&caption(rows, table, seed));
    plot
}

/// A rate and its interval; an arrow where nothing was counted on a logarithmic scale.
fn point(row: &Row, x: f64, is_logarithmic: bool) -> Point {
    let point = Point::new(x, [row.low, row.estimate, row.high]);
    if !is_logarithmic {
        return point;
    }
    let limit = (row.estimate == 0.0).then_some(Limit::Upper);
    let point = Point { limit, ..point }.logarithms();
    match limit {
        Some(_) => Point {
            limit,
            ..Point::at(point.place())
        },
        None => point,
    }
}

fn y_axis(shown: &Shown, curves: &[Curve]) -> Axis {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let (bottom, top) = ends(points().map(|point| point.y));
    let axis = match shown.outcome {
        _ if bottom > top => Axis::linear(0.0, 1.0, 5),
        _ if shown.is_logarithmic => Axis::decades(bottom - 0.35, top + 0.35),
        "nees" => Axis::linear(0.0, 1.2 * top.max(1.0), 4),
        _ => Axis::linear(0.0, 1.0, 5).within(-0.03, 1.03),
    };
    axis.labelled(shown.label)
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
        other => return literal(other),
    }
    .to_owned()
}

/// What all points share.
fn caption(rows: &[Row], table: &Table, seed: u64) -> Vec<String> {
    let facts = |row: &Row| {
        let uneven = (row.uneven > 0.0).then(|| format!("storeys ± {} m", row.uneven));
        [
            Some(format!("{} floors, {} m apart", row.floors, row.storey)),
            uneven,
            Some(format!("σ_s = {} m", row.level)),
            Some(format!("{} trips after the sweep", row.trips)),
            Some(format!("γ_s = {}", row.threshold)),
        ]
    };
    let first = facts(&rows[0]);
    let is_shared = |at: &usize| rows.iter().all(|row| facts(row)[*at] == first[*at]);
    let shared = (0..first.len())
        .filter(is_shared)
        .filter_map(|at| first[at].clone());
    let mut parts: Vec<String> = shared.collect();
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
