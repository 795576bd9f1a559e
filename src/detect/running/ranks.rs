//! CUSUMs of the normal scores of sequential ranks, up and down: see [`sequential`](crate::detect::sequential).

use super::blocks::{GAP, REFERENCE, Score};
use crate::detect::sequential::{Cusum, Lattice, Ranks, STEPS, Score as Of, Side, units};
use crate::rng::{Generator, unit};

/// k, in steps: 0.8.
const ALLOWANCE: i32 = 4 * STEPS / 5;

/// The ranks of all blocks so far.
#[derive(Clone, Debug)]
pub struct SequentialRanks {
    ranks: Ranks,
    lattice: Lattice,
    sums: [(Side, Cusum); 2],
    ties: Generator,
}

impl SequentialRanks {
    pub fn new(ties: Generator) -> Self {
        let cusum = Cusum::new(ALLOWANCE, i32::MAX);
        Self {
            ranks: Ranks::default(),
            lattice: Lattice::new(Of::Normal),
            sums: [Side::Up, Side::Down].map(|side| (side, cusum)),
            ties,
        }
    }
}

impl Score for SequentialRanks {
    fn step(&mut self, x: f64) -> f64 {
        let u = self.ranks.step(x, 1.0 - unit(&mut self.ties));
        if self.ranks.seen() <= REFERENCE + GAP {
            return f64::NEG_INFINITY;
        }
        let each = self.sums.iter_mut().map(|(side, cusum)| {
            cusum.step(self.lattice.score(side.of(u)));
            cusum.sum()
        });
        units(each.max().unwrap_or(0))
    }
}
