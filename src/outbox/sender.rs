//! The way to the listener: connect, ask what it has, send what comes after that, and hear what it has stored.

use super::notice::{Notice, Trouble};
use super::state::{Phase, Shared};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::str;
use std::thread;
use std::time::{Duration, Instant};

/// About so many bytes are sent at once.
const BATCH: usize = 1 << 16;

/// The most bytes that a number and its line take.
const LONGEST: u64 = 64;

/// Sends what waits, over one connection after another, until the state is closed.
pub(super) fn run(shared: &Shared) {
    let timing = shared.timing;
    let mut sender = Sender {
        shared,
        delay: timing.first,
        told: None,
    };
    while let Err(trouble) = sender.connection() {
        sender.tell(trouble);
        sender.pause();
    }
}

struct Sender<'a> {
    shared: &'a Shared,
    /// Before the next attempt.
    delay: Duration,
    /// What was told last, if the listener has not been reached since.
    told: Option<String>,
}

impl Sender<'_> {
    /// Tells what is wrong, once as long as that does not change.
    fn tell(&mut self, trouble: Trouble) {
        let text = trouble.to_string();
        let (is_closed, spool) = {
            let state = self.shared.lock();
            (state.phase == Phase::Closed, state.spool.path().to_owned())
        };
        if is_closed || self.told.as_ref() == Some(&text) {
            return;
        }
        self.told = Some(text);
        let address = self.shared.address.clone();
        (self.shared.tell)(Notice::Trouble {
            address,
            trouble,
            spool,
        });
    }

    /// The listener has stored something, or has everything.
    fn succeed(&mut self) {
        self.delay = self.shared.timing.first;
        if self.told.take().is_some() {
            (self.shared.tell)(Notice::Again(self.shared.address.clone()));
        }
    }

    /// Waits before the next attempt. Where the program is about to end there is no time for long pauses.
    fn pause(&mut self) {
        let state = self.shared.lock();
        let phase = state.phase;
        let state = self
            .shared
            .wait(state, self.delay, |state| state.phase == phase);
        self.delay = if state.phase == phase {
            (2 * self.delay).min(self.shared.timing.most)
        } else {
            self.shared.timing.first
        };
    }

    /// One connection. It ends well once the state is closed.
    fn connection(&mut self) -> Result<(), Trouble> {
        if self.shared.lock().phase == Phase::Closed {
            return Ok(());
        }
        let timing = self.shared.timing;
        let stream = self
            .shared
            .address
            .connect(timing.connect)
            .map_err(Trouble::Unreachable)?;
        // A listener that reads nothing must not hold the thread for ever. Small lines are to arrive at once.
        let set = stream
            .set_write_timeout(Some(timing.answer))
            .and_then(|()| stream.set_nodelay(true));
        set.map_err(Trouble::Broken)?;
        let shared = self.shared;
        shared.change(|state| (state.heard, state.ended) = (None, None));
        thread::scope(|scope| {
            scope.spawn(|| listen(shared, &stream));
            let ended = self.converse(&stream);
            // The other thread waits for what the listener sends; this ends it.
            let _ = stream.shutdown(Shutdown::Both);
            ended
        })
    }

    fn converse(&mut self, stream: &TcpStream) -> Result<(), Trouble> {
        let stream_name = self.shared.lock().spool.stream().to_owned();
        send(
            stream,
            &format!("{{\"event\":\"stream\",\"stream\":\"{stream_name}\"}}\n"),
        )?;
        let Some(held) = self.first_answer()? else {
            return Ok(());
        };
        let mut link = Link {
            sent: held,
            since: Instant::now(),
        };
        while let Some(text) = self.next(&mut link)? {
            send(stream, &text)?;
        }
        Ok(())
    }

    /// What the listener has of the stream; none where the state is closed.
    fn first_answer(&mut self) -> Result<Option<u64>, Trouble> {
        let patience = self.shared.timing.answer;
        let state = self.shared.lock();
        let mut state = self.shared.wait(state, patience, |state| {
            state.heard.is_none() && state.ended.is_none() && state.phase != Phase::Closed
        });
        if state.phase == Phase::Closed {
            return Ok(None);
        }
        let Some(held) = state.heard.take() else {
            return Err(state.ended.take().unwrap_or(Trouble::Silent(patience)));
        };
        if !state.spool.resume(held) {
            let last = state.spool.last();
            return Err(Trouble::Ahead { said: held, last });
        }
        let has_all = state.spool.waiting() == 0;
        drop(state);
        self.shared.changed.notify_all();
        if has_all {
            self.succeed();
        }
        Ok(Some(held))
    }

    /// What is to be sent next, once there is something; none where the state is closed.
    fn next(&mut self, link: &mut Link) -> Result<Option<String>, Trouble> {
        let patience = self.shared.timing.answer;
        let mut state = self.shared.lock();
        loop {
            if state.phase == Phase::Closed {
                return Ok(None);
            }
            if let Some(said) = state.heard.take() {
                if said > link.sent {
                    return Err(Trouble::Ahead {
                        said,
                        last: link.sent,
                    });
                }
                if state.spool.acknowledge(said) {
                    link.since = Instant::now();
                    drop(state);
                    self.shared.changed.notify_all();
                    self.succeed();
                    state = self.shared.lock();
                    continue;
                }
            }
            if let Some(trouble) = state.ended.take() {
                return Err(trouble);
            }
            let is_waiting = state.spool.after() < link.sent;
            if !is_waiting {
                link.since = Instant::now();
            }
            if link.since.elapsed() >= patience {
                return Err(Trouble::Silent(patience));
            }
            if let Some((text, last)) = state.spool.batch(link.sent, BATCH) {
                link.sent = last;
                return Ok(Some(text));
            }
            let sent = link.sent;
            state = self.shared.wait(
                state,
                patience.saturating_sub(link.since.elapsed()),
                |state| {
                    let has_news =
                        state.heard.is_some() || state.ended.is_some() || state.spool.last() > sent;
                    !has_news && state.phase != Phase::Closed
                },
            );
        }
    }
}

/// How far one connection is.
struct Link {
    /// The last number that the listener has or was sent.
    sent: u64,
    /// When everything was acknowledged, or something new was.
    since: Instant,
}

fn send(mut stream: &TcpStream, text: &str) -> Result<(), Trouble> {
    stream.write_all(text.as_bytes()).map_err(Trouble::Broken)
}

/// Passes on the numbers that the listener sends.
fn listen(shared: &Shared, stream: &TcpStream) {
    let mut reader = BufReader::new(stream);
    let ended = loop {
        match number(&mut reader) {
            Ok(number) => shared.change(|state| state.heard = Some(number)),
            Err(trouble) => break trouble,
        }
    };
    shared.change(|state| state.ended = Some(ended));
}

/// The next number. Half of one, cut off by the end of the connection, is none.
fn number(reader: &mut impl BufRead) -> Result<u64, Trouble> {
    let mut line = Vec::new();
    let mut limited = reader.by_ref().take(LONGEST);
    match limited.read_until(b'\n', &mut line) {
        Err(error) if error.kind() != io::ErrorKind::ConnectionReset => {
            return Err(Trouble::Broken(error));
        }
        Ok(_) if limited.limit() == 0 || line.ends_with(b"\n") => {}
        _ => return Err(Trouble::Closed),
    }
    let text = str::from_utf8(&line)
        .ok()
        .and_then(|text| text.strip_suffix('\n'));
    text.and_then(|text| text.trim().parse().ok())
        .ok_or_else(|| Trouble::Confused(String::from_utf8_lossy(&line).trim_end().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(mut text: &[u8]) -> Vec<Result<u64, String>> {
        let mut all = Vec::new();
        while all.last().is_none_or(Result::is_ok) {
            all.push(number(&mut text).map_err(|trouble| trouble.to_string()));
        }
        all
    }

    #[test]
    fn half_a_number_is_none() {
        let closed = || Err(Trouble::Closed.to_string());
        assert_eq!(heard(b"0\n12\r\n 7 \n"), [Ok(0), Ok(12), Ok(7), closed()]);
        assert_eq!(heard(b"5\n12"), [Ok(5), closed()]);
        assert_eq!(heard(b""), [closed()]);
    }

    #[test]
    fn what_is_no_number_is_shown() {
        for text in ["x\n", "\n", "1.5\n", "-1\n", "\u{1b}[2J\n"] {
            let heard = heard(text.as_bytes());
            let shown = format!("got {:?}", text.trim());
            assert!(heard[0].as_ref().unwrap_err().contains(&shown), "{heard:?}");
        }
        // Without an end it is not read on.
        assert!(
            heard(&[b'1'; 1 << 20])[0]
                .as_ref()
                .is_err_and(|text| text.len() < 300)
        );
    }
}
