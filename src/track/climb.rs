//! How high a trip went by a barometer, and where the car stands after it.

use serde::Serialize;

/// The columns that a trip gains by a barometer.
pub(super) const CLIMB: [&str; 5] = [
    "height",
    "height_deviation",
    "height_printed",
    "position",
    "position_deviation",
];

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

/// Where the car stands after a trip, by its trips and the barometer together ([`super::fusion::stays`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// m above where it stood first.
    pub position: f64,
    /// Its standard deviation, m.
    pub position_deviation: f64,
}
