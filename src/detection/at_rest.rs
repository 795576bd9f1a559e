//! False alarms in the recording's own rest: the number of decisions for motion, each of level α, while the
//! monitor's state was rest. Neighbouring decisions share most of their blocks, so there is no interval.

use crate::monitor::{Event, Kind, Observation, State};
use serde::Serialize;
use std::collections::VecDeque;

/// Forward decisions while the cage stood.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AtRest {
    /// The number of decisions.
    pub decisions: u64,
    /// The number of decisions for motion.
    pub false_alarms: u64,
    /// The latest decisions, which may turn out to belong to a start that is reported late.
    #[serde(skip)]
    recent: VecDeque<Recent>,
}

#[derive(Clone, Copy, Debug)]
struct Recent {
    /// s
    to: f64,
    moves: bool,
}

/// The longest delay of a reported start, s.
const LATEST_REPORT: f64 = 30.0;

impl AtRest {
    /// Takes a block and the state at that time.
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

    /// Drops the decisions since the time of a reported start or loss of state: they were not at rest.
    pub(super) fn event(&mut self, event: &Event) {
        if let Kind::Change { state, .. } = event.kind
            && state != State::REST
        {
            self.recent.retain(|decision| decision.to < event.time);
            self.end();
        }
    }

    /// Counts the remaining decisions at the end of the record.
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
