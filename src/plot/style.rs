//! What tells curves apart: colours, markers and dashes.

/// Red, green and blue, and opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    pub rgb: [u8; 3],
    /// From 0 to 1.
    pub alpha: f64,
}

/// The shapes that tell curves apart without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Cross,
}

/// How lines and markers are drawn; lengths in points (1/72 inch).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub colour: Colour,
    pub marker: Marker,
    /// Half the width of a marker.
    pub size: f64,
    /// Of a line.
    pub width: f64,
    /// Drawn and left out in turn; empty for a solid line.
    pub dash: &'static [f64],
}

impl Colour {
    pub const BLACK: Self = Self::new(0, 0, 0);
    pub const WHITE: Self = Self::new(255, 255, 255);

    /// Opaque.
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        let rgb = [red, green, blue];
        Self { rgb, alpha: 1.0 }
    }

    /// With opacity `alpha`.
    pub const fn faded(self, alpha: f64) -> Self {
        Self { alpha, ..self }
    }
}

impl Style {
    /// So many colours are used in turn.
    pub const COLOURS: usize = 6;

    /// The style of curve `index`: colours that remain apart for colour-blind readers, each with a contrast of at
    /// least 3 on white (the darker four of Okabe and Ito, brown and navy), and markers that shift against them, so
    /// that 36 curves differ.
    pub const fn of(index: usize) -> Self {
        const COLOURS: [Colour; Style::COLOURS] = [
            Colour::new(0, 114, 178),
            Colour::new(213, 94, 0),
            Colour::new(0, 158, 115),
            Colour::new(204, 121, 167),
            Colour::new(120, 70, 0),
            Colour::new(0, 45, 98),
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
            size: 2.3,
            width: 1.1,
            dash: DASHES[index % 4],
        }
    }

    /// A solid line.
    pub const fn solid(self) -> Self {
        self.dashed(&[])
    }

    pub const fn dashed(self, dash: &'static [f64]) -> Self {
        Self { dash, ..self }
    }

    pub const fn coloured(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub const fn faded(self, alpha: f64) -> Self {
        self.coloured(self.colour.faded(alpha))
    }

    /// Lines of this width.
    pub const fn wide(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// Markers of this half-width.
    pub const fn sized(self, size: f64) -> Self {
        Self { size, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (L₁ + 0.05)/(L₂ + 0.05) of WCAG 2, relative luminance by its definition for sRGB.
    #[test]
    fn colours_stand_out_on_white() {
        let linear = |part: u8| {
            let part = f64::from(part) / 255.0;
            if part <= 0.04045 {
                part / 12.92
            } else {
                libm::pow((part + 0.055) / 1.055, 2.4)
            }
        };
        for index in 0..Style::COLOURS {
            let [red, green, blue] = Style::of(index).colour.rgb.map(linear);
            let contrast = 1.05 / (0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05);
            assert!(contrast >= 3.0, "colour {index}: {contrast}");
        }
    }
}
