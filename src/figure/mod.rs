//! Pictures: what each says ([`Plot`]), from rows and a few plain facts, and how a plot becomes PNG at
//! 300 dpi and SVG.
//!
//! `detection` is the picture of a recording; the picture of a study stands beside it.

#![allow(missing_docs, reason = "fields are called what they are")]

pub mod detection;
pub mod phases;
mod raster;
pub mod rates;
mod svg;

use crate::plot::{LayoutError, Plot, layout};

/// A picture in both its forms.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// At 300 dpi, its provenance in text chunks.
    pub png: Vec<u8>,
    /// With its text as outlines, so that it looks the same without the font.
    pub svg: Vec<u8>,
}

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// In the words of the drawing library.
    #[error("figure: {0}")]
    Drawing(String),
    #[error("figure: {0}")]
    Png(#[from] png::EncodingError),
    #[error(
        "figure: no point of the results lies on the axis {0} (draw it from a sweep's results)"
    )]
    Empty(&'static str),
    #[error("figure: too short to be drawn, without a single block (record a ride)")]
    Short,
    #[error("figure: the rows are not those of a [{0}] (compute it again with `liftsim sweep`)")]
    NoRows(&'static str),
    #[error("figure: {0}")]
    Law(#[from] crate::detect::NullLawError),
}

/// Draws a plot; `provenance` says what made it to whoever finds it alone.
///
/// # Errors
/// Where it does not fit on a sheet, or drawing fails.
pub fn render(plot: &Plot, provenance: &str) -> Result<Drawing, FigureError> {
    let canvas = layout(plot)?;
    Ok(Drawing {
        png: raster::png(&canvas, provenance)?,
        svg: svg::svg(&canvas, provenance).into_bytes(),
    })
}

impl Drawing {
    /// Both forms by the names they have among results.
    pub fn files(&self) -> [(&'static str, &[u8]); 2] {
        [("figure.png", &self.png), ("figure.svg", &self.svg)]
    }
}

/// A place on a canvas in whole units, so many per point.
fn rounded((x, y): (f64, f64), unit: f64) -> (i32, i32) {
    ((x * unit).round() as i32, (y * unit).round() as i32)
}
