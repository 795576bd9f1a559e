//! A sequential detector whose false-alarm rate is exact for any noise: CUSUMs of scores of sequential ranks.
//!
//! ```text
//! block x_t → rank among all since the reference began → U_t → score(U_t) → S ← max(0, S + score − k) → alarm at S ≥ h
//! ```
//!
//! At rest the U_t are independent and uniform, whatever law the blocks have ([`Ranks`] has the theorem). So the time to a
//! false alarm has one law, for every noise and every length of the reference, and with scores on a [`Lattice`] it is that
//! of a finite Markov chain ([`RunLength`]). After an alarm everything starts again with a new reference of N blocks.
//! McDonald [^1] has the CUSUM of sequential ranks.
//!
//! # Assumed
//! Blocks at rest are exchangeable: independent and of one law, or as good as that. Colour is not allowed for. Blocks must
//! be long beside the memory of the noise, or whitened. What moves the level slowly at rest is a shift as any other.
//!
//! ```
//! use liftsim::detect::sequential::{Chart, Score, Side, units};
//!
//! let chart = Chart::new(Score::Normal, &[Side::Up, Side::Down], 0.8, 60)?;
//! let h = chart.threshold(10_000.0)?;
//! assert!(chart.run_length(h).promised() >= 10_000.0);
//! assert!(units(h) < 5.5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [^1]: D. McDonald, "A CUSUM procedure based on sequential ranks", Naval Research Logistics 37, 1990.

mod chain;
mod change;
mod chart;
mod cusum;
mod detector;
mod powers;
mod promise;
mod ranks;
mod rate;
mod reach;
mod run_length;
mod score;
#[cfg(test)]
mod tests;

pub use change::Change;
pub use chart::{Chart, units};
pub use cusum::Cusum;
pub use detector::{Detector, Step};
pub use promise::{Remedy, ThresholdError};
pub use ranks::Ranks;
pub use rate::Rate;
pub use run_length::RunLength;
pub use score::{Lattice, STEPS, Score, Side};
