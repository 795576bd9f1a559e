//! What pictures of a ride in time share: phases shaded and named, limits of samples dashed.

use super::FigureError;
use super::sheet::Sheet;
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor};

/// The shade of a phase.
pub(super) fn phase_colour(name: &str) -> RGBColor {
    match name {
        "acceleration" => RGBColor(253, 236, 214),
        "inertial" => RGBColor(226, 240, 250),
        "braking" => RGBColor(247, 228, 240),
        _ => RGBColor(255, 255, 255),
    }
}

/// A phase in words.
pub(super) fn phase_words(name: &str) -> &str {
    match name {
        "inertial" => "inertial motion",
        other => other,
    }
}

/// Where a sample begins or ends: an upright line from the upper to the lower end.
pub(super) fn draw_limit<B: DrawingBackend>(
    sheet: &Sheet<B>,
    x: f64,
    [upper, lower]: [f64; 2],
) -> Result<(), FigureError> {
    let line = [(x, upper), (x, lower)];
    sheet.dashed(&line, 0.5, BLACK.mix(0.6), &[2.0, 2.0])
}
