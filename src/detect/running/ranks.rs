//! CUSUMs of the normal scores of sequential ranks, up and down: see [`sequential`](crate::detect::sequential).

use super::blocks::{GAP, REFERENCE, Score};
use crate::detect::sequential::{self, Chart, Detector, Side, Step, units};
use crate::rng::{Generator, unit};

/// k.
const ALLOWANCE: f64 = 0.8;

/// A detector whose threshold is never reached.
#[derive(Clone, Debug)]
pub struct SequentialRanks {
    detector: Detector,
    ties: Generator,
}

impl SequentialRanks {
    pub fn new(ties: Generator) -> Self {
        let sides = [Side::Up, Side::Down];
        let chart = Chart::new(
            sequential::Score::Normal,
            &sides,
            ALLOWANCE,
            REFERENCE + GAP,
        );
        Self {
            detector: chart.expect("k is on the lattice").detector(i32::MAX),
            ties,
        }
    }
}

impl Score for SequentialRanks {
    fn step(&mut self, x: f64) -> f64 {
        match self.detector.step(x, 1.0 - unit(&mut self.ties)) {
            Step::Reference => f64::NEG_INFINITY,
            _ => units(self.detector.sums().map(|(_, sum)| sum).max().unwrap_or(0)),
        }
    }
}
