//! The model of a sensor in the cage.
//!
//! r = bias + w + a cos φ + c cos ψ + σ(x + d + v + λ): φ is the angle between its axis and the vertical, ψ that to
//! the way of the doors, along which they knock with c; w is a random walk of the bias, x the noise of the
//! sensor, d a disturbance at rest and in motion alike, v vibration and λ impulses, both only in motion; then
//! the digitiser. An error of the gain is in the cosines. σ is the standard deviation of the noise that drives the sensor, in m/s²: the unit of
//! everything else in [`crate::signal`].
//!
//! The standard deviation of σx is gσ with g² = Σ h_k², the energy of the sensor's impulse response; g = 1 for
//! white noise. In uniform motion at the drive's full speed it is √(g² + v²) σ.

use crate::signal::{Digitiser, Disturbance, Impulses, Noise, Sensor};

/// A sensor in the cage.
#[derive(Clone, Debug, PartialEq)]
pub struct Pickup {
    /// σ, m/s².
    pub sigma: f64,
    /// The sensor, which colours the noise.
    pub sensor: Sensor,
    /// The law of the noise that drives the sensor.
    pub noise: Noise,
    /// Step and limits, in σ.
    pub digitiser: Digitiser,
    /// The reading at zero acceleration, m/s²; it may include gravity.
    pub bias: f64,
    /// cos φ: 1 for a vertical axis, 0 for a horizontal one.
    pub cosine: f64,
    /// cos ψ.
    pub across: f64,
    /// Deviation of the bias's random walk after a second, m/s².
    pub walk: f64,
    /// Standard deviation, in σ, of the white normal noise added at the drive's full speed. At lower speeds it is
    /// proportional to the speed, because a cage that starts is still quiet.
    pub vibration: f64,
    /// λ, θ in σ; every trip starts from S = 0.
    pub impulses: Impulses,
    /// d, in σ and samples.
    pub disturbance: Disturbance,
}

/// Why a pickup was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PickupError {
    /// σ out of range.
    #[error("sigma must lie in [1e-12, 1e12] m/s², got {0}")]
    Sigma(f64),
    /// A bias out of range.
    #[error("bias must lie in [-1e12, 1e12] m/s², got {0}")]
    Bias(f64),
    /// A cosine outside [−1, 1].
    #[error("cosine must lie in [-1, 1], got {0}")]
    Cosine(f64),
    /// A standard deviation out of range.
    #[error("vibration must lie in [0, 1e6] sigma, got {0}")]
    Vibration(f64),
}

impl Pickup {
    /// White normal noise of standard deviation `sigma` m/s² without a digitiser, as a base for struct updates.
    pub fn white(sigma: f64) -> Self {
        Self {
            sigma,
            sensor: Sensor::from_ar(Vec::new()).expect("white noise is stable"),
            noise: Noise::default(),
            digitiser: Digitiser::default(),
            bias: 0.0,
            cosine: 1.0,
            across: 0.0,
            walk: 0.0,
            vibration: 0.0,
            impulses: Impulses::none(),
            disturbance: Disturbance::default(),
        }
    }

    /// Checks the numbers of a pickup.
    ///
    /// # Errors
    /// If a number is out of its range.
    pub fn checked(self) -> Result<Self, PickupError> {
        if !(1e-12..=1e12).contains(&self.sigma) {
            return Err(PickupError::Sigma(self.sigma));
        }
        if !(-1e12..=1e12).contains(&self.bias) {
            return Err(PickupError::Bias(self.bias));
        }
        if !(-1.0..=1.0).contains(&self.cosine) {
            return Err(PickupError::Cosine(self.cosine));
        }
        if !(0.0..=1e6).contains(&self.vibration) {
            return Err(PickupError::Vibration(self.vibration));
        }
        Ok(self)
    }
}
