//! A recording and what was found in it: the record, below it the same whitened; states shaded and named; where
//! X, Y₁ and Y₂ of each decision lay, and when it was made.

use super::FigureError;
use super::phases::{add_phases, phase_colour, phase_words};
use crate::detection::{Column, Detection};
use crate::monitor::{Decision, Kind, State};
use crate::plot::{
    Axis, Colour, Entry, Key, Legend, Margins, Mark, Place, Plot, Style, ends, literal,
};

const PANEL: f64 = 140.0;
/// Room for the bars of the samples, as a share of the lower panel.
const BARS: f64 = 0.34;
/// Of X, Y₁ and Y₂.
const SAMPLES: [&str; 3] = ["X", "Y_1", "Y_2"];

/// The picture of a recording, whose name is `name`, and what was found in it.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(detection: &Detection, name: &str) -> Result<Plot, FigureError> {
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
    let margins = Margins {
        top: 16.0,
        legend: (4.0, 4.0),
        ..Margins::default()
    };
    let mut plot = Plot {
        margins,
        ..Plot::stack(&x, [(PANEL, record), (PANEL, whitened)])
    };
    add_phases(&mut plot, &states, 5.0);
    plot.add(1, Mark::Level { y: 0.0, dash: &[] });
    plot.add(0, values(columns, |column| column.record));
    plot.add(1, values(columns, |column| column.whitened));
    for event in &detection.events {
        if let Kind::Change {
            decision: Some(decision),
            ..
        } = event.kind
        {
            add_decision(&mut plot, &decision, event.reported);
        }
    }
    plot.add(0, Mark::Axes);
    plot.add(1, Mark::Axes);
    plot.add(0, Mark::Legend);
    plot.legend = Some(Legend::new(entries(), Place::Across));
    plot.set_caption(&caption(detection, name));
    Ok(plot)
}

/// From when to when each state lasted, s, and its name.
fn states(detection: &Detection, from: f64, to: f64) -> Vec<(f64, f64, &'static str)> {
    let mut states = vec![(from, to, "unknown")];
    for event in &detection.events {
        if let Kind::Change { state, .. } = event.kind {
            if let Some(last) = states.last_mut() {
                last.1 = event.time;
            }
            let name = match state {
                State::Unknown => "unknown",
                State::Known(phase) => phase.name(),
            };
            states.push((event.time, to, name));
        }
    }
    states.retain(|(from, to, _)| from < to);
    states
}

/// A scale for what was recorded while something was known of the cage: somebody who picks the sensor up
/// would flatten everything else.
fn y_axis(
    columns: &[Column],
    states: &[(f64, f64, &str)],
    above: f64,
    value: fn(&Column) -> (f64, f64),
) -> Axis {
    let is_known = |column: &&Column| {
        let mut known = states.iter().filter(|(_, _, name)| *name != "unknown");
        known.any(|(from, to, _)| *from <= column.times.0 && column.times.1 <= *to)
    };
    let known: Vec<_> = columns.iter().filter(is_known).map(value).collect();
    let shown = match known.is_empty() {
        true => columns.iter().map(value).collect(),
        false => known,
    };
    let (low, high) = ends(shown.into_iter().flat_map(|(low, high)| [low, high]));
    let room = (high - low).max(1e-9);
    Axis::linear(low - 0.08 * room, high + above * room, 5)
}

fn values(columns: &[Column], value: fn(&Column) -> (f64, f64)) -> Mark {
    let points = columns.iter().flat_map(|column| {
        let ((from, to), (low, high)) = (column.times, value(column));
        [(from, low), (to, high)]
    });
    Mark::Dense {
        points: points.collect(),
        colour: Style::of(0).colour,
    }
}

/// A bar for each of X, Y₁ and Y₂, and a dashed line where the decision was made.
fn add_decision(plot: &mut Plot, decision: &Decision, reported: f64) {
    let samples = [decision.reference, Some(decision.shift), Some(decision.scale)];
    for (index, span) in samples.into_iter().enumerate() {
        if let Some((from, to)) = span {
            let (below, colour) = (6.0 + 5.0 * index as f64, sample_colour(index));
            plot.add(
                1,
                Mark::Bar {
                    from,
                    to,
                    below,
                    colour,
                },
            );
        }
    }
    plot.add(1, Mark::Limit { x: reported });
}

fn sample_colour(index: usize) -> Colour {
    [Colour::BLACK, Style::of(1).colour, Style::of(2).colour][index]
}

/// Phases above samples, in columns of two.
fn entries() -> Vec<Entry> {
    let entry = |text: &str, colour: Colour, dash: &'static [f64], key: Key| {
        Entry::new(
            text,
            Style {
                colour,
                dash,
                ..Style::of(0)
            },
            key,
        )
    };
    let shade = |name: &str| entry(phase_words(name), phase_colour(name), &[], Key::Shade);
    let phases = ["acceleration", "inertial", "braking"]
        .into_iter()
        .enumerate();
    phases
        .flat_map(|(index, name)| {
            [
                shade(name),
                entry(SAMPLES[index], sample_colour(index), &[], Key::Line),
            ]
        })
        .chain([
            shade("unknown"),
            entry("decision made", Colour::BLACK, &[2.0, 2.0], Key::Line),
        ])
        .collect()
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
