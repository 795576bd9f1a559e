//! PNG. It is drawn three times too large and averaged down, because the drawing library's own
//! lines are jagged.

use super::error::FigureError;
use crate::plot::{Canvas, Colour, Shape, rounded};
use plotters::backend::DrawingBackend;
use plotters::prelude::{
    BitMapBackend, Color, FontStyle, FontTransform, IntoFont, RGBAColor, TextStyle,
};
use plotters::style::register_font;
use std::sync::OnceLock;

/// Raster pixels that become one pixel, in each direction.
const OVERSAMPLING: u32 = 3;
/// What the drawing library calls the embedded font.
const FAMILY: &str = "sans-serif";

/// The picture, where it comes from in its text chunk.
pub(super) fn png(canvas: &Canvas, provenance: &str, dpi: u32) -> Result<Vec<u8>, FigureError> {
    register_embedded_font();
    let pixels = |points: f64| (points * f64::from(dpi) / 72.0).round() as u32;
    let (width, height) = (pixels(canvas.size.0), pixels(canvas.size.1));
    let (fine_width, fine_height) = (width * OVERSAMPLING, height * OVERSAMPLING);
    let mut fine = vec![255; fine_width as usize * fine_height as usize * 3];
    let mut backend = BitMapBackend::with_buffer(&mut fine, (fine_width, fine_height));
    for shape in &canvas.shapes {
        draw(&mut backend, shape, dpi)?;
    }
    drop(backend);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let per_metre = (f64::from(dpi) / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.add_itxt_chunk("Source".to_owned(), provenance.to_owned())?;
    let pixels = average_down(&fine, width as usize, height as usize);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(bytes)
}

fn draw(backend: &mut BitMapBackend, shape: &Shape, dpi: u32) -> Result<(), FigureError> {
    let unit = f64::from(dpi * OVERSAMPLING) / 72.0;
    let at = |point: &(f64, f64)| rounded(*point, unit);
    match shape {
        Shape::Line(points, width, colour) => {
            let width = (width * unit).round().max(1.0) as u32;
            backend.draw_path(points.iter().map(at), &rgba(*colour).stroke_width(width))
        }
        Shape::Area(points, colour) => backend.fill_polygon(points.iter().map(at), &rgba(*colour)),
        Shape::Disc(centre, radius, colour) => {
            let radius = (radius * unit).round() as u32;
            backend.draw_circle(at(centre), radius, &rgba(*colour), true)
        }
        Shape::Text(text) => {
            let mut font = (FAMILY, text.height * unit).into_font();
            if text.is_upright {
                font = font.transform(FontTransform::Rotate270);
            }
            backend.draw_text(&text.text, &TextStyle::from(font), at(&text.at))
        }
    }
    .map_err(|error| FigureError::Drawing(error.to_string()))
}

fn rgba(colour: Colour) -> RGBAColor {
    let [red, green, blue] = colour.rgb;
    RGBAColor(red, green, blue, colour.alpha)
}

fn register_embedded_font() {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        let registered = register_font(FAMILY, FontStyle::Normal, dejavu::sans::regular());
        assert!(registered.is_ok(), "the embedded font is a font");
    });
}

/// The mean of each square of raster pixels, rounded.
fn average_down(fine: &[u8], width: usize, height: usize) -> Vec<u8> {
    let step = OVERSAMPLING as usize;
    let (row, cells) = (width * step * 3, (step * step) as u32);
    let mut pixels = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let first = y * step * row + x * step * 3 + channel;
                let square = (0..step).flat_map(|dy| (0..step).map(move |dx| dy * row + dx * 3));
                let sum: u32 = square.map(|cell| u32::from(fine[first + cell])).sum();
                pixels.push(((sum + cells / 2) / cells) as u8);
            }
        }
    }
    pixels
}
