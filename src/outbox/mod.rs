//! Lines that reach a listener over a network once each and in order, however often the connection breaks.
//!
//! # The protocol
//! Over TCP, lines of UTF-8 that end in `\n`. The program connects and names its stream:
//! `{"event":"stream","stream":"1f2e3d4c5b6a7988"}`. The listener answers with the number of the last line of that
//! stream that it has stored, 0 if none, as a line by itself. It is sent the lines after that, each a JSON object
//! with its `sequence`, which grows by one, and sends a number again whenever it has stored more: it has all lines up
//! to that one. A line without its `\n` was cut off and does not count. A connection replaces the one before of the same
//! stream: before it answers, the listener has read that to its end or has closed it.
//!
//! A line is forgotten only once it is acknowledged, and sent only to a listener that said it lacks it; so none is lost
//! and none is stored twice. Where the spool was full, or another listener had them, the lines that this one lacks
//! are gone: `{"sequence":57,"event":"dropped","lines":40}` then
//! stands for lines 18 to 57.
//!
//! # What it survives
//! A line is in the file of the spool when [`Outbox::send`] returns, and the file is synced within about a second:
//! the end of the program, by whatever signal, loses nothing that was sent, a power cut what is younger than that.
//! While the disk is full lines wait in memory; then a listener that is reached gets them, and the end of the program
//! loses those that are neither acknowledged nor written.

mod address;
mod journal;
mod notice;
mod open;
mod record;
mod sender;
mod spool;
mod state;
#[cfg(test)]
mod tests;

pub use address::{Address, AddressError};
pub use notice::{Notice, Trouble};
pub use open::{LARGEST, SpoolError};
pub use spool::Spool;
pub use state::Timing;

use state::{Phase, Shared, State};
use std::sync::{Arc, Condvar, Mutex};
use std::thread;
use std::time::Duration;

/// Between two looks at whether the file of the spool is synced.
const SYNC: Duration = Duration::from_secs(1);

/// Lines on their way to a listener.
#[derive(Debug)]
pub struct Outbox {
    shared: Arc<Shared>,
}

/// What had not been delivered at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Left {
    /// Lines that nobody acknowledged.
    pub lines: u64,
    /// How many of them are not in the file of the spool either.
    pub lost: u64,
}

impl Outbox {
    /// Begins to deliver what a spool holds to a listener. What a user should know is told by `tell`, from any thread.
    pub fn start(
        address: Address,
        spool: Spool,
        timing: Timing,
        tell: impl Fn(Notice) + Send + Sync + 'static,
    ) -> Self {
        let state = State {
            spool,
            phase: Phase::Open,
            heard: None,
            ended: None,
        };
        let shared = Arc::new(Shared {
            address,
            timing,
            state: Mutex::new(state),
            changed: Condvar::new(),
            tell: Box::new(tell),
        });
        let [sending, keeping] = [shared.clone(), shared.clone()];
        thread::spawn(move || sender::run(&sending));
        thread::spawn(move || keep(&keeping));
        Self { shared }
    }

    /// Takes a line, a JSON object with fields and without line breaks, to be delivered. Waits for the disk, never
    /// for the network.
    pub fn send(&self, line: &str) {
        self.shared.save(|spool| spool.push(line));
    }

    /// Waits until everything is delivered, so long at most, and ends. What is left is in the spool.
    pub fn finish(self, most: Duration) -> Left {
        self.shared.change(|state| state.phase = Phase::Ending);
        let state = self.shared.lock();
        let mut state = self
            .shared
            .wait(state, most, |state| state.spool.waiting() > 0);
        state.phase = Phase::Closed;
        state.spool.close();
        let left = Left {
            lines: state.spool.waiting(),
            lost: state.spool.unwritten(),
        };
        drop(state);
        self.shared.changed.notify_all();
        left
    }
}

/// Syncs the spool, and writes it once a disk that was full is so no longer.
fn keep(shared: &Shared) {
    loop {
        let state = shared.lock();
        let mut state = shared.wait(state, SYNC, |state| state.phase != Phase::Closed);
        if state.phase == Phase::Closed {
            return;
        }
        let (unsynced, is_due) = (state.spool.take_unsynced(), state.spool.is_due());
        drop(state);
        // Not under the lock: a slow disk must not hold up the samples.
        if let Some(file) = unsynced {
            let _ = file.sync_data();
        }
        if is_due {
            shared.save(|spool| spool.save());
        }
    }
}
