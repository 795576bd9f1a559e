//! Where the samples of a trial lie: the acceleration above, the blocks below, one axis.

use super::row::Row;
use crate::chain::Scenario;
use crate::plot::{Axis, Block, Mark, Plot, Style, add_phases};
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
    let upper = Axis::new(-0.35, 1.35, ticks).labelled("acceleration, σ_ξ");
    let lower = Axis::new(0.0, 1.0, Vec::new()).labelled("samples");
    let mut plot = Plot::stack(&x, [(UPPER, upper), (LOWER, lower)]);
    plot.margins.top = 18.0;
    // Both ends of a stretch, what is cut off left out.
    let ends = |row: &Row| ((row.start as f64).max(from), (row.end as f64).min(to));
    let phases = ["rest", "acceleration", "inertial"]
        .iter()
        .filter_map(|name| {
            let row = rows.iter().find(|row| row.name == *name)?;
            Some((ends(row), *name))
        });
    add_phases(&mut plot, &phases.collect::<Vec<_>>(), 5.0);
    for block in rows.iter().filter_map(|row| block(row, ends(row))) {
        plot.add(1, Mark::Block(block));
    }
    let samples = ["reference", "shift", "scale"];
    for row in rows
        .iter()
        .filter(|row| samples.contains(&row.name.as_str()))
    {
        plot.add(0, Mark::Limit(row.start as f64));
        plot.add(0, Mark::Limit(row.end as f64));
    }
    let pulse = pulse(&scenario.motion, from, end);
    plot.add(0, Mark::Line(pulse, Style::of(1).solid().wide(1.3)));
    plot.add_to_all(&Mark::Axes);
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
    let turns = [start, start + rise, stop - rise, stop].into_iter();
    // A jump is upright: both its sides have a point.
    let corners = turns
        .filter(|time| *time < end)
        .flat_map(|time| [-1e-6, 1e-6].map(|side| (time, shape(time + side))));
    let last = (end, shape(end - 1e-6));
    [(from, 0.0)]
        .into_iter()
        .chain(corners)
        .chain([last])
        .collect()
}

/// What stands for a stretch of samples.
fn block(row: &Row, ends: (f64, f64)) -> Option<Block> {
    let length = row.end - row.start;
    let (style, lines): (_, &[&str]) = match row.name.as_str() {
        "training" => (Some(5), &["training", &format!("{length}, for the filter")]),
        "reference" => (Some(0), &["X", &format!("N = {length}")]),
        "shift" => (Some(1), &["Y_1", &format!("M_1 = {length}"), "shift: W"]),
        "scale" => (Some(2), &["Y_2", &format!("M_2 = {length}"), "scale: T"]),
        "gap" => (None, &["gap"]),
        _ => return None,
    };
    Some(Block {
        ends,
        is_cut: row.start as f64 != ends.0,
        colour: style.map(|index| Style::of(index).colour),
        lines: lines.iter().map(|&line| line.to_owned()).collect(),
    })
}

fn caption(scenario: &Scenario) -> [String; 7] {
    let (samples, motion) = (&scenario.samples, &scenario.motion);
    let (duration, offset) = (motion.duration, motion.offset);
    [
        format!("N = {}", samples.reference()),
        format!("M_1 = {}", samples.shift()),
        format!("M_2 = {}", samples.scale()),
        format!("gap {}", samples.gap()),
        format!("training {}", scenario.whitening.training),
        format!("acceleration: {duration} observations from {offset} on"),
        "impulses from observation 0 on".to_owned(),
    ]
}
