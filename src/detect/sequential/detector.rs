//! The detector block by block: a reference, then ranks, scores and a CUSUM for each side.

use super::chart::Chart;
use super::cusum::Cusum;
use super::ranks::Ranks;
use super::score::{Lattice, Side};
use serde::{Deserialize, Serialize};

/// What a block was taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// One of the N of the reference.
    Reference,
    /// Monitored, without alarm.
    Quiet,
    /// Monitored, and this side alarms.
    Alarm(Side),
}

/// A running detector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detector {
    reference: usize,
    ranks: Ranks,
    lattice: Lattice,
    sums: Vec<(Side, Cusum)>,
}

impl Detector {
    pub(super) fn new(chart: &Chart, threshold: i32) -> Self {
        let cusum = Cusum::new(chart.allowance, threshold);
        Self {
            reference: chart.reference,
            ranks: Ranks::default(),
            lattice: chart.lattice.clone(),
            sums: chart.sides.iter().map(|side| (*side, cusum)).collect(),
        }
    }

    /// Takes in a block `x`, which is a number, with `v` uniform on (0, 1]. In the reference `v` has no effect. After an
    /// alarm everything starts again with a new reference.
    pub fn step(&mut self, x: f64, v: f64) -> Step {
        let step = self.step_on(x, v);
        if matches!(step, Step::Alarm(_)) {
            self.ranks.clear();
        }
        step
    }

    /// The same without a new reference: after an alarm the sums start again, and the ranks go on, which are uniform at
    /// rest whatever alarmed before.
    pub fn step_on(&mut self, x: f64, v: f64) -> Step {
        let u = self.ranks.step(x, v);
        if self.ranks.seen() <= self.reference {
            return Step::Reference;
        }
        let mut alarm = None;
        for (side, cusum) in &mut self.sums {
            if cusum.step(self.lattice.score(side.of(u))) {
                alarm = alarm.or(Some(*side));
            }
        }
        match alarm {
            None => Step::Quiet,
            Some(side) => {
                self.clear_sums();
                Step::Alarm(side)
            }
        }
    }

    /// Starts again with a new reference. This never brings a false alarm that would not have come without it, in as many
    /// monitored blocks.
    pub fn clear(&mut self) {
        self.ranks.clear();
        self.clear_sums();
    }

    fn clear_sums(&mut self) {
        self.sums.iter_mut().for_each(|(_, cusum)| cusum.clear());
    }

    /// Starts again with these blocks as the reference, in the place of new ones. The law of false alarms stays exact if they
    /// were chosen without regard to what they and the next ones are.
    pub fn begin(&mut self, reference: &[f64]) {
        self.clear();
        self.reference = reference.len();
        self.ranks.begin(reference);
    }

    /// The number of blocks that the next one is ranked among.
    pub fn seen(&self) -> usize {
        self.ranks.seen()
    }

    /// S of each side, in steps.
    pub fn sums(&self) -> impl Iterator<Item = (Side, i32)> {
        self.sums.iter().map(|(side, cusum)| (*side, cusum.sum()))
    }
}
