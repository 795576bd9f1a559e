//! How high a trip went by a barometer.

use serde::Serialize;

/// The columns that a trip gains by a barometer.
pub(super) const CLIMB: [&str; 3] = ["height", "height_deviation", "height_printed"];

/// How high a trip went by the barometer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Climb {
    /// m, up positive.
    pub height: f64,
    /// Its standard deviation, m, with that of the air's temperature.
    pub height_deviation: f64,
    /// In the standard atmosphere, m: eq. (5).
    pub height_printed: f64,
}
