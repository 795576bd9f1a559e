//! Inputs of one state transition: the newest block's decision, the pulses, and the blocks before.

use super::decide::{Decider, Verdict, Windows};
use super::design::Design;
use super::event::Decision;
use super::history::History;
use super::pulse::{Cusum, Pulse};
use super::reference::Reference;
use crate::explain::Block;
use std::ops::Range;

/// The largest share of the speed that the pulses of a real ride leave at its end.
const ROUNDING: f64 = 0.1;

/// The inputs at the newest block.
pub(super) struct StepInput<'a> {
    pub design: &'a Design,
    pub history: &'a History,
    pub reference: &'a Reference,
    /// Whether blocks like the reference are evidence of rest.
    pub calm_is_rest: bool,
    /// Whether they are evidence of rest until the first pulse.
    pub begins_at_rest: bool,
    pub decider: &'a mut Decider,
    pub cusums: &'a [Cusum; 2],
    /// Pulses ended by the newest block.
    pub ended: [Option<Pulse>; 2],
    /// The windows of the forward decision.
    pub windows: Windows,
    pub verdict: Verdict,
    /// The number of blocks so far.
    pub now: u64,
    /// End of the newest block, s.
    pub time: f64,
}

impl StepInput<'_> {
    pub fn least_speed(&self) -> f64 {
        self.design.settings.monitor.least_speed
    }

    pub fn longest_motion(&self) -> f64 {
        self.design.settings.monitor.longest_motion
    }

    /// N.
    pub fn reference_length(&self) -> u64 {
        self.design.samples.reference() as u64
    }

    /// M₂.
    pub fn scale_length(&self) -> u64 {
        self.design.samples.scale() as u64
    }

    /// The current pulse with this sign.
    pub fn pulse(&self, sign: f64) -> Option<Pulse> {
        let mut cusums = self.cusums.iter();
        cusums.find_map(|cusum| cusum.pulse().copied().filter(|pulse| pulse.sign == sign))
    }

    /// The pulse of this sign that has just ended.
    pub fn ended(&self, sign: f64) -> Option<Pulse> {
        let mut ended = self.ended.into_iter().flatten();
        ended.find(|pulse| pulse.sign == sign)
    }

    /// Whether a pulse is stronger than any acceleration of a lift.
    pub fn is_violent(&self, pulse: &Pulse) -> bool {
        pulse.peak > self.design.settings.monitor.most_acceleration
    }

    /// The duration of a pulse so far, s.
    pub fn lasts(&self, pulse: &Pulse) -> f64 {
        pulse.length() as f64 * self.design.block
    }

    /// The number of blocks in `seconds`.
    pub fn blocks(&self, seconds: f64) -> u64 {
        (seconds / self.design.block) as u64
    }

    /// Whether there are N blocks after a pulse.
    pub fn is_after(&self, pulse: &Pulse) -> bool {
        self.now >= pulse.end + self.reference_length()
    }

    /// The change of speed over some blocks, m/s.
    pub fn change_of_speed(&self, blocks: Range<u64>) -> Option<f64> {
        let blocks = self.history.blocks(blocks)?.iter();
        let change = |block: &Block| (block.mean - self.reference.level) * block.seconds;
        Some(blocks.map(change).sum())
    }

    /// A completed pulse with its whole change of speed, including its end that is too weak for the sum.
    pub fn whole(&self, pulse: &Pulse) -> Pulse {
        let patience = self.design.samples.shift() as u64;
        let next = self.pulse(-pulse.sign).map_or(self.now, |next| next.onset);
        let end = self.now.min(pulse.end + patience).min(next.max(pulse.end));
        let change = self.change_of_speed(pulse.onset..end);
        Pulse {
            speed: change.map_or(pulse.speed, |change| pulse.sign * change),
            ..*pulse
        }
    }

    /// The largest sum of changes of speed that still counts as rest, if the largest change was `speed`.
    pub fn rounding(&self, speed: f64) -> f64 {
        self.least_speed().max(ROUNDING * speed)
    }

    /// The start of a block, s.
    pub fn starts(&self, block: u64) -> f64 {
        self.history.starts(block)
    }

    /// The end of the block before `block`, s.
    pub fn ends(&self, block: u64) -> f64 {
        self.history.ends(block)
    }

    /// The full decision at the newest block.
    pub fn forward_decision(&self) -> Decision {
        self.decision(&self.windows, &self.verdict)
    }

    /// The decision that a pulse was a stop, if it was one.
    pub fn backward_decision(&mut self, pulse: &Pulse) -> Option<Decision> {
        let windows = Windows::backwards(self.design, pulse, self.now)?;
        let verdict = self.decide(&windows)?;
        let is_stop = verdict.moves && verdict.sign == pulse.sign;
        is_stop.then(|| self.decision(&windows, &verdict))
    }

    fn decision(&self, windows: &Windows, verdict: &Verdict) -> Decision {
        let span = |blocks: &Range<u64>| (self.starts(blocks.start), self.ends(blocks.end));
        let reference = windows.reference.as_ref().map(span).or(self.reference.span);
        let samples = [span(&windows.shift), span(&windows.scale)];
        verdict.decision(self.design, reference, samples)
    }

    fn decide(&mut self, windows: &Windows) -> Option<Verdict> {
        self.decider
            .decide(self.design, self.reference, self.history, windows)
    }
}
