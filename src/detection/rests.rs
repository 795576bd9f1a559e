//! Where the cage rests, undisturbed and beyond doubt.

use crate::explain::Explanation;
use crate::monitor::{Design, LEAST_TRAINING, MOST_ORDER, Reference};
use std::ops::Range;

/// Left out at either end of a motion or a disturbance, s.
const MARGIN: f64 = 0.15;

/// The blocks at rest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rests(Vec<Range<usize>>);

impl Rests {
    pub fn of(explanation: &Explanation) -> Self {
        let cut = &explanation.record.cut;
        let mut is_rest = vec![true; cut.blocks.len()];
        let margin = cut.blocks_in(MARGIN);
        let mut clear = |blocks: Range<usize>| {
            let from = blocks.start.saturating_sub(margin);
            let to = (blocks.end + margin).min(is_rest.len());
            is_rest[from..to].fill(false);
        };
        let trips = &explanation.reading.trips;
        let doubted = explanation.doubts.iter().flat_map(|doubt| &doubt.instead);
        let doubted = doubted.filter(|other| !trips.iter().any(|trip| trip.is_like(other)));
        for trip in trips.iter().chain(doubted) {
            clear(explanation.blocks_of(trip));
        }
        for pulses in &explanation.reading.others {
            let pulses = &explanation.record.pulses[pulses.clone()];
            clear(pulses[0].blocks.start..pulses[pulses.len() - 1].blocks.end);
        }
        let mut rests: Vec<Range<usize>> = Vec::new();
        for block in (0..is_rest.len()).filter(|block| is_rest[*block]) {
            match rests.last_mut() {
                Some(last) if last.end == block && !cut.ends.contains(&block) => last.end += 1,
                _ => rests.push(block..block + 1),
            }
        }
        Self(rests)
    }

    /// Whether the record begins at rest.
    pub fn begins(&self) -> bool {
        self.0.first().is_some_and(|first| first.start == 0)
    }

    pub fn iter(&self) -> impl Iterator<Item = Range<usize>> {
        self.0.iter().cloned()
    }

    /// The filter and X, if there is enough rest.
    pub fn learn(&self, explanation: &Explanation, design: &Design) -> Option<Reference> {
        let long = |rest: &&Range<usize>| rest.len() > MOST_ORDER + 2;
        let stretches = self.0.iter().filter(long).map(|rest| {
            let blocks = &explanation.record.cut.blocks[rest.clone()];
            blocks.iter().map(|block| block.mean).collect()
        });
        let stretches: Vec<Vec<f64>> = stretches.collect();
        let count: usize = stretches.iter().map(Vec::len).sum();
        let is_enough = count >= LEAST_TRAINING.max(design.samples.reference()) + MOST_ORDER;
        is_enough.then(|| Reference::from_stretches(&stretches, design))
    }
}
