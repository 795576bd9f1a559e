//! Probability by Δ for each start in the first noise, and rates at rest by noise.

use super::start::Start;
use super::table::{Row, Table};
use crate::format::thousands;
use crate::plot::{
    Axis, Colour, Curve, Entry, Key, Mark, Panel, Place, Plot, Point, Style, add_bands, ends,
};
use crate::study::outcomes::facts;
use libm::log10;

/// The heights of the panel of a start and of that of the rates, points.
const HEIGHT: f64 = 95.0;
const REST: f64 = 200.0;

/// The rates are drawn between these, in decades of what is promised.
const RATES: (f64, f64) = (-1.6, 3.4);

/// The detectors of one noise stand so far apart in all.
const APART: f64 = 0.8;

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let starts = table.start.iter();
    let mut panels: Vec<Panel> = starts.map(|start| of_start(rows, table, start)).collect();
    let last = panels.len() - 1;
    let others = panels[..last].iter_mut();
    others.for_each(|panel| panel.x = panel.x.unlabelled());
    panels.push(of_rest(table));
    let mut plot = Plot::of(panels, 1);
    plot.margins.left = 76.0;
    plot.add_to_all(&Mark::Grid);
    for (panel, start) in table.start.iter().enumerate() {
        add_bands(&mut plot, panel, &curves(rows, table, start));
    }
    add_rates(&mut plot, rows, table);
    plot.add_to_all(&Mark::Axes);
    let names = table.detector.iter().map(|it| words(&it.to_string()));
    plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Across);
    let facts = facts(rows, "trials", seed, "bands and bars");
    let starts = format!("P(alarm within 3 s) in {} noise", table.noise[0].label);
    let records = thousands(rows[0].trials * table.records as u64);
    let rest =
        format!("{records} records of 120 s at rest; what lies beyond the axis is at its end");
    plot.set_caption(&[vec![starts, rest], facts.to_vec()].concat());
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
    Panel::new(
        HEIGHT,
        x.labelled("Δ/σ"),
        y.labelled(format!("P, {}", start.label)),
    )
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
    let x = x.labelled("false alarms at rest over what is promised");
    Panel::new(REST, x, Axis::names(names.collect()))
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
    let most = table.noise.len() as f64 - 0.5;
    let promised = vec![(0.0, -0.5), (0.0, most)];
    let style = Style::of(0).coloured(Colour::BLACK).wide(0.7);
    plot.add(panel, Mark::Line(promised, style.dashed(&[3.0, 3.0])));
}
