//! How far a trip went, and how well that is known.

use super::filter::Uncertain;
use super::settings::TrackSettings;
use crate::kalman::Innovation;

/// How far a trip went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Travelled {
    /// m, up positive.
    pub distance: Uncertain,
    /// The speed that is left where the cage stands, m/s, up positive; none if the trip is not seen to end.
    pub closing_speed: Option<f64>,
    /// What is added to its deviation because that is too much for the noise, m.
    pub widened: f64,
}

impl Travelled {
    /// A trip of so many seconds that ends with this innovation of its speed.
    ///
    /// Where that is too much for the noise, something else was wrong for a part of the trip: a gain, a tilt. The filter
    /// takes it off as if it had grown all the time. If it began at any moment alike, an error of the deviation |s| T/√12
    /// is left.
    pub(super) fn closing(closing: Innovation, seconds: f64, settings: &TrackSettings) -> Self {
        let speed = -closing.value;
        let is_noise = closing.nis() <= settings.gate;
        let widened = if is_noise {
            0.0
        } else {
            speed.abs() * seconds / 12f64.sqrt()
        };
        Self {
            distance: Uncertain::error(widened),
            closing_speed: Some(speed),
            widened,
        }
    }

    /// With a distance or an error added.
    pub(super) fn plus(self, distance: Uncertain) -> Self {
        Self {
            distance: self.distance.plus(distance),
            ..self
        }
    }
}
