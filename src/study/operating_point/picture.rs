//! Operating points: the Δ/σ_ξ at which the power reaches a value, against the sizes of the samples.

use super::row::Row;
use crate::chain::Scenario;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Mark, Place, Plot, Point, Style, ends};

/// The picture of a search.
pub fn plot(rows: &[Row], scenario: &Scenario, seed: u64) -> Plot {
    let mut curves: Vec<Vec<&Row>> = Vec::new();
    for row in rows {
        match curves.iter_mut().find(|curve| curve[0].power == row.power) {
            Some(curve) => curve.push(row),
            None => curves.push(vec![row]),
        }
    }
    let (first, last) = ends(rows.iter().map(|row| place(row.all_samples)));
    let x = Axis::new(first - 0.03, last + 0.03, ticks(rows)).labelled("N = M_1 = M_2, samples");
    let highest = rows.iter().filter_map(|row| row.high.or(row.delta));
    let y = Axis::linear(0.0, 1.08 * highest.fold(0.1, f64::max), 6);
    let mut plot = Plot::stack(&x, [(190.0, y.labelled("Δ/σ_ξ that reaches D"))]);
    plot.margins.bottom = 40.0;
    plot.add(0, Mark::Grid);
    plot.add(0, Mark::Axes);
    for (index, curve) in curves.iter().enumerate() {
        let points: Vec<Point> = curve.iter().filter_map(|row| point(row)).collect();
        let line = points.iter().map(Point::place).collect();
        let style = Style::of(index);
        plot.add(0, Mark::Line(line, style.solid().faded(0.6)));
        plot.add(0, Mark::Points(points, style));
    }
    let names = curves.iter().map(|curve| format!("D = {}", curve[0].power));
    plot.add_legend(
        Entry::of_curves(names, Key::MarkedLine),
        Place::Inside(80.0, 6.0),
    );
    plot.set_caption(&caption(scenario, &rows[0], seed));
    plot
}

fn place(size: usize) -> f64 {
    libm::log10(size as f64)
}

/// Where the power was reached, with both ends of its interval where they were, too.
fn point(row: &Row) -> Option<Point> {
    let (x, delta) = (place(row.all_samples), row.delta?);
    let ends = row.low.zip(row.high);
    let (low, high) = ends.unwrap_or((delta, delta));
    Some(Point::new(x, [low, delta, high]))
}

/// A tick at every size.
fn ticks(rows: &[Row]) -> Vec<(f64, String)> {
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.all_samples).collect();
    sizes.sort_unstable();
    sizes.dedup();
    sizes
        .into_iter()
        .map(|size| (place(size), size.to_string()))
        .collect()
}

fn caption(scenario: &Scenario, row: &Row, seed: u64) -> [String; 11] {
    let (impulses, whitening) = (&scenario.impulses, &scenario.whitening);
    [
        format!("α = {}", row.alpha),
        format!("rule {}", scenario.detector.method),
        format!("ν = {}", impulses.nu.get()),
        format!("θ/σ_ξ = {}", impulses.theta.get()),
        format!("{} noise", scenario.noise),
        format!("{} filter", whitening.fit),
        format!("order {}", whitening.order),
        format!("training {}", whitening.training),
        format!("{} trials at every Δ", thousands(row.trials)),
        format!("seed {seed}"),
        format!(
            "bars: exact {} % intervals, inverted",
            100.0 * row.confidence
        ),
    ]
}
