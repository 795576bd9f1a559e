//! A recording and what was found in it: the record, the same whitened, speed and position; states shaded and named,
//! undecided stretches hatched; X, Y₁ and Y₂ of each decision.

use super::error::FigureError;
use super::record::Recorded;
use crate::detection::Detection;
use crate::monitor::Decision;
use crate::plot::{Colour, Entry, Key, Mark, Plot, Style, add_phases, phase_colour, phase_words};

/// Heights of the panels of the record and of the course, points.
const PANEL: f64 = 120.0;
const COURSE: f64 = 60.0;
/// Room for the bars of the samples, as a share of the lower panel.
const BARS: f64 = 0.34;

/// The picture of a recording, whose name is `name` and whose times count from `zero`, and what was found in
/// it.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(detection: &Detection, name: &str, zero: Option<&str>) -> Result<Plot, FigureError> {
    let recorded = Recorded::of(detection)?;
    let record = recorded.axis_where_known(0.08, |column| column.record);
    let whitened = recorded.axis_where_known(BARS, |column| column.whitened);
    let speed = recorded.axis(0.08, |column| column.speed);
    let position = recorded.axis(0.08, |column| column.position);
    let panels = [
        (PANEL, record.labelled("record, m/s²")),
        (PANEL, whitened.labelled("whitened, m/s²")),
        (COURSE, speed.labelled("speed, m/s")),
        (COURSE, position.labelled("position, m")),
    ];
    let mut plot = recorded.panels(&panels);
    add_phases(&mut plot, &recorded.states, 5.0);
    recorded.hatch(&mut plot, &panels);
    plot.add(1, Mark::Level(0.0, &[]));
    plot.add(2, Mark::Level(0.0, &[]));
    plot.add(0, recorded.values(|column| column.record));
    plot.add(1, recorded.values(|column| column.whitened));
    plot.add(2, recorded.values(|column| column.speed));
    plot.add(3, recorded.values(|column| column.position));
    for trip in &detection.trips {
        for decision in trip.start_decision.iter().chain(&trip.stop_decision) {
            add_decision(&mut plot, decision);
        }
    }
    Ok(recorded.finish(plot, entries(), (name, zero), settings(detection)))
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

fn settings(detection: &Detection) -> Vec<String> {
    let design = &detection.design;
    let mut parts = vec![
        format!("blocks of {:.0} ms", 1000.0 * design.block),
        format!("N/M_1/M_2 = {}", design.samples),
        format!("α = {}", design.settings.detector.alpha),
    ];
    if let Some(reference) = &detection.knowledge.reference {
        parts.push(format!("filter of order {}", reference.coefficients.len()));
    }
    parts
}
