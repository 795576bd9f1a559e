//! Where the samples of a trial lie: the acceleration above, the blocks below, one axis.

use super::phases::add_phases;
use crate::chain::Scenario;
use crate::study::layout::Row;
use crate::plot::{Axis, Margins, Mark, Plot, Style};
use crate::signal::{Motion, Profile};

const UPPER: f64 = 84.0;
const LOWER: f64 = 74.0;

/// The picture of a layout.
pub fn plot(rows: &[Row], scenario: &Scenario) -> Plot {
    let reference = scenario.samples.reference() as f64;
    let end = rows.iter().map(|row| row.end).max().unwrap_or(0) as f64;
    let first = rows.iter().map(|row| row.start).min().unwrap_or(0) as f64;
    // A long training record is cut: what counts is where it ends.
    let cut = (reference + 0.35 * (reference + end)).ceil();
    let (from, to) = (first.max(-cut), end + 0.04 * (end + cut));
    let x = Axis::linear(from, end, 8)
        .within(from, to)
        .labelled("time, observations after X");
    let ticks = vec![(0.0, "0".to_owned()), (1.0, "Δ".to_owned())];
    let upper = Axis::at(-0.35, 1.35, ticks).labelled("acceleration, σ_ξ");
    let lower = Axis::at(0.0, 1.0, Vec::new()).labelled("samples");
    let margins = Margins {
        top: 18.0,
        ..Margins::default()
    };
    let mut plot = Plot {
        margins,
        ..Plot::stack(&x, [(UPPER, upper), (LOWER, lower)])
    };
    // Both ends of a stretch, what is cut off left out.
    let ends = |row: &Row| ((row.start as f64).max(from), (row.end as f64).min(to));
    let phases = ["rest", "acceleration", "inertial"]
        .iter()
        .filter_map(|name| {
            let (from, to) = ends(rows.iter().find(|row| row.name == *name)?);
            Some((from, to, *name))
        });
    add_phases(&mut plot, &phases.collect::<Vec<_>>(), 5.0);
    for row in rows {
        if let Some((style, lines)) = block(row) {
            let is_cut = row.start as f64 != ends(row).0;
            let (from, to) = ends(row);
            let colour = style.map(|index| Style::of(index).colour);
            plot.add(
                1,
                Mark::Block {
                    from,
                    to,
                    is_cut,
                    colour,
                    lines,
                },
            );
        }
    }
    let samples = rows
        .iter()
        .filter(|row| ["reference", "shift", "scale"].contains(&row.name.as_str()));
    for x in samples.flat_map(|row| [row.start, row.end]) {
        plot.add(0, Mark::Limit { x: x as f64 });
    }
    plot.add(
        0,
        Mark::line(
            pulse(&scenario.motion, from, end),
            1.3,
            Style::of(1).solid(),
        ),
    );
    plot.add(0, Mark::Axes);
    plot.add(1, Mark::Axes);
    plot.set_caption(&caption(scenario));
    plot
}

/// The acceleration until `end`, its corners as points.
fn pulse(motion: &Motion, from: f64, end: f64) -> Vec<(f64, f64)> {
    let shape = |time: f64| if time < 0.0 { 0.0 } else { motion.shape(time) };
    let start = motion.offset as f64;
    let stop = start + motion.duration as f64;
    let rise = match motion.profile {
        Profile::Rectangular => 0.0,
        Profile::Trapezoid { rise } => rise,
    };
    let turns = [start, start + rise, stop - rise, stop]
        .into_iter()
        .filter(|time| *time < end);
    // A jump is upright: both its sides have a point.
    let corners = turns.flat_map(|time| [-1e-6, 1e-6].map(|side| (time, shape(time + side))));
    let last = (end, shape(end - 1e-6));
    [(from, 0.0)]
        .into_iter()
        .chain(corners)
        .chain([last])
        .collect()
}

/// The style of a stretch of samples, none for a gap, and what stands in it.
fn block(row: &Row) -> Option<(Option<usize>, Vec<String>)> {
    let length = row.end - row.start;
    let (style, lines): (_, &[&str]) = match row.name.as_str() {
        "training" => (Some(5), &["training", &format!("{length}, for the filter")]),
        "reference" => (Some(0), &["X", &format!("N = {length}")]),
        "shift" => (Some(1), &["Y_1", &format!("M_1 = {length}"), "shift: W"]),
        "scale" => (Some(2), &["Y_2", &format!("M_2 = {length}"), "scale: T"]),
        "gap" => (None, &["gap"]),
        _ => return None,
    };
    Some((style, lines.iter().map(|&line| line.to_owned()).collect()))
}

fn caption(scenario: &Scenario) -> [String; 7] {
    let (samples, motion) = (&scenario.samples, &scenario.motion);
    [
        format!("N = {}", samples.reference()),
        format!("M_1 = {}", samples.shift()),
        format!("M_2 = {}", samples.scale()),
        format!("gap {}", samples.gap()),
        format!("training {}", scenario.whitening.training()),
        format!(
            "acceleration: {} observations from {} on",
            motion.duration, motion.offset
        ),
        "impulses from observation 0 on".to_owned(),
    ]
}
