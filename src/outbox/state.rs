//! What the threads of an outbox share.

use super::address::Address;
use super::notice::{Notice, Trouble};
use super::spool::{Saved, Spool};
use std::fmt::{self, Debug};
use std::sync::{Condvar, Mutex, MutexGuard};
use std::time::Duration;

/// How long things may take.
#[derive(Clone, Copy, Debug)]
pub struct Timing {
    /// To connect to one address of the host.
    pub connect: Duration,
    /// Until the listener answers or acknowledges something, while something is not acknowledged.
    pub answer: Duration,
    /// Before the first new attempt; before each further one twice as long,
    pub first: Duration,
    /// up to this.
    pub most: Duration,
}

impl Default for Timing {
    fn default() -> Self {
        Self {
            connect: Duration::from_secs(5),
            answer: Duration::from_secs(10),
            first: Duration::from_millis(500),
            most: Duration::from_secs(30),
        }
    }
}

/// How far the program is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// More lines may come.
    Open,
    /// No more come; what waits is sent.
    Ending,
    /// Nothing is sent any more.
    Closed,
}

#[derive(Debug)]
pub(super) struct State {
    pub spool: Spool,
    pub phase: Phase,
    /// The number that the listener sent last, and why nothing more can come from it.
    pub heard: Option<u64>,
    pub ended: Option<Trouble>,
}

pub(super) struct Shared {
    pub address: Address,
    pub timing: Timing,
    pub state: Mutex<State>,
    pub changed: Condvar,
    pub tell: Box<dyn Fn(Notice) + Send + Sync>,
}

impl Debug for Shared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Shared")
            .field("address", &self.address)
            .finish_non_exhaustive()
    }
}

impl Shared {
    pub fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("nobody panics with the spool")
    }

    /// Waits for a time, or until this holds no longer.
    pub fn wait<'a>(
        &self,
        state: MutexGuard<'a, State>,
        most: Duration,
        goes_on: impl FnMut(&mut State) -> bool,
    ) -> MutexGuard<'a, State> {
        let waited = self.changed.wait_timeout_while(state, most, goes_on);
        waited.expect("nobody panics with the spool").0
    }

    /// Changes the state, and says so to all who wait for that.
    pub fn change<T>(&self, change: impl FnOnce(&mut State) -> T) -> T {
        let changed = change(&mut self.lock());
        self.changed.notify_all();
        changed
    }

    /// Changes the spool, and tells what came of it. Once closed it may be another program's.
    pub fn save(&self, change: impl FnOnce(&mut Spool) -> Saved) {
        let (saved, path) = self.change(|state| {
            let saved = match state.phase {
                Phase::Closed => Saved::default(),
                _ => change(&mut state.spool),
            };
            (saved, state.spool.path().to_owned())
        });
        if saved.dropped > 0 {
            (self.tell)(Notice::Full(path.clone(), saved.dropped));
        }
        match saved.news {
            Some(Err(error)) => (self.tell)(Notice::Unwritable(path, error)),
            Some(Ok(())) => (self.tell)(Notice::Writable(path)),
            None => {}
        }
    }
}
