//! Autocorrelation against lag, and below it how far the simulation is from theory.

use crate::study::autocorrelation::Row;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Legend, Mark, Place, Plot, Point, Style, literal};
use crate::signal::{Noise, Sensor};

const UPPER: f64 = 160.0;
const LOWER: f64 = 92.0;
const LINE: f64 = 1.0;

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
    let label = match *records.sensor == Sensor::adxl105() {
        true => "lag k, samples (T_0 = 62.5 µs)",
        false => "lag k, samples",
    };
    let x = Axis::linear(0.0, last, 8)
        .within(-0.02 * last, 1.02 * last)
        .labelled(label);
    let deviations = rows
        .iter()
        .flat_map(|row| [row.low, row.high, row.exact_transfer].map(|y| y - row.theory));
    let widest = deviations.map(f64::abs).fold(1e-12, f64::max);
    let upper = Axis::linear(-1.0, 1.0, 4)
        .within(-1.1, 1.1)
        .labelled("ρ_k, autocorrelation");
    let lower = Axis::linear(-1.1 * widest, 1.1 * widest, 6).labelled("minus theory");
    let mut plot = Plot::stack(&x, [(UPPER, upper), (LOWER, lower)]);
    let [theory, exact, simulation] = [0, 3, 1].map(Style::of);
    let line = |y: fn(&Row) -> f64, style| {
        Mark::line(rows.iter().map(|row| (row.lag as f64, y(row))), LINE, style)
    };
    let points = |point: fn(&Row) -> Point| Mark::Points {
        points: rows.iter().map(point).collect(),
        size: 2.0,
        width: 0.8,
        style: simulation,
    };
    plot.add(0, Mark::Grid);
    plot.add(1, Mark::Grid);
    plot.add(0, line(|row| row.theory, theory));
    plot.add(0, line(|row| row.exact_transfer, exact));
    plot.add(0, Mark::Axes);
    plot.add(0, points(|row| Point::at(row.lag as f64, row.estimate)));
    plot.add(0, Mark::Legend);
    plot.add(1, Mark::Level { y: 0.0, dash: &[] });
    plot.add(1, line(|row| row.exact_transfer - row.theory, exact));
    plot.add(
        1,
        points(|row| Point {
            bar: Some((row.low - row.theory, row.high - row.theory)),
            ..Point::at(row.lag as f64, row.estimate - row.theory)
        }),
    );
    plot.add(1, Mark::Axes);
    let entries = vec![
        Entry::new("theory, coefficients of the simulation", theory, Key::Line),
        Entry::new("theory, exact transfer of (1)", exact, Key::Line),
        Entry::new("simulation", simulation, Key::Marker),
    ];
    plot.legend = Some(Legend::new(entries, Place::Free));
    plot.set_caption(&caption(records));
    plot
}

fn caption(records: &Records) -> [String; 6] {
    [
        literal(&records.sensor.to_string()).replace('-', "−"),
        format!("{} noise", literal(&records.noise.to_string())),
        format!(
            "{} records of {} samples",
            thousands(records.trials),
            thousands(records.length as u64)
        ),
        "mean product over the known variance of x".to_owned(),
        format!("seed {}", records.seed),
        format!(
            "bars: pointwise normal {} % intervals of the mean",
            100.0 * records.confidence
        ),
    ]
}
