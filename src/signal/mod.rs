//! What an accelerometer in a cage would write down: r = x + Δ + λ, eqs (1)–(8) of [^1].
//!
//! Everything is in units of σ_ξ, the deviation of the white noise that drives the sensor; but for
//! [`recording`], which reads what accelerometers in real cages did write down, in m/s².
//!
//! [^1]: M. A. Raifeld, "Distinguishing the motion/stop states of a lift from accelerometer
//! signals", Avtometriya (in Russian), received 25 November 2013.

mod digitiser;
mod disturbance;
mod gaussian;
mod impulses;
mod motion;
mod noise;
pub mod recording;
mod sensor;

pub use digitiser::{Digitiser, DigitiserError};
pub use disturbance::{Disturbance, DisturbanceError};
pub use impulses::{During, ImpulseMemory, Impulses, ImpulsesError};
pub use motion::{DeltaAt, Motion, MotionError, Profile};
pub use noise::{Law, LawError, Noise};
pub use sensor::{Sensor, SensorError, Transfer};
