//! The whole chain of one trial: noise → record → whitened samples → W, T → decision.
//!
//! A [`Scenario`] says what one point simulates and decides. A [`Family`] holds all points that can
//! share a noise realisation and takes them through a trial together: the noise is drawn once, each
//! filter is fitted once, and because whitening is linear the whitened sample is
//!
//! noise + Δ · (step response) + θ · (impulse response),
//!
//! a line in Δ. W and T at every Δ follow from the crossings of such lines, at little more than the cost of a
//! single Δ. A digitised record is not linear in Δ, so it is computed and whitened again for each value.
//!
//! Noise is drawn, coloured and whitened for several trials side by side in vector instructions; from there
//! on each trial is processed by itself.

mod batch;
mod decision;
mod family;
mod keys;
mod motion;
mod observation;
mod replay;
mod score;
mod source;
#[cfg(test)]
mod tests;
mod trial;

pub use crate::scenario::{Calibration, Detector, Scenario};
pub use decision::Decision;
pub use family::{Family, Purpose};
pub use observation::{Observation, Track, View};
pub use replay::Replay;
pub use score::Score;
pub use source::RecordTooLong;
pub use trial::Trial;
