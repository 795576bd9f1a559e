//! Why rides were refused.

use super::Measure;
use crate::monitor::SettingsError;
use crate::signal::{
    DigitiserError, DisturbanceError, ImpulsesError, PickupError, RideError, SensorError, TripError,
};

/// Why rides were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RideProblem {
    /// A key that this measurement has no use for.
    #[error("{key} means nothing to measure = \"{}\" (take it out)", measure.name())]
    Unheeded {
        /// As written.
        key: &'static str,
        /// What is measured.
        measure: Measure,
    },
    /// A value that is no number.
    #[error("axis.{0}: must be numbers (a picture has them on its axis)")]
    NoNumber(&'static str),
    /// The noise said to be of several strengths.
    #[error("sigma, density and delta_over_sigma all say how strong the noise is (leave one)")]
    Strength,
    /// A number that is not above zero.
    #[error("{key} must be positive, got {value}")]
    NotPositive {
        /// Which.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// Rests from long to short.
    #[error("rest must be two lengths in s, [shortest, longest], got [{0}, {1}]")]
    Rests(f64, f64),
    /// No trip, or too many.
    #[error("trips must lie in 1 to {most}, got {0}", most = super::MOST_TRIPS)]
    Trips(usize),
    /// Uniform motion where there is none.
    #[error("a trip of {0} m never moves uniformly (lengthen distance, or lower speed)")]
    NeverUniform(f64),
    /// A trip that cannot be made.
    #[error(transparent)]
    Trip(#[from] TripError),
    /// A ride that cannot be made.
    #[error(transparent)]
    Ride(#[from] RideError),
    /// A sensor that cannot be.
    #[error("ar: {0}")]
    Sensor(#[from] SensorError),
    /// Impulses that cannot be.
    #[error(transparent)]
    Impulses(#[from] ImpulsesError),
    /// A converter that cannot be.
    #[error(transparent)]
    Digitiser(#[from] DigitiserError),
    /// Footfalls that cannot be.
    #[error(transparent)]
    Disturbance(#[from] DisturbanceError),
    /// A pickup that cannot be.
    #[error(transparent)]
    Pickup(#[from] PickupError),
    /// Settings that cannot be.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}
