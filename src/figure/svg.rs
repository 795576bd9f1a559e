//! SVG whose text is outlines, above everything else: no reader needs the font, and every reader sees the
//! same.

use crate::plot::{Canvas, Colour, Shape, font, rounded};
use ab_glyph::{Font, OutlineCurve, Point};
use std::fmt::{self, Write};

/// Units per point: coordinates are integers.
const UNITS: f64 = 20.0;

/// The picture, where it comes from in its description.
pub(super) fn svg(canvas: &Canvas, provenance: &str) -> String {
    let (provenance, content) = (escaped(provenance), content(canvas));
    let ((width, height), (w, h)) = (canvas.size, units(canvas));
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}pt" height="{height}pt" viewBox="0 0 {w} {h}">
<desc>{provenance}</desc>
{content}</svg>
"#
    )
}

/// The picture as an element of an HTML page, as wide as the page lets it be; `label` is read aloud in its place.
pub(super) fn inline(canvas: &Canvas, label: &str) -> String {
    let (label, content) = (escaped(label).replace('"', "&quot;"), content(canvas));
    let (w, h) = units(canvas);
    format!("<svg role=\"img\" aria-label=\"{label}\" viewBox=\"0 0 {w} {h}\">\n{content}</svg>\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn units(canvas: &Canvas) -> (u32, u32) {
    let (width, height) = canvas.size;
    ((width * UNITS) as u32, (height * UNITS) as u32)
}

/// Text above everything else.
fn content(canvas: &Canvas) -> String {
    let (mut shapes, mut glyphs) = (String::new(), String::new());
    for shape in &canvas.shapes {
        let out = match shape {
            Shape::Text(_) => &mut glyphs,
            _ => &mut shapes,
        };
        write(out, shape).expect("a string takes all that is written");
    }
    shapes + &glyphs
}

/// One element.
fn write(out: &mut String, shape: &Shape) -> fmt::Result {
    match shape {
        Shape::Line(points, width, colour) => {
            let (width, paint) = ((width * UNITS).round().max(1.0), paint("stroke", *colour));
            let points = list(points);
            writeln!(
                out,
                r#"<polyline fill="none" {paint} stroke-width="{width}" points="{points}"/>"#
            )
        }
        Shape::Area(points, colour) => {
            let (paint, points) = (paint("fill", *colour), list(points));
            writeln!(out, r#"<polygon {paint} points="{points}"/>"#)
        }
        Shape::Disc(centre, radius, colour) => {
            let ((x, y), r) = (rounded(*centre, UNITS), (radius * UNITS).round());
            let paint = paint("fill", *colour);
            writeln!(
                out,
                r#"<circle cx="{x}" cy="{y}" r="{r}" {paint} stroke="none" stroke-width="1"/>"#
            )
        }
        Shape::Text(text) => {
            let ((x, y), size) = (rounded(text.at, UNITS), text.height * UNITS);
            let place = if text.is_upright {
                format!(
                    "translate({:.0} {y}) rotate(-90)",
                    f64::from(x) + size / 2.0
                )
            } else {
                format!("translate({x} {:.0})", f64::from(y) + size / 2.0)
            };
            let path = outline(&text.text, size)?;
            writeln!(
                out,
                r##"<path transform="{place}" fill="#000000" d="{path}"/>"##
            )
        }
    }
}

/// A colour for `what` is painted.
fn paint(what: &str, colour: Colour) -> String {
    let (alpha, [red, green, blue]) = (colour.alpha, colour.rgb);
    format!(r##"opacity="{alpha}" {what}="#{red:02X}{green:02X}{blue:02X}""##)
}

fn list(points: &[(f64, f64)]) -> String {
    let points = points.iter().map(|point| rounded(*point, UNITS));
    points.map(|(x, y)| format!("{x},{y} ")).collect()
}

/// The path of a text whose baseline starts at the origin, `size` units from descender to ascender.
fn outline(text: &str, size: f64) -> Result<String, fmt::Error> {
    let font = font();
    let scale = size as f32 / font.height_unscaled();
    let mut path = String::new();
    let mut start = 0.0;
    for character in text.chars() {
        let glyph = font.glyph_id(character);
        let place = |point: &Point| (start + scale * point.x, -scale * point.y);
        let mut pen = None;
        for curve in font
            .outline(glyph)
            .into_iter()
            .flat_map(|outline| outline.curves)
        {
            let (from, controls, to) = match &curve {
                OutlineCurve::Line(from, to) => (from, vec![], to),
                OutlineCurve::Quad(from, control, to) => (from, vec![control], to),
                OutlineCurve::Cubic(from, first, second, to) => (from, vec![first, second], to),
            };
            if pen != Some(*from) {
                let (x, y) = place(from);
                write!(path, "M{x:.0} {y:.0}")?;
            }
            path.push(['L', 'Q', 'C'][controls.len()]);
            for point in controls.into_iter().chain([to]) {
                let (x, y) = place(point);
                write!(path, "{x:.0} {y:.0} ")?;
            }
            pen = Some(*to);
        }
        start += scale * font.h_advance_unscaled(glyph);
    }
    Ok(path)
}
