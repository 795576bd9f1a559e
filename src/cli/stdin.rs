//! Standard input that can be left at the end of a line, so that what nobody has read is there for the next reader.

use super::signals::Signals;
use std::io::{self, Read};
use std::time::{Duration, Instant};

/// For how long a signal waits for the end of a line.
const PATIENCE: Duration = Duration::from_secs(2);

/// Standard input, which ends at the end of a line once a signal came, or fails if that does not.
pub struct Stdin<'a> {
    input: Source,
    signals: Option<&'a Signals>,
    is_at_line_end: bool,
    /// When it saw that a signal came.
    told: Option<Instant>,
}

#[cfg(unix)]
type Source = std::fs::File;
#[cfg(not(unix))]
type Source = io::Stdin;

impl<'a> Stdin<'a> {
    /// All of it, or until one of the signals.
    pub fn new(signals: Option<&'a Signals>) -> io::Result<Self> {
        Ok(Self {
            input: source()?,
            signals,
            is_at_line_end: true,
            told: None,
        })
    }
}

impl Read for Stdin<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let Some(signals) = self.signals else {
            return self.input.read(buffer);
        };
        loop {
            let is_told = signals.came().is_some();
            if is_told && self.is_at_line_end {
                return Ok(0);
            }
            if is_told && self.told.get_or_insert_with(Instant::now).elapsed() > PATIENCE {
                return Err(io::Error::new(
                    io::ErrorKind::TimedOut,
                    "ends in the middle of a line, which is lost (a signal came, and the rest of the line did not)",
                ));
            }
            if !is_ready(&self.input)? {
                continue;
            }
            // No more than the rest of the line, once it was told.
            let most = if is_told { 1 } else { buffer.len() };
            let read = self.input.read(&mut buffer[..most])?;
            if read > 0 {
                self.is_at_line_end = buffer[read - 1] == b'\n';
            }
            return Ok(read);
        }
    }
}

/// Without the buffer of the standard library, whose content would be lost for the next reader.
#[cfg(unix)]
fn source() -> io::Result<Source> {
    use std::os::fd::AsFd;
    Ok(io::stdin().as_fd().try_clone_to_owned()?.into())
}

#[cfg(not(unix))]
fn source() -> io::Result<Source> {
    Ok(io::stdin())
}

/// Waits until something can be read, but no longer than a signal may wait.
#[cfg(unix)]
fn is_ready(input: &Source) -> io::Result<bool> {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    let wait = Timespec {
        tv_sec: 0,
        tv_nsec: 100_000_000,
    };
    match poll(&mut [PollFd::new(input, PollFlags::IN)], Some(&wait)) {
        Ok(ready) => Ok(ready > 0),
        Err(rustix::io::Errno::INTR) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(unix))]
fn is_ready(_: &Source) -> io::Result<bool> {
    Ok(true)
}
