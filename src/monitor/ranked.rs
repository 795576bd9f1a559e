//! Decisions by sequential ranks: the whitened blocks of the reference begin the ranks, and every block since is ranked
//! among all before it.
//!
//! After an alarm the ranks go on, so that the promised rate of false alarms is exact on each reference if the whitened
//! blocks of rest are exchangeable; see [`sequential`](crate::detect::sequential). With a new reference, and after a motion,
//! everything begins again.

use super::event::Direction;
use crate::detect::sequential::{Detector, Side, Step};
use crate::rng::{Stream, unit};
use serde::{Deserialize, Serialize};

/// Where nothing is learnt for long, everything begins again so many blocks after the reference, to bound the memory.
const MOST: usize = 1 << 12;

/// Ranks at work, with random numbers for ties.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Ranked {
    detector: Detector,
    /// The number of blocks that are ranked at most.
    most: usize,
    ties: Stream,
}

impl Ranked {
    pub fn new(detector: Detector, reference: &[f64]) -> Self {
        let mut ranked = Self {
            detector,
            most: MOST,
            ties: Stream::new(0, "ties", "monitor"),
        };
        ranked.begin(reference);
        ranked
    }

    /// Begins again.
    pub fn begin(&mut self, reference: &[f64]) {
        self.most = reference.len() + MOST;
        self.detector.begin(reference);
    }

    /// Whether it should begin again.
    pub fn is_full(&self) -> bool {
        self.detector.seen() > self.most
    }

    /// Takes in a whitened block; the direction of an alarm, if there is one. `number` chooses the key of ties.
    pub fn step(&mut self, whitened: f64, number: u64) -> Option<Direction> {
        if whitened.is_nan() {
            return None;
        }
        let v = 1.0 - unit(&mut self.ties.at(number));
        match self.detector.step_on(whitened, v) {
            Step::Alarm(Side::Down) => Some(Direction::Down),
            Step::Alarm(_) => Some(Direction::Up),
            Step::Reference | Step::Quiet => None,
        }
    }
}
