//! Who has done what.

use crate::results::{Checkpoint, Directory, Manifest, Shard};

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
    /// Points that are counted; none where a finished result does not tell.
    pub points: Option<usize>,
    /// Trials of a point, on average.
    pub done: u64,
    /// Trials of a point that are wanted.
    pub wanted: u64,
}

impl Status {
    /// Of what is in a directory at this moment.
    pub fn of(directory: &Directory) -> Self {
        let mut status = Self::unlocked(directory);
        if directory.is_locked() {
            status.state = State::Running;
        }
        status
    }

    fn unlocked(directory: &Directory) -> Self {
        match directory.checkpoint() {
            Ok(Some(state)) => return Self::so_far(&state),
            Ok(None) if !directory.is_finished() => return Self::nothing(State::Foreign),
            Ok(None) => {}
            Err(_) => return Self::nothing(State::Damaged),
        }
        match directory.manifest() {
            Ok(manifest) if directory.is_intact(&manifest) => Self::finished(&manifest),
            _ => Self::nothing(State::Damaged),
        }
    }

    fn so_far(state: &Checkpoint) -> Self {
        let lacking = state.lacking();
        let wanted = state.wanted();
        let wanted = wanted.end - wanted.start;
        Self {
            state: if lacking == 0 {
                State::Finished
            } else {
                State::Unfinished
            },
            experiment: Some(state.origin.config_name.clone()),
            shard: state.shard,
            points: Some(state.points),
            done: wanted - lacking,
            wanted,
        }
    }

    fn finished(manifest: &Manifest) -> Self {
        let origin = &manifest.origin;
        Self {
            experiment: Some(origin.config_name.clone()),
            done: origin.trials,
            wanted: origin.trials,
            ..Self::nothing(State::Finished)
        }
    }

    fn nothing(state: State) -> Self {
        Self {
            state,
            experiment: None,
            shard: None,
            points: None,
            done: 0,
            wanted: 0,
        }
    }
}
