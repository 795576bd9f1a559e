//! Ctrl-C and SIGTERM: the first asks a run to stop, the second ends it.
//!
//! While pilots run or pictures are drawn, the first ends it at once: all counts are saved by then.

use super::Failure;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// While it lives, a signal sets a flag instead of ending the process.
pub struct Signals(&'static Flags);

struct Flags {
    /// Whether the next signal ends the process.
    is_fatal: Arc<AtomicBool>,
    /// The number of the signal that came, or 0.
    came: Arc<AtomicUsize>,
}

static FLAGS: OnceLock<Flags> = OnceLock::new();

impl Signals {
    /// Takes over the signals.
    pub fn watch() -> io::Result<Self> {
        let flags = match FLAGS.get() {
            Some(flags) => flags,
            None => {
                let new = Flags::register()?;
                FLAGS.get_or_init(|| new)
            }
        };
        flags.is_fatal.store(false, Ordering::SeqCst);
        Ok(Self(flags))
    }

    /// The signal that asks to stop.
    pub fn came(&self) -> Option<i32> {
        match self.0.came.load(Ordering::Relaxed) {
            0 => None,
            signal => i32::try_from(signal).ok(),
        }
    }

    /// The end of a run whose counts are saved in `directory`.
    pub fn stopped(&self, directory: &str) -> Failure {
        let signal = self.came().unwrap_or(SIGINT);
        Failure::Stopped {
            // The exit code of a shell for a process that the signal ends.
            code: 128 + u8::try_from(signal).unwrap_or(0),
            message: format!(
                "stopped: what is counted is saved in {directory}; to go on:\n  {}",
                same_command()
            ),
        }
    }
}

impl Drop for Signals {
    fn drop(&mut self) {
        self.0.is_fatal.store(true, Ordering::SeqCst);
    }
}

impl Flags {
    fn register() -> io::Result<Self> {
        let (is_fatal, came) = (Arc::default(), Arc::default());
        for signal in [SIGINT, SIGTERM] {
            // In this order: the first signal finds it not fatal and makes it so for the second.
            flag::register_conditional_default(signal, Arc::clone(&is_fatal))?;
            flag::register(signal, Arc::clone(&is_fatal))?;
            flag::register_usize(signal, Arc::clone(&came), signal as usize)?;
        }
        Ok(Self { is_fatal, came })
    }
}

/// The command that continues this one: the same without --fresh.
fn same_command() -> String {
    let words = std::env::args().filter(|word| word != "--fresh");
    words
        .map(|word| quoted(&word))
        .collect::<Vec<_>>()
        .join(" ")
}

/// As a shell reads it back.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=,:+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
