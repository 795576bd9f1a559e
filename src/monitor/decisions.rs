//! The decisions of a record: its latest blocks, whitened by what rest looks like, compared with X at every block.

use super::decide::{Decider, Verdict, Windows};
use super::design::Design;
use super::event::{Decided, Decision, Direction, RankDecision};
use super::history::History;
use super::ranked::Ranked;
use super::reference::{MOST_RANKED, Reference};
use crate::explain::Block;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::ops::Range;

/// The number of alarms kept, to find the first since a start.
const ALARMS: usize = 64;

/// The longest braking whose decision is made, s.
const LONGEST_BRAKING: f64 = 60.0;

/// Blocks look like rest if their mean square is at most this many times that of the reference; it is followed over
/// this time, s, and single ones count for at most so much.
const CALM: (f64, f64, f64) = (2.0, 2.0, 9.0);

/// A block and its decision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Times of its first and last sample, s.
    pub times: (f64, f64),
    /// The mean as measured, m/s².
    pub mean: f64,
    /// The mean centred and whitened, m/s².
    pub whitened: f64,
    /// Whether the decision at this block is for motion, once there are enough blocks.
    pub moves: Option<bool>,
}

/// What decides.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Rule {
    /// With the decision at the newest block, and its windows.
    ThreeSample(Decider, Option<(Windows, Verdict)>),
    /// With time, s, and direction of the latest alarms.
    Sequential(Ranked, VecDeque<(f64, Direction)>),
}

/// All of them.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Decisions {
    pub design: Design,
    pub reference: Option<Reference>,
    history: History,
    rule: Rule,
    /// The last time that the decision was for motion, or could not be made, s.
    moved: f64,
    /// The mean square of whitened blocks, in that of the reference.
    strength: f64,
    /// The first block that the next reference may be learnt from.
    learns_from: u64,
    /// Where ranks decide, the next reference is learnt when this block has been seen.
    due: u64,
}

impl Decisions {
    pub fn new(design: Design, reference: Option<Reference>) -> Self {
        let samples = &design.samples;
        let most = design.ranks.as_ref().map_or(0, |_| MOST_RANKED);
        let learnt = most.max(design.settings.learnt_from()) + samples.shift();
        let looked_back = 4 * samples.span() + (LONGEST_BRAKING / design.block) as usize;
        Self {
            history: History::new(learnt.max(looked_back)),
            rule: match &design.ranks {
                None => Rule::ThreeSample(Decider::new(&design), None),
                Some(ranks) => {
                    let ranked = reference.as_ref().map_or(&[][..], |it| &it.ranked);
                    Rule::Sequential(Ranked::new(ranks.clone(), ranked), VecDeque::new())
                }
            },
            moved: f64::NEG_INFINITY,
            strength: CALM.2,
            learns_from: 0,
            due: 0,
            reference,
            design,
        }
    }

    /// Decides at a new block; `None` without a reference.
    pub fn step(&mut self, block: Block) -> Option<Observation> {
        self.history.push(block, self.reference.as_ref());
        let moves = self.decide();
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

    /// Whether the newest block brings a decision for motion; `None` without a reference, or with too few blocks.
    fn decide(&mut self) -> Option<bool> {
        let (design, history) = (&self.design, &self.history);
        let reference = self.reference.as_ref()?;
        match &mut self.rule {
            Rule::ThreeSample(decider, latest) => {
                let windows = Windows::forwards(design, history.end());
                *latest = windows.and_then(|windows| {
                    let verdict = decider.decide(design, reference, history, &windows)?;
                    Some((windows, verdict))
                });
                latest.as_ref().map(|(_, verdict)| verdict.moves)
            }
            Rule::Sequential(ranked, alarms) => {
                let (block, whitened) = history.newest();
                if ranked.is_full() {
                    ranked.begin(&reference.ranked);
                }
                let alarm = ranked.step(whitened, history.end());
                alarm
                    .into_iter()
                    .for_each(|side| keep(alarms, (block.to, side)));
                Some(alarm.is_some())
            }
        }
    }

    /// Whether the latest blocks look like rest.
    pub fn is_calm(&self) -> bool {
        self.strength < CALM.0
    }

    /// Whether a decision was for motion since a time, or none could be made.
    pub fn agree_since(&self, start: f64) -> bool {
        self.moved >= start
    }

    /// The decision at the newest block, or the first alarm of ranks since the start, s, to the side of its direction.
    pub fn at_start(&self, start: Option<f64>, direction: Option<Direction>) -> Option<Decided> {
        match &self.rule {
            Rule::ThreeSample(_, latest) => {
                let (windows, verdict) = latest.as_ref()?;
                self.decision(windows, verdict).map(Decided::ThreeSample)
            }
            Rule::Sequential(_, alarms) => {
                let (reference, start) = (self.reference.as_ref()?, start?);
                let is_for = |(time, side): &&(f64, Direction)| {
                    *time >= start && direction.is_none_or(|it| it == *side)
                };
                let &(alarmed, side) = alarms.iter().find(is_for)?;
                Some(Decided::Sequential(RankDecision {
                    alarmed,
                    side,
                    alpha: self.design.settings.detector.alpha,
                    ranked: reference.ranked.len(),
                    reference: reference.span,
                }))
            }
        }
    }

    /// The decision on a braking, s; ranks only look ahead.
    pub fn at_stop(&mut self, (from, to): (f64, f64)) -> Option<Decided> {
        let Rule::ThreeSample(decider, _) = &mut self.rule else {
            return None;
        };
        let braking = self.history.at(from)..self.history.at(to);
        let windows = Windows::backwards(&self.design, braking)?;
        let reference = self.reference.as_ref()?;
        let verdict = decider.decide(&self.design, reference, &self.history, &windows)?;
        self.decision(&windows, &verdict).map(Decided::ThreeSample)
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
        if let Rule::ThreeSample(_, latest) = &mut self.rule {
            *latest = None;
        }
        self.begin_again();
        self.moved = f64::NEG_INFINITY;
        (self.learns_from, self.due) = (0, 0);
    }

    /// Ranks begin again with the reference, without the alarms so far: a motion or a hole was among their blocks.
    pub fn begin_again(&mut self) {
        if let (Rule::Sequential(ranked, alarms), Some(reference)) =
            (&mut self.rule, &self.reference)
        {
            alarms.clear();
            ranked.begin(&reference.ranked);
        }
    }

    /// The newest block is none to learn from, nor are those before.
    pub fn learn_no_earlier(&mut self) {
        (self.learns_from, self.due) = (self.history.end(), 0);
    }

    /// Learns the filter and X again from the latest blocks, if the cage has stood quietly for long enough since a
    /// time, s.
    pub fn learn(&mut self, since: f64) {
        if self.history.at(since) > self.learns_from {
            (self.learns_from, self.due) = (self.history.at(since), 0);
        }
        let least = self.design.settings.learnt_from() as u64;
        // Leave out the newest blocks: they may belong to a start that is not seen yet.
        let to = (self.history.end()).saturating_sub(self.design.samples.shift() as u64);
        if to < self.due.max(self.learns_from + least) {
            return;
        }
        let most = match self.rule {
            Rule::ThreeSample(..) => least,
            Rule::Sequential(..) => least.max(MOST_RANKED as u64),
        };
        let from = self.learns_from.max(to.saturating_sub(most));
        let Some(record) = self.history.blocks(from..to) else {
            return;
        };
        let span = (record[0].from, record[record.len() - 1].to);
        let record: Vec<f64> = record.iter().map(|block| block.mean).collect();
        let learnt = Reference::from_rest(&record, span, &self.design);
        self.history.whiten(&learnt);
        // Often enough to follow a level that drifts, and seldom enough for S to climb.
        self.due = to + (to - from).min(2 * least);
        self.begin(to, &learnt);
        self.reference = Some(learnt);
    }

    /// Begins with a new reference, which was learnt from blocks before `to`.
    fn begin(&mut self, to: u64, reference: &Reference) {
        let Rule::Sequential(ranked, alarms) = &mut self.rule else {
            self.learns_from = self.history.end();
            return;
        };
        ranked.begin(&reference.ranked);
        for number in to..self.history.end() {
            let (block, whitened) = self.history.get(number);
            if let Some(side) = ranked.step(whitened, number + 1) {
                keep(alarms, (block.to, side));
                self.moved = self.moved.max(block.to);
            }
        }
    }
}

/// Adds an alarm, and drops the oldest where there are too many.
fn keep(alarms: &mut VecDeque<(f64, Direction)>, alarm: (f64, Direction)) {
    if alarms.len() == ALARMS {
        alarms.pop_front();
    }
    alarms.push_back(alarm);
}
