//! How a [`Plot`] becomes PNG at 300 dpi and SVG.
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

use crate::plot::{Canvas, Plot, layout};
use std::path::Path;

/// Dots per inch of a PNG unless others are asked for.
pub const DPI: u32 = 300;

/// A picture in both its forms.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// At 300 dpi, its provenance in text chunks.
    pub png: Vec<u8>,
    /// With its text as outlines, so that it looks the same without the font.
    pub svg: Vec<u8>,
}

/// Draws a plot; `provenance`, written into both files, says what made them.
///
/// # Errors
/// Where it does not fit on a sheet, or drawing fails.
pub fn render(plot: &Plot, provenance: &str) -> Result<Drawing, FigureError> {
    let canvas = layout(plot)?;
    Ok(Drawing {
        png: drawn(&canvas, provenance, Kind::Png(DPI))?,
        svg: drawn(&canvas, provenance, Kind::Svg)?,
    })
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
    let tree = svg2pdf::usvg::Tree::from_str(svg, &svg2pdf::usvg::Options::default());
    let tree = tree.map_err(|error| drawing(error.to_string()))?;
    let options = svg2pdf::PageOptions::default();
    svg2pdf::to_pdf(&tree, svg2pdf::ConversionOptions::default(), options)
        .map_err(|error| drawing(error.to_string()))
}

/// Draws a plot as an element of an HTML page, as wide as the page lets it be; `label` is read aloud in its place.
///
/// # Errors
/// Where it does not fit on a sheet.
pub fn inline(plot: &Plot, label: &str) -> Result<String, FigureError> {
    Ok(svg::inline(&layout(plot)?, label))
}

impl Drawing {
    /// Both forms by the names they have among results.
    pub fn files(&self) -> [(&'static str, &[u8]); 2] {
        [("figure.png", &self.png), ("figure.svg", &self.svg)]
    }
}
