//! What pictures of a ride in time share: phases shaded and named.

use super::mark::Mark;
use super::picture::Plot;
use super::style::Colour;

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
