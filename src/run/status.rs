//! The progress of the run in a directory.

use crate::results::{Checkpoint, Directory, Manifest, Shard};

/// The state of the run in a directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// All trials are counted, and the files of a whole run are written.
    Finished,
    /// Some trials or files are missing.
    Unfinished,
    /// A run is using the directory.
    Running,
    /// The files cannot be read, or they differ from the files that were written.
    Damaged,
    /// The directory holds no result.
    Foreign,
}

impl State {
    /// The state in a word or two.
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

/// The contents of a directory in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// The state of the run.
    pub state: State,
    /// The name of the config, or `None` if the directory holds no readable result.
    pub experiment: Option<String>,
    /// The shard that the directory holds, if it holds one.
    pub shard: Option<Shard>,
    /// The number of points that are counted, or `None` for a finished result, which does not store it.
    pub points: Option<usize>,
    /// The number of trials done per point, on average.
    pub done: u64,
    /// The number of trials wanted per point.
    pub wanted: u64,
}

impl Status {
    /// Reads the status of a directory at this moment.
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
            // Of a whole run the counts are left only where its files are not written yet.
            state: if lacking == 0 && state.shard.is_some() {
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
