//! Pictures, each drawn once and written twice: PNG at 300 dpi and SVG.
//!
//! `sheet` is the paper: a drawing area measured in points, with lines, markers and text;
//! `text` measures the words on it, `look` tells curves apart.
//! `frame` puts axes on it. The other files each draw one kind of picture from results alone.

mod autocorrelation;
mod curves;
mod detection;
mod frame;
mod impulse_law;
mod independence;
mod layout;
mod legend;
mod look;
mod operating_point;
mod panel;
mod phases;
mod region;
mod ride;
mod ruler;
mod sheet;
mod svg;
mod text;
mod trace;
mod words;

use crate::config::{Config, ExhibitConfig};
use crate::detect::{Alternative, NullLawError, NullLaws, Region, Rule, Samples};
use crate::detection::Detection;
use crate::exhibit::Rows;
use crate::exhibit::region::boundary;
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
    /// A recording of not even one block.
    #[error("figure: too short to be drawn, without a single block (record a ride)")]
    Short,
    /// No rows, or rows that do not belong to the config.
    #[error("figure: the rows are not those of a [{0}] (compute it again with `liftsim sweep`)")]
    NoRows(&'static str),
    /// The law behind a picture does not fit in memory.
    #[error("figure: {0}")]
    Law(#[from] NullLawError),
}

/// Draws a sweep: power, or false-alarm rate where nothing moves, against the axis.
///
/// # Errors
/// Where the results have no point on the config's axis, or drawing fails.
pub fn sweep(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Drawing, FigureError> {
    let picture = curves::Curves::new(config, rows, manifest)?;
    sheet::render(&picture, &provenance(manifest))
}

/// Draws an experiment that is no sweep, from its rows.
///
/// # Errors
/// Where the rows are not those of the config's kind, or drawing fails.
pub fn exhibit(
    config: &ExhibitConfig,
    rows: &Rows,
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    use crate::config::ExhibitKind as Kind;
    let from = provenance(manifest);
    match (&config.kind, rows) {
        _ if rows.is_empty() => Err(FigureError::NoRows(config.kind.name())),
        (Kind::Autocorrelation { length, .. }, Rows::Autocorrelation(rows)) => {
            let picture = autocorrelation::Lags::new(config, *length, rows, manifest);
            sheet::render(&picture, &from)
        }
        (Kind::Trace(trace), Rows::Trace(rows)) => {
            let picture = trace::Ride::new(config, trace, rows, manifest);
            sheet::render(&picture, &from)
        }
        (_, Rows::Layout(rows)) => sheet::render(&layout::Layout::new(config, rows), &from),
        (_, Rows::Region(rows)) => {
            let scenario = &config.scenario;
            let laws = NullLaws::new(scenario.detector.alternative, &scenario.samples)?;
            let title = region_title(
                &scenario.samples,
                scenario.detector.alternative,
                scenario.detector.alpha,
            );
            sheet::render(&region::Plane::new(&laws, rows, title), &from)
        }
        (_, Rows::Independence(rows)) => sheet::render(&independence::Diagonal::new(rows), &from),
        (_, Rows::OperatingPoint(rows)) => sheet::render(
            &operating_point::Points::new(config, rows, manifest),
            &provenance(manifest),
        ),
        (Kind::Ride(study), Rows::Ride(rows)) => {
            sheet::render(&ride::Rides::new(study, rows, manifest), &from)
        }
        (_, Rows::ImpulseLaw(rows)) => sheet::render(
            &impulse_law::Laws::new(rows, manifest, config.confidence),
            &from,
        ),
        _ => Err(FigureError::NoRows(config.kind.name())),
    }
}

/// Draws a recording, whose name is `name`, and what was found in it.
///
/// # Errors
/// Where the recording has not even one block, or drawing fails.
pub fn detection(detection: &Detection, name: &str) -> Result<Drawing, FigureError> {
    let picture = detection::Found::new(detection, name)?;
    let version = env!("CARGO_PKG_VERSION");
    sheet::render(&picture, &format!("liftsim {version}, recording {name}"))
}

/// Draws the plane of W and T: the null probability of every cell, and the boundary of a region in it.
/// `title` is in parts, between which a line may break.
///
/// # Errors
/// Where drawing fails.
pub fn region(
    laws: &NullLaws,
    rule: &Rule,
    region: &Region,
    title: Vec<String>,
) -> Result<Drawing, FigureError> {
    let rows = boundary(rule, region);
    let version = env!("CARGO_PKG_VERSION");
    let provenance = format!("liftsim {version}, rule {rule}, {}", title.join("; "));
    sheet::render(&region::Plane::new(laws, &rows, title), &provenance)
}

/// What the title of a plane of W and T says of regions at these sizes and this level.
pub fn region_title(samples: &Samples, alternative: Alternative, alpha: f64) -> Vec<String> {
    region::title(samples, alternative, alpha)
}

/// What made a picture, for whoever finds it alone.
fn provenance(manifest: &Manifest) -> String {
    format!(
        "liftsim {}, config {} ({}), seed {}, {} trials per point",
        manifest.version,
        manifest.config_name,
        manifest.short_hash(),
        manifest.seed,
        manifest.trials
    )
}
