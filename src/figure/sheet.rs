//! The paper: a drawing area measured in points (1/72 inch) from its upper left corner.
//!
//! The raster is drawn three times too large and averaged down, because the drawing library's own
//! lines are jagged.

use super::look::Marker;
use super::text::{Align, FAMILY, FONT_HEIGHT, Style, register_embedded_font, runs, text_width};
use super::{Drawing, FigureError, svg};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Dots per inch of the PNG.
const DPI: u32 = 300;
/// Raster pixels that become one pixel of the PNG, in each direction.
const OVERSAMPLING: u32 = 3;
/// SVG units per point: coordinates are integers.
const SVG_UNITS: f64 = 20.0;
/// Something that can be drawn on a sheet.
pub(super) trait Picture {
    /// Width and height in points.
    fn size(&self) -> (f64, f64);

    /// Draws it.
    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError>;
}

/// A drawing area measured in points.
pub(super) struct Sheet<B: DrawingBackend> {
    paper: DrawingArea<B, Shift>,
    /// Backend units per point.
    unit: f64,
}

/// Draws `picture` in both its forms.
pub(super) fn render(picture: &impl Picture, provenance: &str) -> Result<Drawing, FigureError> {
    register_embedded_font();
    Ok(Drawing {
        png: png_of(picture, provenance)?,
        svg: svg_of(picture, provenance)?,
    })
}

fn png_of(picture: &impl Picture, provenance: &str) -> Result<Vec<u8>, FigureError> {
    let unit = f64::from(DPI * OVERSAMPLING) / 72.0;
    let pixels = |points: f64| (points * f64::from(DPI) / 72.0).round() as u32;
    let (width, height) = (pixels(picture.size().0), pixels(picture.size().1));
    let (fine_width, fine_height) = (width * OVERSAMPLING, height * OVERSAMPLING);
    let mut fine = vec![255; (fine_width * fine_height * 3) as usize];
    {
        let backend = BitMapBackend::with_buffer(&mut fine, (fine_width, fine_height));
        draw_on(backend, unit, picture)?;
    }
    let pixels = average_down(&fine, width, height);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let per_metre = (f64::from(DPI) / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.add_itxt_chunk("Source".to_owned(), provenance.to_owned())?;
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(bytes)
}

fn svg_of(picture: &impl Picture, provenance: &str) -> Result<Vec<u8>, FigureError> {
    let (width, height) = picture.size();
    let size = ((width * SVG_UNITS) as u32, (height * SVG_UNITS) as u32);
    let document = svg::document(size, picture.size(), provenance, |backend| {
        draw_on(backend, SVG_UNITS, picture)
    })?;
    Ok(document.into_bytes())
}

fn draw_on<B: DrawingBackend>(
    backend: B,
    unit: f64,
    picture: &impl Picture,
) -> Result<(), FigureError> {
    let paper = backend.into_drawing_area();
    let sheet = Sheet { paper, unit };
    picture.draw(&sheet)?;
    sheet.paper.present().map_err(refused)
}

/// The mean of each square of raster pixels, rounded.
fn average_down(fine: &[u8], width: u32, height: u32) -> Vec<u8> {
    let (step, row) = (OVERSAMPLING as usize, (width * OVERSAMPLING) as usize * 3);
    let cells = (step * step) as u32;
    let mut pixels = Vec::with_capacity((width * height * 3) as usize);
    for y in 0..height as usize {
        for x in 0..width as usize {
            for channel in 0..3 {
                let square = (0..step).flat_map(|dy| (0..step).map(move |dx| (dy, dx)));
                let sum: u32 = square
                    .map(|(dy, dx)| {
                        u32::from(fine[(y * step + dy) * row + (x * step + dx) * 3 + channel])
                    })
                    .sum();
                pixels.push(((sum + cells / 2) / cells) as u8);
            }
        }
    }
    pixels
}

/// The parts of a line through `points` that a `dash` leaves.
fn strokes(points: &[(f64, f64)], dash: &[f64]) -> Vec<Vec<(f64, f64)>> {
    let mut strokes = vec![points[..1].to_vec()];
    let (mut phase, mut left) = (0, dash[0]);
    for pair in points.windows(2) {
        let ((x, y), (dx, dy)) = (pair[0], (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1));
        let length = libm::hypot(dx, dy);
        let mut along = 0.0;
        while length - along > left {
            along += left;
            let turn = (x + dx * along / length, y + dy * along / length);
            match phase % 2 {
                0 => strokes[phase / 2].push(turn),
                _ => strokes.push(vec![turn]),
            }
            phase += 1;
            left = dash[phase % dash.len()];
        }
        left -= length - along;
        if phase % 2 == 0 {
            strokes[phase / 2].push(pair[1]);
        }
    }
    strokes
}

fn refused(error: impl std::error::Error) -> FigureError {
    FigureError::Drawing(error.to_string())
}

impl<B: DrawingBackend> Sheet<B> {
    fn at(&self, (x, y): (f64, f64)) -> (i32, i32) {
        (
            (x * self.unit).round() as i32,
            (y * self.unit).round() as i32,
        )
    }

    fn put<'b, E>(&'b self, element: &'b E) -> Result<(), FigureError>
    where
        &'b E: plotters::element::PointCollection<'b, (i32, i32)>,
        E: plotters::element::Drawable<B>,
    {
        self.paper.draw(element).map_err(refused)
    }

    /// A line through `points`.
    pub fn line(
        &self,
        points: &[(f64, f64)],
        width: f64,
        colour: RGBAColor,
    ) -> Result<(), FigureError> {
        let points: Vec<_> = points.iter().map(|&point| self.at(point)).collect();
        let width = (width * self.unit).round().max(1.0) as u32;
        self.put(&PathElement::new(points, colour.stroke_width(width)))
    }

    /// A line through `points`, its `dash` drawn and left out in turn.
    pub fn dashed(
        &self,
        points: &[(f64, f64)],
        width: f64,
        colour: RGBAColor,
        dash: &[f64],
    ) -> Result<(), FigureError> {
        if dash.is_empty() {
            return self.line(points, width, colour);
        }
        for stroke in strokes(points, dash) {
            self.line(&stroke, width, colour)?;
        }
        Ok(())
    }

    /// White paper of the given size.
    pub fn clear(&self, (width, height): (f64, f64)) -> Result<(), FigureError> {
        self.rectangle((0.0, 0.0), (width, height), WHITE.to_rgba())
    }

    /// A filled rectangle between two opposite corners.
    pub fn rectangle(
        &self,
        (left, top): (f64, f64),
        (right, bottom): (f64, f64),
        colour: RGBAColor,
    ) -> Result<(), FigureError> {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        self.area(&corners, colour)
    }

    /// The edge of a rectangle.
    pub fn outline(
        &self,
        (left, top): (f64, f64),
        (right, bottom): (f64, f64),
        width: f64,
        colour: RGBAColor,
    ) -> Result<(), FigureError> {
        let corners = [
            (left, top),
            (right, top),
            (right, bottom),
            (left, bottom),
            (left, top),
        ];
        self.line(&corners, width, colour)
    }

    /// A filled polygon.
    pub fn area(&self, points: &[(f64, f64)], colour: RGBAColor) -> Result<(), FigureError> {
        let points: Vec<_> = points.iter().map(|&point| self.at(point)).collect();
        self.put(&Polygon::new(points, colour.filled()))
    }

    /// A marker of the given half-width.
    pub fn marker(
        &self,
        kind: Marker,
        (x, y): (f64, f64),
        r: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let shape = |corners: &[(f64, f64)]| -> Vec<(f64, f64)> {
            corners
                .iter()
                .map(|&(dx, dy)| (x + r * dx, y + r * dy))
                .collect()
        };
        let fill = colour.to_rgba();
        match kind {
            Marker::Disc => {
                let radius = (r * self.unit).round() as i32;
                self.put(&Circle::new(self.at((x, y)), radius, fill.filled()))
            }
            Marker::Square => self.area(
                &shape(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
                fill,
            ),
            Marker::Triangle => self.area(&shape(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), fill),
            Marker::Wedge => self.area(&shape(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]), fill),
            Marker::Diamond => self.area(
                &shape(&[(0.0, -1.3), (1.1, 0.0), (0.0, 1.3), (-1.1, 0.0)]),
                fill,
            ),
            Marker::Cross => {
                self.line(&shape(&[(-1.0, -1.0), (1.0, 1.0)]), 0.4 * r, fill)?;
                self.line(&shape(&[(-1.0, 1.0), (1.0, -1.0)]), 0.4 * r, fill)
            }
        }
    }

    /// An arrow of so many points downwards, or upwards where they are negative.
    pub fn arrow(
        &self,
        (x, y): (f64, f64),
        length: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let (tip, half) = (y + length, 0.35 * length);
        let colour = colour.to_rgba();
        self.line(&[(x - half, y), (x + half, y)], 0.8, colour)?;
        self.line(&[(x, y), (x, tip - half)], 0.8, colour)?;
        self.area(
            &[(x, tip), (x - half, tip - half), (x + half, tip - half)],
            colour,
        )
    }

    /// Text whose baseline passes through `point`.
    pub fn text(&self, text: &str, point: (f64, f64), style: Style) -> Result<(), FigureError> {
        let width = text_width(text, style.size);
        let mut along = match style.align {
            Align::Left => 0.0,
            Align::Centre => -width / 2.0,
            Align::Right => -width,
        };
        for run in runs(text) {
            let size = style.size * run.scale() * FONT_HEIGHT;
            // The library draws a baseline half a size below the text's position.
            let across = if run.is_subscript {
                0.22 * style.size
            } else {
                0.0
            } - size / 2.0;
            let position = match style.upright {
                false => (point.0 + along, point.1 + across),
                true => (point.0 + across, point.1 - along),
            };
            let font = (FAMILY, size * self.unit).into_font();
            let font = match style.upright {
                false => font,
                true => font.transform(FontTransform::Rotate270),
            };
            let drawn = TextStyle::from(font).color(&style.colour);
            self.put(&Text::new(run.text.clone(), self.at(position), drawn))?;
            along += run.width(style.size);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Round a corner, 3 drawn and 2 left out.
    #[test]
    fn dashes_go_round_corners() {
        let line = [(0.0, 0.0), (6.0, 0.0), (6.0, 5.0)];
        let expected = [
            vec![(0.0, 0.0), (3.0, 0.0)],
            vec![(5.0, 0.0), (6.0, 0.0), (6.0, 2.0)],
            vec![(6.0, 4.0), (6.0, 5.0)],
        ];
        assert_eq!(strokes(&line, &[3.0, 2.0]), expected);
    }
}
