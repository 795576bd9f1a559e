//! What there is to go by when the cage's next state is asked for: the newest block's decision, the pulses,
//! and what can be looked up in the blocks before.

use super::event::Decision;
use super::history::History;
use super::judge::{Judge, Places, Verdict, decision};
use super::pulse::{Cusum, Pulse};
use super::reference::Reference;
use super::settings::Design;
use std::ops::Range;

/// The view from the newest block.
pub(super) struct Scene<'a> {
    pub design: &'a Design,
    pub history: &'a History,
    pub reference: &'a Reference,
    /// Whether blocks like the reference are evidence of rest.
    pub calm_is_rest: bool,
    /// Whether they are as long as no pulse has been seen.
    pub begins_at_rest: bool,
    pub judge: &'a mut Judge,
    pub cusums: &'a [Cusum; 2],
    /// Pulses that the newest block has ended.
    pub ended: [Option<Pulse>; 2],
    /// Of the decision forwards.
    pub places: Places,
    pub verdict: Verdict,
    /// The number of blocks so far.
    pub now: u64,
    /// When the newest ended, s.
    pub time: f64,
}

impl Scene<'_> {
    pub fn least_speed(&self) -> f64 {
        self.design.settings.least_speed
    }

    pub fn longest_motion(&self) -> f64 {
        self.design.settings.longest_motion
    }

    /// N.
    pub fn reference_length(&self) -> u64 {
        self.design.samples.reference() as u64
    }

    /// M₂.
    pub fn scale_length(&self) -> u64 {
        self.design.samples.scale() as u64
    }

    /// The pulse under way with this sign.
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
        pulse.peak > self.design.settings.most_acceleration
    }

    /// How long a pulse has lasted, s.
    pub fn lasts(&self, pulse: &Pulse) -> f64 {
        pulse.length() as f64 * self.design.block
    }

    /// How many blocks there are in so many seconds.
    pub fn blocks(&self, seconds: f64) -> u64 {
        (seconds / self.design.block) as u64
    }

    /// Whether there are N blocks after a pulse.
    pub fn is_after(&self, pulse: &Pulse) -> bool {
        self.now >= pulse.end + self.reference_length()
    }

    /// The change of speed over some blocks, m/s.
    pub fn change_of_speed(&self, blocks: Range<u64>) -> Option<f64> {
        let means = self.history.means(blocks)?.iter();
        let excess: f64 = means.map(|mean| mean - self.reference.level).sum();
        Some(excess * self.design.block)
    }

    /// When a block began.
    pub fn starts(&self, block: u64) -> f64 {
        self.history.starts(block)
    }

    /// When the block before `block` ended.
    pub fn ends(&self, block: u64) -> f64 {
        self.history.ends(block)
    }

    /// The decision at the newest block, in full.
    pub fn forward_decision(&self) -> Decision {
        self.decision(&self.places, &self.verdict)
    }

    /// The decision that a pulse was a stop, where it is one.
    pub fn backward_decision(&mut self, pulse: &Pulse) -> Option<Decision> {
        let places = Places::backwards(self.design, pulse, self.now)?;
        let verdict = self.judge(&places)?;
        let is_stop = verdict.moves && verdict.sign == pulse.sign;
        is_stop.then(|| self.decision(&places, &verdict))
    }

    fn decision(&self, places: &Places, verdict: &Verdict) -> Decision {
        decision(self.design, self.history, self.reference, places, verdict)
    }

    fn judge(&mut self, places: &Places) -> Option<Verdict> {
        self.judge
            .verdict(self.design, self.reference, self.history, places)
    }
}
