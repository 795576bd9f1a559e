//! What tells curves apart: colours, markers and dashes.

/// Red, green and blue, and how opaque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    pub rgb: [u8; 3],
    /// From 0 to 1.
    pub alpha: f64,
}

/// The shapes that tell curves apart without colour, and arrows to where a limit points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Cross,
    ArrowDown,
    ArrowUp,
}

/// What tells one curve from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub colour: Colour,
    pub marker: Marker,
    /// Points (1/72 inch) drawn and left out in turn; empty for a solid line.
    pub dash: &'static [f64],
}

impl Colour {
    pub const BLACK: Self = Self::new(0, 0, 0);
    pub const WHITE: Self = Self::new(255, 255, 255);

    /// Opaque.
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self {
            rgb: [red, green, blue],
            alpha: 1.0,
        }
    }

    /// The same, as opaque as `alpha` says.
    pub const fn faded(self, alpha: f64) -> Self {
        Self { alpha, ..self }
    }
}

impl Style {
    /// The style of curve `index`: colours that remain apart for colour-blind readers (Okabe and Ito),
    /// and markers that shift against them, so that 36 curves differ.
    pub fn of(index: usize) -> Self {
        const COLOURS: [Colour; 6] = [
            Colour::new(0, 114, 178),
            Colour::new(213, 94, 0),
            Colour::new(0, 158, 115),
            Colour::new(204, 121, 167),
            Colour::new(230, 159, 0),
            Colour::new(86, 180, 233),
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

    /// The same without dashes.
    pub const fn solid(self) -> Self {
        Self { dash: &[], ..self }
    }
}
