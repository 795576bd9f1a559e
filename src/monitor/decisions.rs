//! The decisions of a record: its latest blocks, whitened by what rest looks like, compared with X at every block.

use super::decide::{Decider, Verdict, Windows};
use super::design::Design;
use super::event::Decision;
use super::history::History;
use super::reference::Reference;
use crate::explain::Block;
use std::ops::Range;

/// The longest braking whose decision is made, s.
const LONGEST_BRAKING: f64 = 60.0;

/// Blocks look like rest if their mean square is at most this many times that of the reference; it is followed over
/// this time, s, and single ones count for at most so much.
const CALM: (f64, f64, f64) = (2.0, 2.0, 9.0);

/// A block and its decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Times of its first and last sample, s.
    pub times: (f64, f64),
    /// The mean as measured, m/s².
    pub mean: f64,
    /// The mean centred and whitened, m/s².
    pub whitened: f64,
    /// Whether the forward decision is H₁*, once there are enough blocks.
    pub moves: Option<bool>,
}

/// All of them.
#[derive(Clone, Debug)]
pub(super) struct Decisions {
    pub design: Design,
    pub reference: Option<Reference>,
    history: History,
    decider: Decider,
    /// The decision at the newest block, and its windows.
    latest: Option<(Windows, Verdict)>,
    /// The last time that the decision was H₁*, or could not be made, s.
    moved: f64,
    /// The mean square of whitened blocks, in that of the reference.
    strength: f64,
    /// The first block that the next reference may be learnt from.
    learns_from: u64,
}

impl Decisions {
    pub fn new(design: Design, reference: Option<Reference>) -> Self {
        let samples = &design.samples;
        let learnt = design.settings.whitening.training + samples.reference() + samples.shift();
        let looked_back = 4 * samples.span() + (LONGEST_BRAKING / design.block) as usize;
        Self {
            history: History::new(learnt.max(looked_back)),
            decider: Decider::new(&design),
            latest: None,
            moved: f64::NEG_INFINITY,
            strength: CALM.2,
            learns_from: 0,
            reference,
            design,
        }
    }

    /// Decides at a new block; `None` without a reference.
    pub fn step(&mut self, block: Block) -> Option<Observation> {
        self.history.push(block, self.reference.as_ref());
        self.latest = Windows::forwards(&self.design, self.history.end())
            .and_then(|windows| Some((windows.clone(), self.verdict(&windows)?)));
        let moves = self.latest.as_ref().map(|(_, verdict)| verdict.moves);
        if moves != Some(false) {
            self.moved = block.to;
        }
        let reference = self.reference.as_ref()?;
        let (_, whitened) = self.history.newest();
        let ratio = (whitened / reference.deviation).powi(2).min(CALM.2);
        if ratio.is_finite() {
            self.strength += self.design.block / CALM.1 * (ratio - self.strength);
        }
        Some(Observation {
            times: (block.from, block.to),
            mean: block.mean,
            whitened,
            moves,
        })
    }

    fn verdict(&mut self, windows: &Windows) -> Option<Verdict> {
        let reference = self.reference.as_ref()?;
        (self.decider).decide(&self.design, reference, &self.history, windows)
    }

    /// Whether the latest blocks look like rest.
    pub fn is_calm(&self) -> bool {
        self.strength < CALM.0
    }

    /// Whether a decision was H₁* since a time, or none could be made.
    pub fn agree_since(&self, start: f64) -> bool {
        self.moved >= start
    }

    /// The decision at the newest block.
    pub fn at_start(&self) -> Option<Decision> {
        let (windows, verdict) = self.latest.as_ref()?;
        self.decision(windows, verdict)
    }

    /// The decision on a braking, s.
    pub fn at_stop(&mut self, (from, to): (f64, f64)) -> Option<Decision> {
        let braking = self.history.at(from)..self.history.at(to);
        let windows = Windows::backwards(&self.design, braking)?;
        let verdict = self.verdict(&windows)?;
        self.decision(&windows, &verdict)
    }

    fn decision(&self, windows: &Windows, verdict: &Verdict) -> Option<Decision> {
        let span = |blocks: &Range<u64>| {
            (
                self.history.starts(blocks.start),
                self.history.ends(blocks.end),
            )
        };
        let spans = [span(&windows.shift), span(&windows.scale)];
        let reference = self.reference.as_ref()?;
        Some(verdict.decision(&self.design, reference.span, spans))
    }

    /// Forgets the blocks, not the reference.
    pub fn forget(&mut self) {
        self.history.clear();
        self.latest = None;
        self.moved = f64::NEG_INFINITY;
        self.learns_from = 0;
    }

    /// The newest block is none to learn from, nor are those before.
    pub fn learn_no_earlier(&mut self) {
        self.learns_from = self.history.end();
    }

    /// Learns the filter and X again from the latest blocks, if the cage has stood quietly for long enough since a
    /// time, s.
    pub fn learn(&mut self, since: f64) {
        self.learns_from = self.learns_from.max(self.history.at(since));
        let samples = &self.design.samples;
        let needed = (self.design.settings.whitening.training + samples.reference()) as u64;
        // Leave out the newest blocks: they may belong to a start that is not seen yet.
        let to = self.history.end().saturating_sub(samples.shift() as u64);
        if to < self.learns_from + needed {
            return;
        }
        let Some(record) = self.history.blocks(to - needed..to) else {
            return;
        };
        let span = (record[0].from, record[record.len() - 1].to);
        let record: Vec<f64> = record.iter().map(|block| block.mean).collect();
        let learnt = Reference::from_rest(&record, span, &self.design);
        self.history.whiten(&learnt);
        self.reference = Some(learnt);
        self.learns_from = self.history.end();
    }
}
