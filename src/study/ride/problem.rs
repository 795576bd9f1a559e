//! Why rides were refused.

use crate::config::Refusal;
use crate::lift::{PickupError, RideError, TripError};
use crate::monitor::SettingsError;
use crate::rule::OutOfRange;
use crate::signal::SensorError;

/// Why rides were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum RideProblem {
    #[error(transparent)]
    Read(#[from] Refusal),
    #[error(
        "ride: sigma, density and delta_over_sigma all say how strong the noise is (leave one)"
    )]
    Strength,
    #[error(transparent)]
    Value(#[from] OutOfRange),
    #[error("ride: a trip of {0} m never moves uniformly (lengthen distance, or lower speed)")]
    NeverUniform(f64),
    #[error("ride: {0}")]
    Trip(#[from] TripError),
    #[error("ride: {0}")]
    Ride(#[from] RideError),
    #[error("ride.ar: {0}")]
    Sensor(#[from] SensorError),
    #[error("ride: {0}")]
    Pickup(#[from] PickupError),
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

impl RideProblem {
    /// The key to change, where it is one.
    pub(super) fn key(&self) -> Option<&str> {
        Some(match self {
            Self::Value(OutOfRange { key, .. }) => last_word(key),
            Self::Settings(error) => last_word(error.key()),
            Self::Strength => "sigma",
            Self::Sensor(_) => "ar",
            Self::Trip(TripError::NotPositive { name, .. }) => name,
            Self::Trip(_) => "distance",
            Self::Ride(RideError::Rate(_)) => "rate",
            Self::Pickup(PickupError::Vibration(_)) => "vibration",
            Self::Pickup(_) => "sigma",
            _ => return None,
        })
    }
}

fn last_word(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}
