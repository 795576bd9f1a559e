//! Saves the counts of a run while it continues.

use super::Progress;
use crate::counts::Counts;
use crate::results::{Checkpoint, Directory, ResultsError};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

/// Saves the counts of a run while it continues, and passes its progress on.
pub(super) struct Saver<'a> {
    directory: &'a Directory,
    /// The state to save, apart from the counts.
    state: &'a Checkpoint,
    counts: &'a Mutex<Counts>,
    period: Duration,
    start: Instant,
    last: Mutex<Instant>,
    error: OnceLock<ResultsError>,
    progress: &'a dyn Progress,
}

impl<'a> Saver<'a> {
    pub fn new(
        directory: &'a Directory,
        state: &'a Checkpoint,
        counts: &'a Mutex<Counts>,
        period: Duration,
        progress: &'a dyn Progress,
    ) -> Self {
        let start = Instant::now();
        Self {
            directory,
            state,
            counts,
            period,
            start,
            last: Mutex::new(start),
            error: OnceLock::new(),
            progress,
        }
    }

    /// Returns the first error that occurred while saving the counts.
    pub fn finish(self) -> Result<(), ResultsError> {
        self.error.into_inner().map_or(Ok(()), Err)
    }

    fn save(&self) -> Result<bool, ResultsError> {
        let counts = self
            .counts
            .lock()
            .expect("nobody panics with the counts")
            .clone();
        self.directory.save(&Checkpoint {
            counts,
            seconds: self.state.seconds + self.start.elapsed().as_secs_f64(),
            ..self.state.clone()
        })
    }
}

impl Progress for Saver<'_> {
    fn done(&self, work: u64) {
        self.progress.done(work);
        // If another thread is saving, this thread goes back to simulating instead of waiting.
        let Ok(mut last) = self.last.try_lock() else {
            return;
        };
        if last.elapsed() < self.period || self.error.get().is_some() {
            return;
        }
        let saved = self.save();
        // The period starts after the save, so that slow storage leaves time to simulate.
        *last = Instant::now();
        match saved {
            Ok(_) => self.progress.saved(),
            Err(error) => drop(self.error.set(error)),
        }
    }

    fn is_stopped(&self) -> bool {
        self.error.get().is_some() || self.progress.is_stopped()
    }
}
