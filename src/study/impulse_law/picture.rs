//! The laws of S and of λ against time: closed form and simulation.

use super::row::Row;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Mark, Place, Plot, Point, Style};

const UPPER: f64 = 150.0;
const LOWER: f64 = 110.0;
/// Markers along a curve, at most.
const MARKERS: usize = 34;

/// The picture of both laws.
pub fn plot(rows: &[Row], confidence: f64, seed: u64) -> Plot {
    let curves: Vec<&[Row]> = rows.chunk_by(|a, b| a.nu == b.nu).collect();
    let last = rows.iter().map(|row| row.sample).max().unwrap_or(1) as f64;
    let x = Axis::linear(0.0, last, 8).within(-0.02 * last, 1.02 * last);
    let lowest = rows.iter().map(|row| row.zero_sum_low).fold(0.5, f64::min);
    let from = (lowest - 0.05).max(0.0);
    let upper = Axis::linear(from, 1.0, 6)
        .within(from, 1.03)
        .labelled("P(S_i = 0)");
    let highest = rows.iter().map(|row| row.positive_high).fold(0.0, f64::max);
    let lower = Axis::linear(0.0, 1.12 * highest, 4).labelled("P(λ_i = +θ)");
    let panels = [(UPPER, upper), (LOWER, lower)];
    let mut plot = Plot::stack(&x.labelled("i, samples since S = 0"), panels);
    let zero_sum = |row: &Row| {
        let rate = [row.zero_sum_low, row.zero_sum_rate, row.zero_sum_high];
        (row.zero_sum, rate)
    };
    let positive = |row: &Row| {
        let rate = [row.positive_low, row.positive_rate, row.positive_high];
        (row.positive, rate)
    };
    plot.add(0, Mark::Grid);
    plot.add(0, Mark::Level(0.5, &[4.0, 2.0]));
    add_curves(&mut plot, 0, &curves, zero_sum);
    plot.add(0, Mark::Axes);
    let names = curves.iter().map(|curve| format!("ν = {}", curve[0].nu));
    plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Free);
    plot.add(1, Mark::Grid);
    add_curves(&mut plot, 1, &curves, positive);
    plot.add(1, Mark::Axes);
    plot.set_caption(&[
        "lines: P(S_i = 0) = (1 + (1 − 2ν)ⁱ)/2 and P(λ_i = +θ) = ν/2".to_owned(),
        "dashed: the limit ½ of (6)".to_owned(),
        format!("markers: {} realisations", thousands(rows[0].trials)),
        format!("seed {seed}"),
        format!("bars: pointwise exact {} % intervals", 100.0 * confidence),
    ]);
    plot
}

/// The closed form as a line, and some of the simulated rates with their intervals; `of` gives both.
fn add_curves(plot: &mut Plot, panel: usize, curves: &[&[Row]], of: fn(&Row) -> (f64, [f64; 3])) {
    for (index, curve) in curves.iter().enumerate() {
        let style = Style::of(index).wide(1.0).sized(1.9);
        let line = curve.iter().map(|row| (row.sample as f64, of(row).0));
        plot.add(panel, Mark::Line(line.collect(), style.solid().faded(0.55)));
        let marked = curve.iter().step_by(curve.len().div_ceil(MARKERS));
        let points = marked.map(|row| Point::new(row.sample as f64, of(row).1));
        plot.add(panel, Mark::Points(points.collect(), style));
    }
}
