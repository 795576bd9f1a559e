//! A ride in time: the record, and below it the same whitened; phases shaded and named, samples
//! bracketed.

use super::row::Row;
use super::table::Trace;
use crate::chain::Scenario;
use crate::plot::{Axis, Entry, Key, Mark, Place, Plot, Point, Style, add_phases, ends, literal};

const SINGLE: f64 = 190.0;
const PANEL: f64 = 128.0;
/// Room for the names of the phases.
const NAMES: f64 = 16.0;
/// Room for the brackets of the samples.
const BRACKETS: f64 = 18.0;
/// Fewer samples than this get a marker each.
const FEW: usize = 250;

/// The picture of a ride.
pub fn plot(rows: &[Row], trace: &Trace, scenario: &Scenario, seed: u64) -> Plot {
    let rows = &rows[trace.drawn_from.min(rows.len() - 1)..];
    let time = Time::new(trace, rows);
    let unit = unit_words(&trace.unit);
    let record = values(rows, 0.34, |row| Some(row.record)).labelled(format!("record, {unit}"));
    let whitened = values(rows, 0.06, |row| row.whitened).labelled(format!("whitened, {unit}"));
    let x = time.axis(rows);
    let (mut plot, brackets) = if trace.whitened {
        let panels = [(PANEL, record), (PANEL, whitened)];
        (Plot::stack(&x, panels), BRACKETS)
    } else {
        (Plot::stack(&x, [(SINGLE, record)]), 0.0)
    };
    plot.margins.top = NAMES + brackets;
    let phases = time.stretches(rows, |row| row.phase.as_str());
    add_phases(&mut plot, &phases, 5.0 + brackets);
    let samples = time.stretches(rows, |row| row.sample.as_deref().unwrap_or(""));
    add_samples(&mut plot, &samples);
    plot.add_to_all(&Mark::Level(0.0, &[]));
    add_values(&mut plot, 0, time.line(rows, |row| Some(row.record)));
    let steps = time.stretches(rows, |row| row.acceleration).into_iter();
    let line = steps.flat_map(|((from, to), y)| [(from, y), (to, y)]);
    let style = Style::of(1).solid().wide(1.3);
    plot.add(0, Mark::Line(line.collect(), style));
    if trace.whitened {
        add_values(&mut plot, 1, time.line(rows, |row| row.whitened));
    }
    plot.add_to_all(&Mark::Axes);
    let entry = |index, text| Entry::new(text, Style::of(index).solid(), Key::Line);
    let entries = [entry(0, "record"), entry(1, "acceleration in it")];
    plot.add_legend(entries, Place::Free);
    plot.set_caption(&caption(scenario, trace, seed));
    plot
}

/// Where samples stand in time.
struct Time {
    /// Half the time between two samples, s.
    half: f64,
    /// Seconds in a unit of the axis.
    unit: f64,
    label: &'static str,
}

impl Time {
    fn new(trace: &Trace, rows: &[Row]) -> Self {
        let (unit, label) = if trace.rate == 1.0 {
            (1.0, "time, samples")
        } else if trace.rate > 1.0 && rows[rows.len() - 1].time < 1.0 {
            (1e-3, "time, ms")
        } else {
            (1.0, "time, s")
        };
        let half = 0.5 / trace.rate;
        Self { half, unit, label }
    }

    fn of(&self, row: &Row) -> f64 {
        row.time / self.unit
    }

    fn axis(&self, rows: &[Row]) -> Axis {
        let from = rows[0].time - self.half;
        let to = rows[rows.len() - 1].time + 2.0 * self.half;
        Axis::linear(from / self.unit, to / self.unit, 8).labelled(self.label)
    }

    fn line(&self, rows: &[Row], of: fn(&Row) -> Option<f64>) -> Vec<(f64, f64)> {
        let points = rows.iter().filter_map(|row| Some((self.of(row), of(row)?)));
        points.collect()
    }

    /// The stretches in which `of` is constant, each with its ends.
    fn stretches<'r, T: Copy + PartialEq>(
        &self,
        rows: &'r [Row],
        of: impl Fn(&'r Row) -> T,
    ) -> Vec<((f64, f64), T)> {
        let half = self.half / self.unit;
        let places: Vec<(f64, T)> = rows.iter().map(|row| (self.of(row), of(row))).collect();
        (places.chunk_by(|a, b| a.1 == b.1))
            .map(|stretch| (stretch[0], stretch[stretch.len() - 1]))
            .map(|((first, value), (last, _))| ((first - half, last + half), value))
            .collect()
    }
}

/// A bracket over each sample, and its limits through the panels.
fn add_samples(plot: &mut Plot, samples: &[((f64, f64), &str)]) {
    for &(stretch, name) in samples {
        let words = match name {
            "training" => "training",
            "reference" => "X",
            "shift" => "Y_1",
            "scale" => "Y_2",
            _ => continue,
        };
        plot.add(0, Mark::Bracket(stretch, words));
        if name != "training" {
            plot.add(0, Mark::Limit(stretch.0));
            plot.add(0, Mark::Limit(stretch.1));
        }
    }
}

fn add_values(plot: &mut Plot, panel: usize, line: Vec<(f64, f64)>) {
    let style = Style::of(0).wide(0.7).sized(1.4);
    if line.len() >= FEW {
        return plot.add(panel, Mark::Dense(line, style));
    }
    let points = line.iter().copied().map(Point::at).collect();
    if line.len() > 1 {
        plot.add(panel, Mark::Line(line, style));
    }
    plot.add(panel, Mark::Markers(points, style));
}

/// An axis that holds every value and zero, with a share `above` of their range left free on top.
fn values(rows: &[Row], above: f64, value: fn(&Row) -> Option<f64>) -> Axis {
    let (low, high) = ends(rows.iter().filter_map(value).chain([0.0]));
    let room = (high - low).max(1e-9);
    Axis::linear(low - 0.06 * room, high + above * room, 5)
}

/// The unit as its author wrote it; σ_ξ keeps its index.
fn unit_words(unit: &str) -> String {
    if unit == "σ_ξ" {
        unit.to_owned()
    } else {
        literal(unit)
    }
}

fn caption(scenario: &Scenario, trace: &Trace, seed: u64) -> Vec<String> {
    let unit = unit_words(&trace.unit);
    let measured = |name: &str, value: f64| {
        let value = (value * trace.sigma * 1e6).round() / 1e6;
        format!("{name} = {value} {unit}")
    };
    let delta = scenario.motion.record_delta(scenario.sensor.step_gain());
    let mut parts = vec!["simulated".to_owned(), measured("Δ", delta)];
    if trace.unit != "σ_ξ" {
        parts.push(measured("σ_ξ", 1.0));
    }
    if !scenario.impulses.are_absent() {
        parts.push(format!("ν = {}", scenario.impulses.nu.get()));
        parts.push(measured("θ", scenario.impulses.theta.get()));
    }
    if trace.vibration > 0.0 {
        parts.push(measured("vibration", trace.vibration));
    }
    parts.push(format!("{} noise", literal(&scenario.noise.to_string())));
    parts.push(literal(&scenario.sensor.to_string()).replace('-', "−"));
    let digitiser = &scenario.digitiser;
    parts.extend(digitiser.quantum().map(|step| measured("step", step)));
    parts.extend(digitiser.range().map(|range| measured("range", range)));
    if trace.whitened {
        let whitening = &scenario.whitening;
        parts.push(format!("{} filter", whitening.fit));
        parts.push(format!("order {}", whitening.order));
        parts.push(format!("training {}", whitening.training));
        parts.push(format!("N/M_1/M_2 = {}", scenario.samples));
    }
    parts.push(format!("seed {seed}"));
    parts
}
