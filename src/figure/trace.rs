//! A ride in time: the record, and below it the same whitened; phases shaded and named, samples
//! bracketed.

use super::phases::add_phases;
use crate::chain::Scenario;
use crate::experiment::Trace;
use crate::study::trace::Row;
use crate::plot::{
    Axis, Entry, Key, Legend, Margins, Mark, Place, Plot, Point, Style, ends, literal,
};

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
    let (mut plot, brackets) = match trace.whitened {
        false => (Plot::stack(&time.axis(rows), [(SINGLE, record)]), 0.0),
        true => {
            let whitened =
                values(rows, 0.06, |row| row.whitened).labelled(format!("whitened, {unit}"));
            let panels = [(PANEL, record), (PANEL, whitened)];
            (Plot::stack(&time.axis(rows), panels), BRACKETS)
        }
    };
    plot.margins = Margins {
        top: NAMES + brackets,
        ..Margins::default()
    };
    add_phases(
        &mut plot,
        &time.stretches(rows, |row| row.phase.as_str()),
        5.0 + brackets,
    );
    add_samples(
        &mut plot,
        &time.stretches(rows, |row| row.sample.as_deref().unwrap_or("")),
    );
    for panel in 0..plot.panels.len() {
        plot.add(panel, Mark::Level { y: 0.0, dash: &[] });
    }
    add_values(
        &mut plot,
        0,
        rows.iter().map(|row| (time.of(row), row.record)).collect(),
    );
    let steps = time.stretches(rows, |row| row.acceleration);
    let line = steps.iter().flat_map(|&(from, to, y)| [(from, y), (to, y)]);
    plot.add(0, Mark::line(line, 1.3, Style::of(1).solid()));
    if trace.whitened {
        let whitened = rows
            .iter()
            .filter_map(|row| Some((time.of(row), row.whitened?)));
        add_values(&mut plot, 1, whitened.collect());
    }
    for panel in 0..plot.panels.len() {
        plot.add(panel, Mark::Axes);
    }
    plot.add(0, Mark::Legend);
    let entry = |index, text| Entry::new(text, Style::of(index).solid(), Key::Line);
    let entries = vec![entry(0, "record"), entry(1, "acceleration in it")];
    plot.legend = Some(Legend::new(entries, Place::Free));
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

    /// The stretches in which `of` says the same, each with its ends.
    fn stretches<'r, T: Copy + PartialEq>(
        &self,
        rows: &'r [Row],
        of: impl Fn(&'r Row) -> T,
    ) -> Vec<(f64, f64, T)> {
        let half = self.half / self.unit;
        let places: Vec<(f64, T)> = rows.iter().map(|row| (self.of(row), of(row))).collect();
        (places.chunk_by(|a, b| a.1 == b.1))
            .map(|stretch| (stretch[0], stretch[stretch.len() - 1]))
            .map(|((first, said), (last, _))| (first - half, last + half, said))
            .collect()
    }
}

/// A bracket over each sample, and its limits through the panels.
fn add_samples(plot: &mut Plot, samples: &[(f64, f64, &str)]) {
    for &(from, to, name) in samples {
        let words = match name {
            "training" => "training",
            "reference" => "X",
            "shift" => "Y_1",
            "scale" => "Y_2",
            _ => continue,
        };
        plot.add(
            0,
            Mark::Bracket {
                from,
                to,
                name: words.to_owned(),
            },
        );
        for x in [from, to].into_iter().filter(|_| name != "training") {
            plot.add(0, Mark::Limit { x });
        }
    }
}

fn add_values(plot: &mut Plot, panel: usize, line: Vec<(f64, f64)>) {
    let style = Style::of(0);
    if line.len() >= FEW {
        return plot.add(
            panel,
            Mark::Dense {
                points: line,
                colour: style.colour,
            },
        );
    }
    if line.len() > 1 {
        plot.add(panel, Mark::line(line.iter().copied(), 0.7, style));
    }
    let points = line.into_iter().map(|(x, y)| Point::at(x, y));
    plot.add(
        panel,
        Mark::Points {
            points: points.collect(),
            size: 1.4,
            width: 0.0,
            style,
        },
    );
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
        parts.push(format!("ν = {}", scenario.impulses.nu()));
        parts.push(measured("θ", scenario.impulses.theta()));
    }
    if trace.vibration > 0.0 {
        parts.push(measured("vibration", trace.vibration));
    }
    parts.push(format!("{} noise", literal(&scenario.noise.to_string())));
    parts.push(literal(&scenario.sensor.to_string()).replace('-', "−"));
    parts.extend(
        scenario
            .digitiser
            .quantum()
            .map(|quantum| measured("step", quantum)),
    );
    parts.extend(
        scenario
            .digitiser
            .range()
            .map(|range| measured("range", range)),
    );
    if trace.whitened {
        let whitening = &scenario.whitening;
        parts.push(format!("{} filter", whitening.fit()));
        parts.push(format!("order {}", whitening.order()));
        parts.push(format!("training {}", whitening.training()));
        parts.push(format!("N/M_1/M_2 = {}", scenario.samples));
    }
    parts.push(format!("seed {seed}"));
    parts
}
