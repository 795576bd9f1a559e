//! The record of an accelerometer in a cage: r = x + Δ + λ, eqs (1)–(8) of [^1].
//!
//! The unit is σ_ξ, the standard deviation of the white noise that drives the sensor.
//!
//! [^1]: M. A. Raifeld, "Distinguishing the motion/stop states of a lift from accelerometer
//! signals", Avtometriya (in Russian), received 25 November 2013.

mod autoregression;
mod bits;
mod digitiser;
mod disturbance;
mod gaussian;
mod impulses;
mod motion;
mod noise;
mod phase;
mod sensor;

pub(crate) use autoregression::step_down;
pub(crate) use bits::fill_bytes;
pub use digitiser::{Digitiser, Quantum};
pub use disturbance::{Disturbance, Jolt};
pub use impulses::{During, ImpulseMemory, Impulses};
pub use motion::{DeltaAt, Motion, MotionError, Profile};
pub use noise::{Law, LawError, Noise, white_noise};
pub use phase::Phase;
pub use sensor::{Choice as SensorChoice, Sensor, SensorError, Transfer};
