//! The whole chain of one trial: noise → record → whitened samples → W, T → decision.
//!
//! A [`Scenario`] says what one point simulates and decides. A [`Family`] holds all points that can
//! share a noise realisation and takes them through a trial together: the noise is drawn once, each
//! filter is fitted once, and because whitening is linear the whitened sample is
//!
//! noise + Δ · (step response) + θ · (impulse response),
//!
//! a line in Δ: W and T at every Δ follow from where such lines cross, for little more than at one. A
//! digitised record is not linear in Δ; it is written and whitened anew for each.
//!
//! Noise is drawn, coloured and whitened for several trials side by side, which is what a processor's
//! vectors are for; from there on each trial goes its own way.

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
pub use observation::{Observation, View};
pub use replay::Replay;
pub use score::Score;
pub use source::RecordTooLong;
pub use trial::Trial;
