//! Autocorrelation against lag, and below it how far the simulation is from theory.

use super::row::Row;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Mark, Place, Plot, Point, Style, literal};
use crate::signal::{Noise, Sensor};

const UPPER: f64 = 160.0;
const LOWER: f64 = 92.0;
const THEORY: Style = Style::of(0).wide(1.0);
const EXACT: Style = Style::of(3).wide(1.0);
const SIMULATION: Style = Style::of(1).wide(0.8).sized(2.0);

/// What was simulated.
#[derive(Clone, Copy, Debug)]
pub struct Records<'a> {
    pub sensor: &'a Sensor,
    pub noise: &'a Noise,
    pub trials: u64,
    /// Samples in each.
    pub length: usize,
    pub confidence: f64,
    pub seed: u64,
}

/// The picture of an autocorrelation.
pub fn plot(rows: &[Row], records: &Records) -> Plot {
    let last = rows.len() as f64 - 1.0;
    let unit = if *records.sensor == Sensor::adxl105() {
        " (T_0 = 62.5 µs)"
    } else {
        ""
    };
    let x = Axis::linear(0.0, last, 8).within(-0.02 * last, 1.02 * last);
    let upper = Axis::linear(-1.0, 1.0, 4).within(-1.1, 1.1);
    let ends = rows
        .iter()
        .flat_map(|row| [row.low, row.high, row.exact_transfer].map(|y| y - row.theory));
    let widest = ends.map(f64::abs).fold(1e-12, f64::max);
    let lower = Axis::linear(-1.1 * widest, 1.1 * widest, 6).labelled("minus theory");
    let panels = [
        (UPPER, upper.labelled("ρ_k, autocorrelation")),
        (LOWER, lower),
    ];
    let mut plot = Plot::stack(&x.labelled(format!("lag k, samples{unit}")), panels);
    let line = |y: fn(&Row) -> f64| rows.iter().map(|row| (row.lag as f64, y(row))).collect();
    let estimates = rows.iter().map(|row| (row.lag as f64, row.estimate));
    let estimates = estimates.map(Point::at).collect();
    let deviations = rows.iter().map(|row| {
        let deviations = [row.low, row.estimate, row.high].map(|y| y - row.theory);
        Point::new(row.lag as f64, deviations)
    });
    plot.add_to_all(&Mark::Grid);
    plot.add(0, Mark::Line(line(|row| row.theory), THEORY));
    plot.add(0, Mark::Line(line(|row| row.exact_transfer), EXACT));
    plot.add(0, Mark::Axes);
    plot.add(0, Mark::Markers(estimates, SIMULATION));
    let entry = |text: &str, index, key| Entry::new(text, Style::of(index), key);
    let entries = [
        entry("theory, coefficients of the simulation", 0, Key::Line),
        entry("theory, exact transfer of (1)", 3, Key::Line),
        entry("simulation", 1, Key::Marker),
    ];
    plot.add_legend(entries, Place::Free);
    plot.add(1, Mark::Level(0.0, &[]));
    let exact = line(|row| row.exact_transfer - row.theory);
    plot.add(1, Mark::Line(exact, EXACT));
    plot.add(1, Mark::Points(deviations.collect(), SIMULATION));
    plot.add(1, Mark::Axes);
    plot.set_caption(&caption(records));
    plot
}

fn caption(records: &Records) -> [String; 6] {
    let (trials, length) = (thousands(records.trials), thousands(records.length as u64));
    let percent = 100.0 * records.confidence;
    [
        literal(&records.sensor.to_string()).replace('-', "−"),
        format!("{} noise", literal(&records.noise.to_string())),
        format!("{trials} records of {length} samples"),
        "mean product over the known variance of x".to_owned(),
        format!("seed {}", records.seed),
        format!("bars: pointwise normal {percent} % intervals of the mean"),
    ]
}
