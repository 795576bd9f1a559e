//! Who has done what.

use super::Terms;
use super::held::Held;
use crate::results::{Checkpoint, Directory, ResultsError, Shard};

/// How far a directory is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Everything is counted.
    Finished,
    /// Something is missing.
    Unfinished,
    /// A run is at it.
    Running,
    /// What is there is not what was written.
    Damaged,
    /// No result.
    Foreign,
}

impl State {
    /// In a word or two.
    pub fn name(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Unfinished => "unfinished",
            Self::Running => "running",
            Self::Damaged => "damaged",
            Self::Foreign => "not liftsim's",
        }
    }
}

/// What a directory holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// How far it is.
    pub state: State,
    /// The name of the config; none where nothing can be told.
    pub experiment: Option<String>,
    /// Its share of the trials.
    pub shard: Option<Shard>,
    /// Distinct points.
    pub points: usize,
    /// Trials of a point, on average.
    pub done: u64,
    /// Trials of a point that are wanted.
    pub wanted: u64,
}

impl Status {
    /// Of what is in a directory at this moment.
    pub fn of(directory: &Directory) -> Self {
        let is_locked = directory.is_locked();
        let held = match Held::read(directory, Terms::Continue) {
            Ok(Some(held)) => held.state,
            Ok(None) if is_locked => return Self::nothing(State::Running),
            Ok(None) => return Self::nothing(State::Foreign),
            // The result of an experiment that is no sweep has no counters.
            Err(ResultsError::Different { .. }) => return Self::nothing(State::Finished),
            Err(_) if directory.is_finished() || directory.has_counts() => {
                return Self::nothing(State::Damaged);
            }
            Err(_) => return Self::nothing(State::Foreign),
        };
        let lacking = lacking(&held);
        let wanted = held.wanted();
        let wanted = wanted.end - wanted.start;
        Self {
            state: match lacking {
                _ if is_locked => State::Running,
                0 => State::Finished,
                _ => State::Unfinished,
            },
            experiment: Some(held.origin.config_name.clone()),
            shard: held.shard,
            points: points(&held),
            done: wanted - lacking,
            wanted,
        }
    }

    fn nothing(state: State) -> Self {
        Self {
            state,
            experiment: None,
            shard: None,
            points: 0,
            done: 0,
            wanted: 0,
        }
    }
}

/// How many points are counted.
fn points(state: &Checkpoint) -> usize {
    let counters = state.counters.iter();
    counters
        .filter(|(_, counter)| counter.counts.len() == 1)
        .count()
}

/// Trials that are wanted and not there: of all counters, those of pairs among them, on average and rounded
/// up, so that none means that nothing is missing.
pub(super) fn lacking(state: &Checkpoint) -> u64 {
    let wanted = state.wanted();
    let mut number = 0u128;
    let mut missing = 0u128;
    for (_, counter) in state.counters.iter() {
        number += 1;
        missing += u128::from(counter.trials.missing(wanted.clone()).len());
    }
    match number {
        0 => wanted.end - wanted.start,
        _ => missing.div_ceil(number) as u64,
    }
}
