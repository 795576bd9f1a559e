//! A recording and what was found in it: the record, the same whitened, speed and position; states shaded and named,
//! undecided stretches hatched; X, Y₁ and Y₂ of each decision.

use super::error::FigureError;
use crate::detection::{Column, Detection, Trip};
use crate::monitor::Decision;
use crate::plot::{
    Axis, Colour, Entry, Key, Mark, Place, Plot, Style, add_phases, ends, hatch, literal,
    phase_colour, phase_words,
};

/// Heights of the panels of the record and of the course, points.
const PANEL: f64 = 120.0;
const COURSE: f64 = 60.0;
/// Room for the bars of the samples, as a share of the lower panel.
const BARS: f64 = 0.34;

/// The picture of a recording, whose name is `name` and whose times count from `clock_offset`, and what was found in
/// it.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(
    detection: &Detection,
    name: &str,
    clock_offset: Option<f64>,
) -> Result<Plot, FigureError> {
    let columns = detection.trace.columns();
    let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
        return Err(FigureError::Short);
    };
    let (from, to) = (first.times.0, last.times.1);
    let states = states(detection, from, to);
    let x = Axis::linear(from, to, 10).labelled("time, s");
    let record = y_axis(columns, &states, 0.08, |column| column.record).labelled("record, m/s²");
    let whitened =
        y_axis(columns, &states, BARS, |column| column.whitened).labelled("whitened, m/s²");
    let speed = y_axis(columns, &[], 0.08, |column| column.speed).labelled("speed, m/s");
    let position = y_axis(columns, &[], 0.08, |column| column.position).labelled("position, m");
    let axes = [record, whitened, speed, position];
    let mut plot = Plot::stack(
        &x,
        [PANEL, PANEL, COURSE, COURSE].into_iter().zip(axes.clone()),
    );
    (plot.margins.top, plot.margins.legend) = (16.0, (4.0, 4.0));
    add_phases(&mut plot, &states, 5.0);
    for it in &detection.undecided {
        for (panel, y) in axes.iter().enumerate() {
            for line in hatch((it.from, it.to), &x, y) {
                plot.add(panel, line);
            }
        }
    }
    plot.add(1, Mark::Level(0.0, &[]));
    plot.add(2, Mark::Level(0.0, &[]));
    plot.add(0, values(columns, |column| column.record));
    plot.add(1, values(columns, |column| column.whitened));
    plot.add(2, values(columns, |column| column.speed));
    plot.add(3, values(columns, |column| column.position));
    for trip in &detection.trips {
        for decision in trip.start_decision.iter().chain(&trip.stop_decision) {
            add_decision(&mut plot, decision);
        }
    }
    plot.add_to_all(&Mark::Axes);
    plot.add_legend(entries(), Place::Across);
    let mut caption = caption(detection, name);
    caption.extend(clock_offset.map(|offset| format!("times count from {offset:.3} s")));
    if let Some(time_constant) = detection.filter.time_constant() {
        caption.push(format!("restored from a high pass of {time_constant:.2} s"));
    }
    plot.set_caption(&caption);
    Ok(plot)
}

/// From when to when each state lasted, s, and its name.
pub(super) fn states(detection: &Detection, from: f64, to: f64) -> Vec<((f64, f64), &'static str)> {
    let mut changes: Vec<(f64, &'static str)> = vec![(from, "rest")];
    for trip in &detection.trips {
        changes.extend(phases(trip));
        if trip.start.is_none() {
            changes[0].1 = "unknown";
        }
    }
    for it in &detection.undecided {
        changes.retain(|(time, _)| !(it.from..it.to).contains(time));
        changes.extend([(it.from, "unknown"), (it.to, "rest")]);
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends = changes.iter().skip(1).map(|(time, _)| *time).chain([to]);
    let spans = changes
        .iter()
        .zip(ends)
        .map(|((from, name), to)| ((*from, to), *name));
    spans.filter(|((from, to), _)| from < to).collect()
}

/// When the phases of a trip begin, as far as the record shows.
fn phases(trip: &Trip) -> impl Iterator<Item = (f64, &'static str)> {
    let phases = [
        (trip.start, "acceleration"),
        (trip.inertial, "inertial"),
        (trip.braking, "braking"),
        (trip.levelling, "levelling"),
        (trip.stop, "rest"),
    ];
    phases
        .into_iter()
        .filter_map(|(time, name)| time.map(|time| (time, name)))
}

/// A scale for the times at which the state was known: a sensor that is picked up would flatten everything
/// else.
pub(super) fn y_axis(
    columns: &[Column],
    states: &[((f64, f64), &str)],
    above: f64,
    value: fn(&Column) -> (f64, f64),
) -> Axis {
    let is_known = |column: &&Column| {
        let mut known = states.iter().filter(|(_, name)| *name != "unknown");
        known.any(|((from, to), _)| *from <= column.times.0 && column.times.1 <= *to)
    };
    let known: Vec<_> = columns.iter().filter(is_known).map(value).collect();
    let shown = if known.is_empty() {
        columns.iter().map(value).collect()
    } else {
        known
    };
    let (low, high) = ends(shown.into_iter().flat_map(|(low, high)| [low, high]));
    let room = (high - low).max(1e-9);
    Axis::linear(low - 0.08 * room, high + above * room, 5)
}

/// The record as a line.
pub(super) fn values(columns: &[Column], value: fn(&Column) -> (f64, f64)) -> Mark {
    let points = columns.iter().flat_map(|column| {
        let ((from, to), (low, high)) = (column.times, value(column));
        [(from, low), (to, high)]
    });
    Mark::Dense(points.collect(), Style::of(0))
}

/// A bar for each of X, Y₁ and Y₂.
fn add_decision(plot: &mut Plot, decision: &Decision) {
    let samples = [
        decision.reference,
        Some(decision.shift),
        Some(decision.scale),
    ];
    for (index, span) in samples.iter().enumerate() {
        if let Some(span) = *span {
            let below = 6.0 + 5.0 * index as f64;
            plot.add(1, Mark::Bar(span, below, sample_colour(index)));
        }
    }
}

fn sample_colour(index: usize) -> Colour {
    [Colour::BLACK, Style::of(1).colour, Style::of(2).colour][index]
}

/// Phases above samples, in columns of two.
fn entries() -> [Entry; 8] {
    let entry =
        |text: &str, colour: Colour, key: Key| Entry::new(text, Style::of(0).coloured(colour), key);
    let shade = |name: &str| entry(phase_words(name), phase_colour(name), Key::Shade);
    let sample = |index: usize, name: &str| entry(name, sample_colour(index), Key::Line);
    [
        shade("acceleration"),
        sample(0, "X"),
        shade("inertial"),
        sample(1, "Y_1"),
        shade("braking"),
        sample(2, "Y_2"),
        shade("unknown"),
        shade("levelling"),
    ]
}

fn caption(detection: &Detection, name: &str) -> Vec<String> {
    let design = &detection.design;
    let mut parts = vec![
        literal(name),
        format!("{:.1} Hz", design.rate),
        format!("blocks of {:.0} ms", 1000.0 * design.block),
        format!("N/M_1/M_2 = {}", design.samples),
        format!("α = {}", design.settings.detector.alpha),
    ];
    if let Some(reference) = &detection.knowledge.reference {
        parts.push(format!("filter of order {}", reference.coefficients.len()));
    }
    parts
}
