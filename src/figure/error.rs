//! Why a picture could not be drawn.

use crate::plot::{LayoutError, OptionsError};

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    #[error(transparent)]
    Layout(#[from] LayoutError),
    #[error(transparent)]
    Options(#[from] OptionsError),
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
    #[error(
        "figure: no ride has both its energies and a distance (record a whole ride, with rest before and after it)"
    )]
    NoPosition,
    #[error("figure: the rows are not those of a [{0}] (compute it again with `liftsim sweep`)")]
    NoRows(&'static str),
    #[error("figure: {0}")]
    Law(#[from] crate::detect::NullLawError),
}
