//! Text on a sheet: the embedded DejaVu Sans, measured in points; `_` makes the next character a
//! subscript.

use ab_glyph::{Font, FontRef, ScaleFont};
use plotters::prelude::{BLACK, FontStyle, RGBColor};
use plotters::style::register_font;
use std::sync::OnceLock;

/// The font library counts a size from descender to ascender; this many times the em.
pub(super) const FONT_HEIGHT: f64 = 1.164;
/// What the drawing library calls the embedded font.
pub(super) const FAMILY: &str = "sans-serif";

/// Where on a text its position is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// The look of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Em size in points.
    pub size: f64,
    pub colour: RGBColor,
    pub align: Align,
    /// Reads upwards.
    pub upright: bool,
}

impl Style {
    /// Horizontal black text.
    pub fn plain(size: f64, align: Align) -> Self {
        Self {
            size,
            colour: BLACK,
            align,
            upright: false,
        }
    }
}

/// The embedded font.
pub(super) fn font() -> FontRef<'static> {
    FontRef::try_from_slice(dejavu::sans::regular()).expect("the embedded font is a font")
}

pub(super) fn register_embedded_font() {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        let registered = register_font(FAMILY, FontStyle::Normal, dejavu::sans::regular());
        assert!(registered.is_ok(), "the embedded font is a font");
    });
}

/// Stands for an underscore that is meant as one.
const UNDERSCORE: char = '\u{e000}';

/// A user's own words: an underscore in them lowers nothing.
pub(super) fn literal(text: &str) -> String {
    text.replace('_', &UNDERSCORE.to_string())
}

/// Width of a text in points at `size`, subscripts included.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    runs(text).iter().map(|run| run.width(size)).sum()
}

/// A stretch of text on one line, or one character below it.
pub(super) struct Run {
    pub text: String,
    pub is_subscript: bool,
}

impl Run {
    pub fn scale(&self) -> f64 {
        if self.is_subscript { 0.7 } else { 1.0 }
    }

    pub fn width(&self, size: f64) -> f64 {
        let scale = (size * self.scale() * FONT_HEIGHT) as f32;
        let font = font().into_scaled(scale);
        let advance = |c: char| f64::from(font.h_advance(font.glyph_id(c)));
        self.text.chars().map(advance).sum()
    }
}

/// The text in stretches, in their order.
pub(super) fn runs(text: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    for (index, part) in text.split('_').enumerate() {
        let lowered = match index {
            0 => 0,
            _ => part.chars().next().map_or(0, char::len_utf8),
        };
        for (text, is_subscript) in [(&part[..lowered], true), (&part[lowered..], false)] {
            if !text.is_empty() {
                let text = text.replace(UNDERSCORE, "_");
                runs.push(Run { text, is_subscript });
            }
        }
    }
    runs
}
