//! Text, measured in points (1/72 inch): the embedded DejaVu Sans; `_` makes the next character a
//! subscript.

use ab_glyph::{Font, FontRef, ScaleFont};
use std::collections::BTreeSet;

/// Em size of tick labels, legends and names.
pub const SMALL: f64 = 8.0;
/// Em size of a caption.
pub const CAPTION: f64 = 7.5;
/// Em size of axis labels and titles.
pub const NORMAL: f64 = 9.0;
/// From one line of labels and titles to the next.
pub(super) const LINE: f64 = 11.0;
/// The font library counts a size from descender to ascender; this many times the em.
pub(super) const FONT_HEIGHT: f64 = 1.164;
/// Stands for an underscore that is meant as one.
const UNDERSCORE: char = '\u{e000}';

/// A stretch of text on one line, or one character below it.
pub(super) struct Run {
    pub text: String,
    pub is_subscript: bool,
}

/// The embedded font.
pub fn font() -> FontRef<'static> {
    FontRef::try_from_slice(dejavu::sans::regular()).expect("the embedded font is a font")
}

/// The characters that the font has no sign for, in order.
pub(super) fn missing_glyphs<'t>(texts: impl Iterator<Item = &'t str>) -> Vec<char> {
    let font = font();
    let all = texts
        .flat_map(str::chars)
        .filter(|c| *c != UNDERSCORE && !c.is_control());
    let missing: BTreeSet<char> = all.filter(|c| font.glyph_id(*c).0 == 0).collect();
    missing.into_iter().collect()
}

/// Text in which an underscore is an underscore.
pub fn literal(text: &str) -> String {
    text.replace('_', &UNDERSCORE.to_string())
}

/// Width of a text in points at an em of `size`, subscripts included.
pub fn text_width(text: &str, size: f64) -> f64 {
    runs(text).iter().map(|run| run.width(size)).sum()
}

/// The parts in lines of a caption, at most `width` points wide, broken between parts; a part that is
/// wider alone is broken between its words, and a word that is, as a file's name may be, loses its middle.
pub fn wrap(parts: &[String], width: f64) -> Vec<String> {
    let fits = |line: &str| text_width(line, CAPTION) <= width;
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        let pieces: Vec<&str> = if fits(part) {
            vec![part]
        } else {
            part.split(' ').collect()
        };
        for (index, piece) in pieces.into_iter().enumerate() {
            let joint = if index == 0 { "; " } else { " " };
            let longer = lines.last().map(|line| format!("{line}{joint}{piece}"));
            match longer.filter(|line| fits(line)) {
                Some(line) => *lines.last_mut().expect("there is a line") = line,
                None => lines.push(without_middle(piece, fits)),
            }
        }
    }
    lines
}

/// As much of both ends of a text as fits.
fn without_middle(text: &str, fits: impl Fn(&str) -> bool) -> String {
    if fits(text) {
        return text.to_owned();
    }
    let characters: Vec<char> = text.chars().collect();
    let ends = |each: usize| {
        let (head, tail) = (&characters[..each], &characters[characters.len() - each..]);
        head.iter().chain(&['…']).chain(tail).collect::<String>()
    };
    let most = (0..=characters.len() / 2)
        .rev()
        .find(|each| fits(&ends(*each)));
    ends(most.unwrap_or(0))
}

impl Run {
    pub fn scale(&self) -> f64 {
        if self.is_subscript { 0.7 } else { 1.0 }
    }

    pub fn width(&self, size: f64) -> f64 {
        font_width(&self.text, size * self.scale() * FONT_HEIGHT)
    }
}

/// Width in points of a text without subscripts, `height` points from descender to ascender.
pub(super) fn font_width(text: &str, height: f64) -> f64 {
    let font = font().into_scaled(height as f32);
    let glyphs = text.chars().map(|c| font.glyph_id(c));
    glyphs.map(|glyph| f64::from(font.h_advance(glyph))).sum()
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
