//! Probability by Δ for each start in the first noise, and rates at rest by noise.

use super::table::{Row, Start, Table};
use crate::format::thousands;
use crate::plot::{
    Axis, Curve, Entry, Key, Mark, Panel, Place, Plot, Point, Style, add_bands, ends,
};
use crate::study::outcomes::facts;
use libm::log10;

/// The heights of a panel of starts and of that of the rates, points.
const HEIGHT: f64 = 130.0;

/// The rates are drawn between these, in decades of what is promised.
const RATES: (f64, f64) = (-1.5, 2.5);

/// The detectors of one noise stand so far apart in all.
const APART: f64 = 0.8;

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let mut panels: Vec<Panel> = table
        .start
        .iter()
        .map(|start| of_start(rows, table, start))
        .collect();
    panels.push(of_rest(table));
    let mut plot = Plot::of(panels, 2);
    plot.margins.left = 70.0;
    plot.add_to_all(&Mark::Grid);
    for (panel, start) in table.start.iter().enumerate() {
        add_bands(&mut plot, panel, &curves(rows, table, start), true);
    }
    add_rates(&mut plot, rows, table);
    plot.add_to_all(&Mark::Axes);
    let names = table.detector.iter().map(|it| words(&it.to_string()));
    plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Above);
    let facts = facts(rows, "trials", seed, "bands and bars");
    let noise = format!("starts in {} noise", table.noise[0].label);
    let rest = format!(
        "{} records of 120 s at rest",
        thousands(rows[0].trials * table.records as u64)
    );
    plot.set_caption(&[vec![noise, rest], facts.to_vec()].concat());
    plot
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}

fn of_start(rows: &[Row], table: &Table, start: &Start) -> Panel {
    let points = curves(rows, table, start).into_iter();
    let (from, to) = ends(points.flat_map(|curve| curve.points.into_iter().map(|point| point.x)));
    let x = Axis::logarithms(from, to).within(from - 0.03, to + 0.03);
    let y = Axis::linear(0.0, 1.0, 5).within(-0.03, 1.03);
    let y = y.labelled("P(alarm within 3 s)");
    Panel::new(HEIGHT, x.labelled("Δ/σ"), y).titled(&start.label)
}

/// A curve to a detector, in the first noise.
fn curves(rows: &[Row], table: &Table, start: &Start) -> Vec<Curve> {
    let curve = |(place, name): (usize, String)| {
        let here = |row: &&Row| {
            row.outcome == "within"
                && (&*row.detector, &*row.noise, &*row.start)
                    == (&*name, &*table.noise[0].label, &*start.label)
        };
        let points = rows.iter().filter(here);
        let points =
            points.map(|row| Point::new(log10(row.delta), [row.low, row.estimate, row.high]));
        Curve {
            style: Style::of(place),
            points: points.collect(),
        }
    };
    let names = table.detector.iter().map(ToString::to_string);
    names.enumerate().map(curve).collect()
}

fn of_rest(table: &Table) -> Panel {
    let names = table.noise.iter().rev().map(|noise| noise.label.clone());
    let x = Axis::powers_of_ten(RATES.0, RATES.1, 6);
    let x = x.labelled("false alarms over promised");
    Panel::new(HEIGHT, x, Axis::names(names.collect())).titled("at rest")
}

/// Of the clairvoyant, the rates for each start.
fn add_rates(plot: &mut Plot, rows: &[Row], table: &Table) {
    let panel = table.start.len();
    let count = table.detector.len() as f64;
    for (place, detector) in table.detector.iter().enumerate() {
        let name = detector.to_string();
        let style = Style::of(place);
        let off = APART * (0.5 - (place as f64 + 0.5) / count);
        let here = rows
            .iter()
            .filter(|row| row.outcome == "over_promised" && row.detector == name);
        let rates = here.filter_map(|row| {
            let noise = table
                .noise
                .iter()
                .rev()
                .position(|noise| noise.label == row.noise)?;
            let y = noise as f64 + off;
            let [low, x, high] =
                [row.low, row.estimate, row.high].map(|rate| log10(rate).clamp(RATES.0, RATES.1));
            Some([(low, y), (x, y), (high, y)])
        });
        let rates: Vec<_> = rates.collect();
        for [low, _, high] in &rates {
            plot.add(panel, Mark::Line(vec![*low, *high], style.solid()));
        }
        let points = rates.iter().map(|[_, at, _]| Point::at(*at));
        plot.add(panel, Mark::Markers(points.collect(), style.sized(1.8)));
    }
    plot.add(panel, Mark::Limit(0.0));
}
