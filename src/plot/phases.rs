//! What pictures of a ride in time share: phases shaded and named.

use super::axis::Axis;
use super::mark::Mark;
use super::picture::Plot;
use super::style::{Colour, Style};

/// The shade of a phase.
pub fn phase_colour(name: &str) -> Colour {
    match name {
        "acceleration" => Colour::new(253, 236, 214),
        "inertial" => Colour::new(226, 240, 250),
        "braking" => Colour::new(247, 228, 240),
        "levelling" => Colour::new(226, 243, 226),
        "unknown" => Colour::new(232, 232, 232),
        _ => Colour::WHITE,
    }
}

/// Slanted lines over a stretch of a panel with these axes: what is there is not known.
pub fn hatch((from, to): (f64, f64), x: &Axis, y: &Axis) -> Vec<Mark> {
    let style = Style::of(0).coloured(Colour::new(170, 170, 170));
    let step = (x.to - x.from) / 80.0;
    let count = ((to - from) / step) as i32 + SLANT;
    let lines = (1 - SLANT..count).map(|line| {
        let foot = from + f64::from(line) * step;
        let width = f64::from(SLANT) * step;
        let at = |time: f64| (time, y.from + (y.to - y.from) * (time - foot) / width);
        let ends = (foot.max(from), (foot + width).min(to));
        vec![at(ends.0), at(ends.1)]
    });
    lines
        .filter(|ends| ends[0].0 < ends[1].0)
        .map(|ends| Mark::Line(ends, style))
        .collect()
}

/// How many lines of a hatch begin below one of them.
const SLANT: i32 = 6;

/// A phase in words.
pub fn phase_words(name: &str) -> &str {
    match name {
        "inertial" => "inertial motion",
        other => other,
    }
}

/// Shades phases in every panel, and names them so many points above the first.
pub fn add_phases(plot: &mut Plot, phases: &[((f64, f64), &str)], above: f64) {
    for (stretch, name) in phases {
        for panel in 0..plot.panels.len() {
            plot.add(panel, Mark::Span(*stretch, phase_colour(name)));
        }
    }
    let names = phases
        .iter()
        .map(|(stretch, name)| (*stretch, phase_words(name).to_owned()));
    plot.add(0, Mark::Names(names.collect(), above));
}
