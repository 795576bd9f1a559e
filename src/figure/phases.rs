//! What pictures of a ride in time share: phases shaded and named, limits of samples dashed, lines too dense
//! to be drawn turn by turn.

use super::FigureError;
use super::sheet::Sheet;
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor};

/// Width of a column of a dense line, in points.
const COLUMN: f64 = 0.4;

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

/// A line so dense that its turns cannot be told apart: an upright bar over the extremes of each column,
/// its neighbour's end included, because the turns of a thick line would reach beyond its points.
pub(super) fn draw_dense<B: DrawingBackend>(
    sheet: &Sheet<B>,
    line: &[(f64, f64)],
    colour: RGBColor,
) -> Result<(), FigureError> {
    let column = |place: &(f64, f64)| (place.0 / COLUMN).floor();
    let mut before: Option<f64> = None;
    for places in line.chunk_by(|a, b| column(a) == column(b)) {
        let ys = || places.iter().map(|place| place.1).chain(before);
        let top = ys().fold(f64::INFINITY, f64::min);
        let bottom = ys().fold(f64::NEG_INFINITY, f64::max);
        let x = (column(&places[0]) + 0.5) * COLUMN;
        sheet.line(
            &[(x, top - 0.2), (x, bottom + 0.2)],
            COLUMN,
            colour.to_rgba(),
        )?;
        before = places.last().map(|place| place.1);
    }
    Ok(())
}
