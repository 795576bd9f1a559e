//! What tells curves apart: colours, markers and dashes.

use plotters::prelude::RGBColor;

/// The shapes that tell curves apart without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
    Wedge,
}

/// What tells one curve from another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub colour: RGBColor,
    pub marker: Marker,
    /// Points drawn and left out in turn, for lines without markers; none for a solid line.
    pub dash: &'static [f64],
}

impl Look {
    /// The look of curve `index`: colours that remain apart for colour-blind readers (Okabe and Ito),
    /// and markers that shift against them, so that 36 curves differ.
    pub fn of(index: usize) -> Self {
        const COLOURS: [RGBColor; 6] = [
            RGBColor(0, 114, 178),
            RGBColor(213, 94, 0),
            RGBColor(0, 158, 115),
            RGBColor(204, 121, 167),
            RGBColor(230, 159, 0),
            RGBColor(86, 180, 233),
        ];
        const MARKERS: [Marker; 6] = [
            Marker::Disc,
            Marker::Square,
            Marker::Triangle,
            Marker::Diamond,
            Marker::Wedge,
            Marker::Cross,
        ];
        const DASHES: [&[f64]; 4] = [&[], &[6.0, 2.0], &[1.5, 1.5], &[6.0, 1.5, 1.5, 1.5]];
        Self {
            colour: COLOURS[index % 6],
            marker: MARKERS[(index + index / 6) % 6],
            dash: DASHES[index % 4],
        }
    }
}
