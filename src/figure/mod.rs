//! How a [`Plot`] becomes a file: PNG, SVG with its text as outlines, PDF.
//!
//! `detection` and `track` are pictures of a recording; the picture of a study stands beside it.

#![allow(missing_docs, reason = "fields are called what they are")]

pub mod detection;
mod error;
pub mod quality;
mod raster;
mod record;
mod svg;
pub mod track;
pub mod vibration;

pub use error::FigureError;

use crate::plot::{Canvas, Format, Options, Plot, layout};
use std::path::Path;

/// Dots per inch of a PNG unless others are asked for.
pub const DPI: u32 = 300;

/// A picture in its files.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// By the names they have among results.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// What the reader of the picture must be told.
    pub notes: Vec<String>,
}

impl Drawing {
    /// The names that its files may have.
    pub const NAMES: [&'static str; 4] = ["figure.png", "figure.svg", "figure.pdf", OVERLAY];
}

/// The name among results of the curves of one's own that lie over a picture.
pub const OVERLAY: &str = "overlay.csv";

/// Draws a plot in the kinds that the options name; `provenance`, written into the files, says what made them.
///
/// # Errors
/// Where it does not fit on a sheet, or drawing fails.
pub fn render(
    plot: &Plot,
    provenance: &str,
    options: &Options,
) -> Result<Vec<(&'static str, Vec<u8>)>, FigureError> {
    let canvas = layout(plot)?;
    let dpi = options.dpi.map_or(DPI, |dpi| dpi.get() as u32);
    let formats = match &options.format[..] {
        [] => &[Format::Png, Format::Svg],
        formats => formats,
    };
    let file = |format: &Format| {
        let (name, kind) = match format {
            Format::Png => ("figure.png", Kind::Png(dpi)),
            Format::Svg => ("figure.svg", Kind::Svg),
            Format::Pdf => ("figure.pdf", Kind::Pdf),
        };
        Ok((name, drawn(&canvas, provenance, kind)?))
    };
    formats.iter().map(file).collect()
}

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// With so many dots per inch.
    Png(u32),
    Svg,
    Pdf,
}

impl Kind {
    /// What the end of a file's name says; a PNG has so many dots per inch.
    pub fn of(path: &Path, dpi: u32) -> Option<Self> {
        match path.extension()?.to_str()? {
            "png" => Some(Self::Png(dpi)),
            "svg" => Some(Self::Svg),
            "pdf" => Some(Self::Pdf),
            _ => None,
        }
    }
}

/// Draws a plot as a file of some kind.
///
/// # Errors
/// Where it does not fit on a sheet, or drawing fails.
pub fn file(plot: &Plot, provenance: &str, kind: Kind) -> Result<Vec<u8>, FigureError> {
    drawn(&layout(plot)?, provenance, kind)
}

fn drawn(canvas: &Canvas, provenance: &str, kind: Kind) -> Result<Vec<u8>, FigureError> {
    match kind {
        Kind::Png(dpi) => raster::png(canvas, provenance, dpi),
        Kind::Svg => Ok(svg::svg(canvas, provenance).into_bytes()),
        Kind::Pdf => pdf(&svg::svg(canvas, provenance)),
    }
}

fn pdf(svg: &str) -> Result<Vec<u8>, FigureError> {
    let drawing = |error: String| FigureError::Drawing(error);
    let reading = svg2pdf::usvg::Options::default();
    let tree = svg2pdf::usvg::Tree::from_str(svg, &reading);
    let tree = tree.map_err(|error| drawing(error.to_string()))?;
    // Points become pixels as they are read, at so many to the inch, and points again as they are written.
    let page = svg2pdf::PageOptions { dpi: reading.dpi };
    svg2pdf::to_pdf(&tree, svg2pdf::ConversionOptions::default(), page)
        .map_err(|error| drawing(error.to_string()))
}

/// Draws a plot as an element of an HTML page, as wide as the page lets it be; `label` is read aloud in its place.
///
/// # Errors
/// Where it does not fit on a sheet.
pub fn inline(plot: &Plot, label: &str) -> Result<String, FigureError> {
    Ok(svg::inline(&layout(plot)?, label))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Mark};

    /// A page is as large as the drawing, whatever else makes points of pixels.
    #[test]
    fn a_pdf_has_the_size_of_its_sheet() {
        let mut plot = Plot::stack(
            &Axis::linear(0.0, 1.0, 5),
            [(100.0, Axis::linear(0.0, 1.0, 5))],
        );
        plot.width = 250.0;
        plot.add_to_all(&Mark::Axes);
        let canvas = layout(&plot).unwrap();
        let bytes = file(&plot, "test", Kind::Pdf).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let (_, after) = text.split_once("/MediaBox [").unwrap();
        let (numbers, _) = after.split_once(']').unwrap();
        let numbers: Vec<f64> = numbers
            .split_whitespace()
            .map(|it| it.parse().unwrap())
            .collect();
        let size = [canvas.size.0, canvas.size.1];
        assert_eq!(numbers[..2], [0.0, 0.0]);
        assert!(
            numbers[2..]
                .iter()
                .zip(size)
                .all(|(page, sheet)| (page - sheet).abs() < 0.01),
            "{numbers:?} {size:?}"
        );
    }
}
