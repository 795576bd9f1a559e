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

use crate::chain::Scenario;
use crate::config::{Config, RideStudy, Trace};
use crate::detect::{Alternative, NullLawError, NullLaws, Region, Rule, Samples};
use crate::detection::Detection;
use crate::results::{Manifest, Row};
use crate::study::rows::{self, boundary};

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

/// Draws an autocorrelation of records of `length` samples.
///
/// # Errors
/// Where drawing fails; so with every picture here.
pub fn autocorrelation(
    scenario: &Scenario,
    confidence: f64,
    length: usize,
    rows: &[rows::Autocorrelation],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    let picture = autocorrelation::Lags::new(scenario, confidence, length, rows, manifest);
    sheet::render(&picture, &provenance(manifest))
}

/// Draws one realisation of a ride.
///
/// # Errors
/// Where drawing fails.
pub fn trace(
    scenario: &Scenario,
    trace: &Trace,
    rows: &[rows::Trace],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    let picture = trace::Ride::new(scenario, trace, rows, manifest);
    sheet::render(&picture, &provenance(manifest))
}

/// Draws where the samples of a trial lie.
///
/// # Errors
/// Where drawing fails.
pub fn layout(
    scenario: &Scenario,
    rows: &[rows::Layout],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    sheet::render(&layout::Layout::new(scenario, rows), &provenance(manifest))
}

/// Draws the plane of W and T with the boundaries of several rules.
///
/// # Errors
/// Where drawing fails, or the laws do not fit in memory.
pub fn regions(
    scenario: &Scenario,
    rows: &[rows::Region],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    let Scenario {
        samples, detector, ..
    } = scenario;
    let laws = NullLaws::new(detector.alternative, samples)?;
    let title = region_title(samples, detector.alternative, detector.alpha);
    let picture = region::Plane::new(&laws, rows, title);
    sheet::render(&picture, &provenance(manifest))
}

/// Draws joint probabilities against products.
///
/// # Errors
/// Where drawing fails.
pub fn independence(
    rows: &[rows::Independence],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    sheet::render(&independence::Diagonal::new(rows), &provenance(manifest))
}

/// Draws the operating point against the size.
///
/// # Errors
/// Where drawing fails.
pub fn operating_point(
    scenario: &Scenario,
    rows: &[rows::OperatingPoint],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    let picture = operating_point::Points::new(scenario, rows, manifest);
    sheet::render(&picture, &provenance(manifest))
}

/// Draws the outcomes of rides.
///
/// # Errors
/// Where drawing fails.
pub fn rides(
    study: &RideStudy,
    rows: &[rows::Ride],
    manifest: &Manifest,
) -> Result<Drawing, FigureError> {
    let picture = ride::Rides::new(study, rows, manifest);
    sheet::render(&picture, &provenance(manifest))
}

/// Draws the laws of impulses.
///
/// # Errors
/// Where drawing fails.
pub fn impulse_law(
    rows: &[rows::ImpulseLaw],
    manifest: &Manifest,
    confidence: f64,
) -> Result<Drawing, FigureError> {
    let picture = impulse_law::Laws::new(rows, manifest, confidence);
    sheet::render(&picture, &provenance(manifest))
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
        manifest.origin.version,
        manifest.origin.config_name,
        manifest.short_hash(),
        manifest.origin.seed,
        manifest.origin.trials
    )
}
