//! The decision of [^1] at each start and stop, and how often it is wrong in the recording's own rest.
//!
//! At a start Y₁ is the middle of the acceleration, since whitening gives its ends the opposite sign, and Y₂ the motion
//! after it; a stop is a start reversed in time. X is the sample of rest that was learnt.
//!
//! [^1]: see [`crate::signal`].

use super::rests::Rests;
use crate::detect::Pooled;
use crate::explain::{Explanation, Pulse};
use crate::monitor::{Decider, Decision, Design, Ranked, Reference, Verdict};
use crate::whiten;
use rayon::prelude::*;
use serde::Serialize;
use std::ops::Range;

/// A motion shows where its blocks scatter this many times as much as those of rest.
const SHOWS: f64 = 1.5;

/// Forward decisions while the cage stood. Neighbouring ones share most of their blocks, so there is no interval.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AtRest {
    /// The number of decisions.
    pub decisions: u64,
    /// The number of decisions for motion.
    pub false_alarms: u64,
    /// Blocks that were ranked, if the rule is `sequential`, each rest among its own,
    pub ranked: u64,
    /// and the alarms that they brought.
    pub rank_alarms: u64,
}

/// A record whitened, ready for decisions.
pub(super) struct Decisions<'a> {
    design: &'a Design,
    explanation: &'a Explanation,
    reference: Option<&'a Reference>,
    whitened: Vec<f64>,
}

impl<'a> Decisions<'a> {
    pub fn new(
        design: &'a Design,
        explanation: &'a Explanation,
        reference: Option<&'a Reference>,
    ) -> Self {
        let record = &explanation.record;
        let blocks = record.cut.blocks.iter().zip(&record.level.at);
        let centred: Vec<f64> = blocks.map(|(block, level)| block.mean - level).collect();
        // Without a filter it is shown as it is.
        let mut whitened = centred.clone();
        if let Some(reference) = reference {
            let mut from = 0;
            for &to in &record.cut.ends {
                let part = &mut whitened[from..to];
                whiten::whiten(&reference.coefficients, &centred[from..to], 0, part);
                from = to;
            }
        }
        Self {
            design,
            explanation,
            reference,
            whitened,
        }
    }

    pub fn whitened(&self) -> &[f64] {
        &self.whitened
    }

    /// The decision that a motion begins with this pulse.
    pub fn start(&self, pulse: &Pulse) -> Option<Decision> {
        let shift = self.middle(pulse)?;
        let from = pulse.blocks.end.max(shift.end + self.design.samples.gap());
        self.decision(shift, from..from + self.design.samples.scale())
    }

    /// The decision that a motion ends with it.
    pub fn stop(&self, pulse: &Pulse) -> Option<Decision> {
        let shift = self.middle(pulse)?;
        let to = pulse
            .blocks
            .start
            .min(shift.start.checked_sub(self.design.samples.gap())?);
        self.decision(shift, to.checked_sub(self.design.samples.scale())?..to)
    }

    fn middle(&self, pulse: &Pulse) -> Option<Range<usize>> {
        let length = self.design.samples.shift();
        let middle = usize::midpoint(pulse.blocks.start, pulse.blocks.end);
        let from = middle.checked_sub(length / 2)?;
        Some(from..from + length)
    }

    fn decision(&self, shift: Range<usize>, scale: Range<usize>) -> Option<Decision> {
        let ends = &self.explanation.record.cut.ends;
        let stretch = |block: usize| ends.partition_point(|end| *end <= block);
        let (first, last) = (shift.start.min(scale.start), shift.end.max(scale.end) - 1);
        if last >= self.whitened.len() || stretch(first) != stretch(last) {
            return None;
        }
        let verdict = self.verdict(&mut Decider::new(self.design), shift.clone(), scale.clone())?;
        let blocks = &self.explanation.record.cut.blocks;
        let span = |range: Range<usize>| (blocks[range.start].from, blocks[range.end - 1].to);
        Some(verdict.decision(
            self.design,
            self.reference?.span,
            [span(shift), span(scale)],
        ))
    }

    fn verdict(
        &self,
        decider: &mut Decider,
        shift: Range<usize>,
        scale: Range<usize>,
    ) -> Option<Verdict> {
        let number = scale.end as u64;
        let pooled = Pooled {
            reference: &self.reference?.sample,
            shift: &self.whitened[shift],
            scale: &self.whitened[scale],
        };
        Some(decider.verdict(self.design, &pooled, number))
    }

    /// The decisions at every block of rest.
    pub fn at_rest(&self, rests: &Rests) -> AtRest {
        let samples = &self.design.samples;
        let (shift, gap, scale) = (samples.shift(), samples.gap(), samples.scale());
        let within = |rest: Range<usize>| {
            let mut decider = Decider::new(self.design);
            let mut found = self.ranks(&self.whitened[rest.clone()]);
            for end in rest.start + shift + gap + scale..=rest.end {
                let from = end - scale - gap - shift;
                let verdict = self.verdict(&mut decider, from..from + shift, end - scale..end);
                found.decisions += 1;
                found.false_alarms += u64::from(verdict.is_some_and(|verdict| verdict.moves));
            }
            found
        };
        let rests: Vec<_> = rests.iter().filter(|_| self.reference.is_some()).collect();
        let found = rests.into_par_iter().map(within);
        found.reduce(AtRest::default, |a, b| AtRest {
            decisions: a.decisions + b.decisions,
            false_alarms: a.false_alarms + b.false_alarms,
            ranked: a.ranked + b.ranked,
            rank_alarms: a.rank_alarms + b.rank_alarms,
        })
    }

    /// The alarms of ranks in a rest, which begin with as many of its blocks as a monitor learns from.
    fn ranks(&self, rest: &[f64]) -> AtRest {
        let learnt_from = self.design.settings.learnt_from();
        let Some(ranks) = (self.design.ranks.as_ref()).filter(|_| rest.len() > learnt_from) else {
            return AtRest::default();
        };
        let (reference, monitored) = rest.split_at(learnt_from);
        let mut ranked = Ranked::new(ranks.clone(), reference);
        let alarms = monitored
            .iter()
            .zip(0..)
            .filter(|(block, number)| ranked.step(**block, *number).is_some());
        AtRest {
            rank_alarms: alarms.count() as u64,
            ranked: monitored.len() as u64,
            ..AtRest::default()
        }
    }

    /// Whether all uniform motions, from and to these times in s, scatter more than rest, two of them at least.
    pub fn motion_shows(&self, motions: impl Iterator<Item = (f64, f64)>) -> bool {
        let Some(reference) = self.reference else {
            return false;
        };
        let blocks = &self.explanation.record.cut.blocks;
        let mut shown = 0;
        for (from, to) in motions {
            let place = |time: f64| blocks.partition_point(|block| block.to <= time);
            let whitened = &self.whitened[place(from)..place(to).max(place(from))];
            if whitened.len() < 2 * self.design.samples.reference() {
                continue;
            }
            let squares: f64 = whitened.iter().map(|y| y * y).sum();
            if (squares / whitened.len() as f64).sqrt() < SHOWS * reference.deviation {
                return false;
            }
            shown += 1;
        }
        shown >= 2
    }
}
