//! The whole chain of one trial: noise → record → whitened samples → W, T → decision.
//!
//! A [`Scenario`] says what one point simulates and decides. A [`Family`] holds all points that can
//! share a noise realisation and takes them through a trial together: the noise is drawn once, each
//! filter is fitted once, and because whitening is linear the whitened sample is
//!
//! noise + Δ · (step response) + θ · (impulse response),
//!
//! so that a further Δ costs one multiplication a sample. A digitised record is not linear in Δ; it
//! is written and whitened anew for each.

mod family;
mod observation;
mod scenario;
#[cfg(test)]
mod tests;
mod trial;

pub use family::{Family, Purpose, RecordTooLong};
pub use observation::{Decision, Observation, Score};
pub use scenario::{Calibration, Detector, Scenario};
pub use trial::Trial;
