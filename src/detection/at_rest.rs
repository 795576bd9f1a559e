//! False alarms on the recording's own rest: how many decisions, each of level α, were for motion while the
//! monitor said that the cage stood. Neighbours share most of their blocks, so no interval goes with it.

use crate::monitor::{Event, Kind, Observation, State};
use serde::Serialize;
use std::collections::VecDeque;

/// Decisions forwards while the cage stood.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AtRest {
    /// All of them.
    pub decisions: u64,
    /// Those for motion.
    pub false_alarms: u64,
    /// Those that a start, reported late, may still turn out to have been part of.
    #[serde(skip)]
    recent: VecDeque<Recent>,
}

#[derive(Clone, Copy, Debug)]
struct Recent {
    /// s
    to: f64,
    moves: bool,
}

/// A start is reported within so many seconds.
const LATEST_REPORT: f64 = 30.0;

impl AtRest {
    /// Takes a block and the state it was seen in.
    pub(super) fn block(&mut self, block: &Observation, state: State) {
        let Some(moves) = block.moves.filter(|_| state == State::REST) else {
            return;
        };
        let to = block.times.1;
        self.recent.push_back(Recent { to, moves });
        while (self.recent.front()).is_some_and(|oldest| oldest.to < to - LATEST_REPORT) {
            self.count_oldest();
        }
    }

    /// What was reported as a start, or as doubt, was no rest from then on.
    pub(super) fn event(&mut self, event: &Event) {
        if let Kind::Change { state, .. } = event.kind
            && state != State::REST
        {
            self.recent.retain(|decision| decision.to < event.time);
            self.end();
        }
    }

    /// Nothing more comes.
    pub(super) fn end(&mut self) {
        while !self.recent.is_empty() {
            self.count_oldest();
        }
    }

    fn count_oldest(&mut self) {
        if let Some(decision) = self.recent.pop_front() {
            self.decisions += 1;
            self.false_alarms += u64::from(decision.moves);
        }
    }
}
