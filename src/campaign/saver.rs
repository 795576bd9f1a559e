//! Saves a run while it goes on.

use super::{NO_PANIC, Witness};
use crate::ledger::Ledger;
use crate::results::{Checkpoint, Directory, ResultsError};
use crate::run::Watch;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Saves a run while it goes on.
pub(super) struct Saver<'a, W> {
    pub directory: &'a Directory,
    /// All but the counters.
    pub state: &'a Checkpoint,
    pub start: Instant,
    pub period: Duration,
    pub last: Mutex<Instant>,
    pub failed: AtomicBool,
    pub error: Mutex<Option<ResultsError>>,
    pub witness: &'a W,
}

impl<W: Witness> Watch for Saver<'_, W> {
    fn counted(&self, work: u64, ledger: &Mutex<Ledger>) {
        self.witness.counted(work);
        // Whoever finds another at it goes on simulating.
        let Ok(mut last) = self.last.try_lock() else {
            return;
        };
        if last.elapsed() < self.period || self.failed.load(Ordering::Relaxed) {
            return;
        }
        let counters = ledger.lock().expect(NO_PANIC).clone();
        let saved = self.directory.save(&Checkpoint {
            counters,
            seconds: self.state.seconds + self.start.elapsed().as_secs_f64(),
            ..self.state.clone()
        });
        *last = Instant::now();
        match saved {
            Ok(()) => self.witness.saved(),
            Err(error) => {
                *self.error.lock().expect(NO_PANIC) = Some(error);
                self.failed.store(true, Ordering::Relaxed);
            }
        }
    }

    fn is_stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.witness.is_stopped()
    }
}
