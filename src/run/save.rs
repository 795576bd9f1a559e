//! Saves a run while it goes on.

use super::Progress;
use crate::counts::Counts;
use crate::results::{Checkpoint, Directory, ResultsError};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Saves a run while it goes on, and passes on its progress.
pub(super) struct Saver<'a> {
    directory: &'a Directory,
    /// All but the counts.
    state: &'a Checkpoint,
    counts: &'a Mutex<Counts>,
    period: Duration,
    start: Instant,
    last: Mutex<Instant>,
    failed: AtomicBool,
    error: Mutex<Option<ResultsError>>,
    progress: &'a dyn Progress,
}

const NO_PANIC: &str = "nobody panics with the lock";

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
            failed: AtomicBool::new(false),
            error: Mutex::new(None),
            progress,
        }
    }

    /// What kept the counts from being saved.
    pub fn finish(self) -> Result<(), ResultsError> {
        let error = self.error.into_inner().expect(NO_PANIC);
        error.map_or(Ok(()), Err)
    }

    fn save(&self) -> Result<bool, ResultsError> {
        let counts = self.counts.lock().expect(NO_PANIC).clone();
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
        // Whoever finds another at it goes on simulating.
        let Ok(mut last) = self.last.try_lock() else {
            return;
        };
        if last.elapsed() < self.period || self.failed.load(Ordering::Relaxed) {
            return;
        }
        let saved = self.save();
        *last = Instant::now();
        match saved {
            Ok(_) => self.progress.saved(),
            Err(error) => {
                *self.error.lock().expect(NO_PANIC) = Some(error);
                self.failed.store(true, Ordering::Relaxed);
            }
        }
    }

    fn is_stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.progress.is_stopped()
    }
}
