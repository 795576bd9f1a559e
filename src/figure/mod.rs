//! Pictures, each drawn once and written twice: PNG at 300 dpi and SVG.
//!
//! `sheet` is the paper: a drawing area measured in points, with lines, markers and text.
//! `frame` puts axes on it. The other files each draw one kind of picture from results alone.

mod curves;
mod frame;
mod legend;
mod panel;
mod region;
mod ruler;
mod sheet;
mod svg;
mod words;

use crate::config::Config;
use crate::detect::{NullLaws, Region};
use crate::results::{Manifest, Row};

/// A picture in both its forms.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// At 300 dpi, its provenance in text chunks.
    pub png: Vec<u8>,
    /// With its text as outlines, so that it looks the same without the font.
    pub svg: Vec<u8>,
}

impl Drawing {
    /// Both forms by the names they have among results.
    pub fn files(&self) -> [(&'static str, &[u8]); 2] {
        [("figure.png", &self.png), ("figure.svg", &self.svg)]
    }
}

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The drawing library refused, in its words.
    #[error("figure: {0}")]
    Drawing(String),
    /// The picture could not be compressed.
    #[error("figure: {0}")]
    Png(#[from] png::EncodingError),
    /// There is nothing to draw.
    #[error(
        "figure: no point of the results lies on the axis {0} (draw it from a sweep's results)"
    )]
    Empty(&'static str),
}

/// Draws a sweep: power, or false-alarm rate where nothing moves, against the axis.
///
/// # Errors
/// Where the results have no point on the config's axis, or drawing fails.
pub fn sweep(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Drawing, FigureError> {
    let provenance = format!(
        "liftsim {}, config {} ({}), seed {}, {} trials per point",
        manifest.version,
        manifest.config_name,
        manifest.short_hash(),
        manifest.seed,
        manifest.trials
    );
    sheet::render(&curves::Curves::new(config, rows, manifest)?, &provenance)
}

/// Draws the plane of W and T: the null probability of every cell, and the region in it. `title` is in
/// parts, between which a line may break.
///
/// # Errors
/// Where drawing fails.
pub fn region(laws: &NullLaws, region: &Region, title: &[String]) -> Result<Drawing, FigureError> {
    let provenance = format!(
        "liftsim {}, {}",
        env!("CARGO_PKG_VERSION"),
        title.join("; ")
    );
    sheet::render(&region::Plane::new(laws, region, title), &provenance)
}
