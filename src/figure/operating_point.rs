//! Operating points: the Δ/σ_ξ at which the power reaches a value, against the sizes of the samples.

use crate::chain::Scenario;
use crate::study::operating_point::Row;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Legend, Margins, Mark, Place, Plot, Point, Style, ends};

const LINE: f64 = 1.1;

/// The picture of a search.
pub fn plot(rows: &[Row], scenario: &Scenario, seed: u64) -> Plot {
    let mut curves: Vec<Vec<&Row>> = Vec::new();
    for row in rows {
        match curves.iter_mut().find(|curve| curve[0].power == row.power) {
            Some(curve) => curve.push(row),
            None => curves.push(vec![row]),
        }
    }
    let (first, last) = ends(rows.iter().map(size));
    let highest = rows
        .iter()
        .filter_map(|row| row.high.or(row.delta))
        .fold(0.1, f64::max);
    let x = Axis::at(first - 0.03, last + 0.03, ticks(rows)).labelled("N = M_1 = M_2, samples");
    let y = Axis::linear(0.0, 1.08 * highest, 6).labelled("Δ/σ_ξ that reaches D");
    let margins = Margins {
        bottom: 40.0,
        ..Margins::default()
    };
    let mut plot = Plot {
        margins,
        ..Plot::stack(&x, [(190.0, y)])
    };
    plot.add(0, Mark::Grid);
    plot.add(0, Mark::Axes);
    for (index, curve) in curves.iter().enumerate() {
        let style = Style::of(index);
        let faded = Style {
            colour: style.colour.faded(0.6),
            ..style.solid()
        };
        let found = || curve.iter().filter_map(|row| Some((*row, row.delta?)));
        plot.add(
            0,
            Mark::line(found().map(|(row, delta)| (size(row), delta)), LINE, faded),
        );
        let points = found().map(|(row, delta)| Point {
            bar: row.low.zip(row.high),
            ..Point::at(size(row), delta)
        });
        plot.add(
            0,
            Mark::Points {
                points: points.collect(),
                size: 2.3,
                width: LINE,
                style,
            },
        );
    }
    plot.add(0, Mark::Legend);
    let entries = curves.iter().enumerate().map(|(index, curve)| {
        Entry::new(
            format!("D = {}", curve[0].power),
            Style::of(index),
            Key::MarkedLine,
        )
    });
    plot.legend = Some(Legend::new(entries.collect(), Place::Inside(80.0, 6.0)));
    plot.set_caption(&caption(scenario, &rows[0], seed));
    plot
}

fn size(row: &Row) -> f64 {
    libm::log10(row.all_samples as f64)
}

/// A tick at every size.
fn ticks(rows: &[Row]) -> Vec<(f64, String)> {
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.all_samples).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let tick = |size: usize| (libm::log10(size as f64), size.to_string());
    sizes.into_iter().map(tick).collect()
}

fn caption(scenario: &Scenario, row: &Row, seed: u64) -> [String; 11] {
    let (impulses, whitening) = (&scenario.impulses, &scenario.whitening);
    [
        format!("α = {}", row.alpha),
        format!("rule {}", scenario.detector.method),
        format!("ν = {}", impulses.nu()),
        format!("θ/σ_ξ = {}", impulses.theta()),
        format!("{} noise", scenario.noise),
        format!("{} filter", whitening.fit()),
        format!("order {}", whitening.order()),
        format!("training {}", whitening.training()),
        format!("{} trials at every Δ", thousands(row.trials)),
        format!("seed {seed}"),
        format!(
            "bars: exact {} % intervals, inverted",
            100.0 * row.confidence
        ),
    ]
}
