//! SVG whose text is outlines: no reader needs the font, and every reader sees the same.
//!
//! The drawing library writes `<text>`; the backend here catches each text on its way and writes
//! its glyphs as a path instead, above everything else.

use super::text::font;
use ab_glyph::{Font, OutlineCurve, Point};
use plotters::prelude::SVGBackend;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};
use std::cell::RefCell;
use std::fmt::Write;

/// An SVG backend that keeps text for later.
pub(super) struct Outlined<'a> {
    shapes: SVGBackend<'a>,
    glyphs: &'a RefCell<String>,
}

/// The document that `draw` makes on `size` units, shown `points` wide and high.
pub(super) fn document<E>(
    size: (u32, u32),
    points: (f64, f64),
    description: &str,
    draw: impl FnOnce(Outlined) -> Result<(), E>,
) -> Result<String, E> {
    let mut shapes = String::new();
    let glyphs = RefCell::new(String::new());
    draw(Outlined {
        shapes: SVGBackend::with_string(&mut shapes, size),
        glyphs: &glyphs,
    })?;
    let body = shapes.split_once('>').map_or("", |(_, body)| body);
    let body = body.trim_end().trim_end_matches("</svg>");
    let description = description.replace('&', "&amp;").replace('<', "&lt;");
    let ((width, height), (w, h)) = (points, size);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {w} {h}\">\n\
         <desc>{description}</desc>{body}{}</svg>\n",
        glyphs.into_inner()
    ))
}

/// The path of a text whose baseline starts at the origin, `size` units from descender to ascender.
fn outline(text: &str, size: f64) -> String {
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
                let _ = write!(path, "M{x:.0} {y:.0}");
            }
            path.push(['L', 'Q', 'C'][controls.len()]);
            for point in controls.into_iter().chain([to]) {
                let (x, y) = place(point);
                let _ = write!(path, "{x:.0} {y:.0} ");
            }
            pen = Some(*to);
        }
        start += scale * font.h_advance_unscaled(glyph);
    }
    path
}

impl DrawingBackend for Outlined<'_> {
    type ErrorType = std::io::Error;

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        let half = style.size() / 2.0;
        let placed = match style.transform() {
            FontTransform::Rotate270 => {
                format!("translate({:.0} {y}) rotate(-90)", f64::from(x) + half)
            }
            _ => format!("translate({x} {:.0})", f64::from(y) + half),
        };
        let (r, g, b) = style.color().rgb;
        let path = outline(text, style.size());
        let _ = writeln!(
            self.glyphs.borrow_mut(),
            "<path transform=\"{placed}\" fill=\"#{r:02x}{g:02x}{b:02x}\" d=\"{path}\"/>"
        );
        Ok(())
    }

    fn get_size(&self) -> (u32, u32) {
        self.shapes.get_size()
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.ensure_prepared()
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.present()
    }

    fn draw_pixel(
        &mut self,
        at: BackendCoord,
        colour: BackendColor,
    ) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.draw_pixel(at, colour)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.draw_path(path, style)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.fill_polygon(corners, style)
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<Self::ErrorType>> {
        self.shapes.draw_circle(centre, radius, style, fill)
    }
}
