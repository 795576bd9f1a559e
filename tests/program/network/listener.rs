//! A listener that keeps to the protocol, and is rude as asked: it cuts connections, stops, and acknowledges late.

use serde_json::Value;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than anything takes on a busy machine.
pub const LONG: Duration = Duration::from_secs(120);

/// What a listener stores of one stream, and outlives it.
#[derive(Clone, Default)]
pub struct Store(Arc<Mutex<Stored>>);

#[derive(Default)]
pub struct Stored {
    pub stream: String,
    /// The lines, without their numbers.
    pub lines: Vec<String>,
    /// The number of the last of them.
    pub last: u64,
    /// What was not as agreed.
    pub faults: Vec<String>,
}

/// How a connection ends.
#[derive(Clone, Copy, Debug)]
enum Cut {
    /// By the monitor.
    Never,
    Unanswered,
    /// In the middle of the answer.
    HalfAnswered,
    /// After so many bytes from the monitor, with every so-manieth line acknowledged.
    After {
        bytes: u64,
        every: u64,
    },
}

/// Knuth's generator.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn below(&mut self, below: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) % below
    }
}

/// Waits until something is the case.
pub fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < LONG, "{what}");
        thread::sleep(Duration::from_millis(2));
    }
}

/// A port of this address at which nobody listens.
pub fn free(address: &str) -> io::Result<SocketAddr> {
    TcpListener::bind((address, 0))?.local_addr()
}

/// Listens there, once nobody else does.
fn bind(address: SocketAddr) -> TcpListener {
    let mut listener = None;
    wait_until("the port stays taken", || {
        listener = TcpListener::bind(address).ok();
        listener.is_some()
    });
    listener.unwrap()
}

impl Store {
    pub fn get(&self) -> MutexGuard<'_, Stored> {
        self.0.lock().unwrap()
    }

    /// Serves connections until it has so many lines, and stops listening.
    pub fn until(&self, address: SocketAddr, lines: usize) {
        let listener = bind(address);
        while self.get().lines.len() < lines {
            let (stream, _) = listener.accept().unwrap();
            let _ = self.converse(&stream, Cut::Never, lines);
        }
    }

    /// Serves every connection well.
    pub fn serve(&self, address: SocketAddr) {
        let store = self.clone();
        let listener = bind(address);
        thread::spawn(move || {
            for stream in listener.incoming() {
                let _ = store.converse(&stream.unwrap(), Cut::Never, usize::MAX);
            }
        });
    }

    /// Cuts so many connections, in all ways and at random bytes, and serves well from then on. Returns how many it
    /// has cut so far.
    pub fn cut(&self, address: SocketAddr, cuts: usize, seed: u64) -> Arc<AtomicUsize> {
        let (store, cut) = (self.clone(), Arc::new(AtomicUsize::new(0)));
        let counted = cut.clone();
        let mut listener = Some(bind(address));
        thread::spawn(move || {
            let mut random = Random::new(seed);
            while counted.load(Ordering::SeqCst) < cuts {
                let (stream, _) = listener
                    .get_or_insert_with(|| bind(address))
                    .accept()
                    .unwrap();
                let how = match random.below(10) {
                    0 => Cut::Unanswered,
                    1 => Cut::HalfAnswered,
                    _ => Cut::After {
                        bytes: random.below(1500),
                        every: [1, 1, 3, 1000][random.below(4) as usize],
                    },
                };
                if random.below(4) == 0 {
                    // Others find nobody there.
                    listener = None;
                }
                let _ = store.converse(&stream, how, usize::MAX);
                drop(stream);
                if listener.is_none() {
                    thread::sleep(Duration::from_millis(random.below(30)));
                }
                counted.fetch_add(1, Ordering::SeqCst);
            }
            drop(listener);
            store.serve(address);
        });
        cut
    }

    /// One connection, until it is cut, or so many lines are stored.
    fn converse(&self, stream: &TcpStream, cut: Cut, most: usize) -> io::Result<()> {
        let limit = match cut {
            Cut::After { bytes, .. } => bytes,
            _ => u64::MAX,
        };
        let (mut answers, mut lines) = (stream, BufReader::new(stream.take(limit)));
        let Some(hello) = line(&mut lines)? else {
            return Ok(());
        };
        let held = self.begin(&hello).to_string();
        match cut {
            Cut::Unanswered => return Ok(()),
            Cut::HalfAnswered => {
                return answers.write_all(&held.as_bytes()[..held.len().div_ceil(2)]);
            }
            _ => writeln!(answers, "{held}")?,
        }
        while self.get().lines.len() < most
            && let Some(line) = line(&mut lines)?
        {
            let last = self.store(&line);
            match cut {
                Cut::After { every, .. } if !last.is_multiple_of(every) => {}
                _ => writeln!(answers, "{last}")?,
            }
        }
        Ok(())
    }

    /// The number of the last line of this stream.
    fn begin(&self, hello: &str) -> u64 {
        let hello: Value = serde_json::from_str(hello).unwrap_or_default();
        let stream = hello["stream"].as_str().unwrap_or_default();
        let mut stored = self.get();
        if stored.stream.is_empty() {
            stored.stream = stream.to_owned();
        }
        if hello["event"] != "stream" || stored.stream != stream {
            let fault = format!("{hello} after stream {}", stored.stream);
            stored.faults.push(fault);
        }
        stored.last
    }

    /// Stores a line, which must be the next one.
    fn store(&self, line: &str) -> u64 {
        let mut stored = self.get();
        let object: Value = serde_json::from_str(line).unwrap_or_default();
        let number = object["sequence"].as_u64().unwrap_or_default();
        let lacking = object["lines"].as_u64().unwrap_or_default();
        if number != stored.last + 1 && (lacking == 0 || number != stored.last + lacking) {
            let last = stored.last;
            stored.faults.push(format!("{line} after line {last}"));
        }
        let unnumbered = line.replacen(&format!("\"sequence\":{number},"), "", 1);
        stored.lines.push(unnumbered);
        stored.last = number;
        number
    }
}

/// The next line, without its end; none if that is cut off.
fn line(lines: &mut impl BufRead) -> io::Result<Option<String>> {
    let mut line = String::new();
    lines.read_line(&mut line)?;
    Ok(line.strip_suffix('\n').map(str::to_owned))
}
