//! A queue of numbered lines that outlives the program: in memory, and in a file from which it is read again.
//!
//! A line is in the file once [`Spool::push`] returns, so that it outlives the program, however that ends. Of what is
//! acknowledged nothing is noted there: the listener says what it holds whenever it is reached, and the file is
//! written anew where it would get too long.

use super::journal::Journal;
use super::open::{Problem, SpoolError, content, lock};
use super::record::{self, OVERHEAD, header, record};
use std::collections::VecDeque;
use std::fs::File;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};

/// What acknowledged lines may take in the file where nothing waits, bytes.
const LITTER: u64 = 1 << 16;

/// The largest number of a line: JSON's numbers are read exactly up to it everywhere.
const LAST: u64 = 1 << 53;

/// Lines that wait, numbered from 1.
#[derive(Debug)]
pub struct Spool {
    stream: String,
    /// The number of the last line that no longer waits.
    after: u64,
    lines: VecDeque<Box<str>>,
    /// What the lines take in the file at most, bytes.
    size: u64,
    /// The most that the file takes, bytes.
    most: u64,
    /// The number of the last line in the file.
    written: u64,
    /// The last number that was known when it was opened, until a listener has been reached.
    opened: Option<u64>,
    journal: Journal,
    /// Whether the last news was that writing failed.
    is_told_failed: bool,
    /// Held as long as others are kept out, where the file system knows locks.
    lock: Option<File>,
}

/// What became of a change.
#[derive(Debug, Default)]
pub(super) struct Saved {
    /// How many of the oldest lines were dropped.
    pub dropped: u64,
    /// Whether writing failed or, after that, succeeded, if that is news.
    pub news: Option<io::Result<()>>,
}

impl Spool {
    /// Opens a spool, or begins one where there is none, of so many bytes at most. Returns too how many bytes at its
    /// end were half written and are left out.
    ///
    /// # Errors
    /// Where another program uses it, or it cannot be read, or is none. What is there is left as it is.
    pub fn open(path: &Path, most: u64) -> Result<(Self, u64), SpoolError> {
        Self::opened(path, most).map_err(|problem| SpoolError {
            path: path.to_owned(),
            problem,
        })
    }

    fn opened(path: &Path, most: u64) -> Result<(Self, u64), Problem> {
        // The place that a link leads to, for the file is replaced now and then.
        let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let lock = lock(&path)?;
        let Some(bytes) = content(&path)? else {
            return Ok((Self::begin(path, most, lock), 0));
        };
        let contents = record::read(&bytes)?;
        let whole = contents.whole as u64;
        let last = contents.after + contents.lines.len() as u64;
        let spool = Self {
            stream: contents.stream,
            after: contents.after,
            size: contents.lines.iter().map(|line| cost(line)).sum(),
            lines: contents.lines,
            most,
            written: last,
            opened: Some(last),
            journal: Journal::open(path, whole)?,
            is_told_failed: false,
            lock,
        };
        Ok((spool, bytes.len() as u64 - whole))
    }

    /// A spool of a new stream. Where the disk is full it waits in memory, as later.
    fn begin(path: PathBuf, most: u64, lock: Option<File>) -> Self {
        let mut spool = Self {
            stream: format!("{:016x}", RandomState::new().build_hasher().finish()),
            after: 0,
            lines: VecDeque::new(),
            size: 0,
            most,
            written: 0,
            opened: Some(0),
            journal: Journal::new(path),
            is_told_failed: false,
            lock,
        };
        // Told with the first line.
        let _ = spool.rewrite();
        spool
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.journal.path()
    }

    /// The name of the stream, which is in the file: who opens it goes on with the stream.
    pub(super) fn stream(&self) -> &str {
        &self.stream
    }

    /// How many lines wait.
    pub fn waiting(&self) -> u64 {
        self.lines.len() as u64
    }

    /// How many of them are not in the file.
    pub(super) fn unwritten(&self) -> u64 {
        self.last() - self.written.clamp(self.after, self.last())
    }

    pub(super) fn last(&self) -> u64 {
        self.after + self.waiting()
    }

    pub(super) fn after(&self) -> u64 {
        self.after
    }

    /// Adds a line.
    pub(super) fn push(&mut self, line: &str) -> Saved {
        self.size += cost(line);
        self.lines.push_back(line.into());
        if self.journal.rests() {
            return self.keep_small(self.size > self.most);
        }
        self.save()
    }

    /// Writes what is not in the file. Where that fails the lines wait in memory only, until it succeeds.
    pub(super) fn save(&mut self) -> Saved {
        let new = self.records(self.written.max(self.after));
        let is_full = self.size.max(self.journal.length() + new.len() as u64) > self.most;
        let mut saved = self.keep_small(is_full);
        let written = if is_full || self.written < self.after || self.journal.length() == 0 {
            self.rewrite()
        } else {
            let appended = self.journal.append(&new);
            appended.map(|()| self.written = self.last())
        };
        if self.is_told_failed != written.is_err() {
            self.is_told_failed = written.is_err();
            saved.news = Some(written);
        }
        saved
    }

    /// Whether the file lacks lines because writing failed.
    pub(super) fn has_failed(&self) -> bool {
        self.journal.has_failed()
    }

    /// A failure that is over may be tried again.
    pub(super) fn is_due(&self) -> bool {
        self.has_failed() && !self.journal.rests()
    }

    /// Where it is full, drops the oldest down to three quarters, so that the file is not written anew for every line.
    fn keep_small(&mut self, is_full: bool) -> Saved {
        let mut saved = Saved::default();
        while is_full && self.size > self.most / 4 * 3 && self.waiting() > 1 {
            self.forget_first();
            saved.dropped += 1;
        }
        saved
    }

    fn forget_first(&mut self) {
        if let Some(line) = self.lines.pop_front() {
            self.size -= cost(&line);
            self.after += 1;
        }
    }

    fn rewrite(&mut self) -> io::Result<()> {
        let text = header(&self.stream, self.after) + &self.records(self.after);
        self.journal.replace(&text)?;
        self.written = self.last();
        Ok(())
    }

    /// The text in the file of the lines after a number.
    fn records(&self, after: u64) -> String {
        self.since(after)
            .map(|(number, line)| record(number, line))
            .collect()
    }

    /// The lines after a number that wait, with their numbers.
    fn since(&self, after: u64) -> impl Iterator<Item = (u64, &str)> {
        let from = after.max(self.after);
        let skipped = (from - self.after).min(self.waiting()) as usize;
        (from + 1..).zip(self.lines.range(skipped..).map(|line| &**line))
    }

    /// A listener was reached that holds the lines up to a number. Returns false if there cannot be so many.
    ///
    /// It may hold more than the spool has if that could not be written, or was lost in a power cut. Then the lines
    /// since this spool was opened, which nobody has seen, are numbered after those.
    pub(super) fn resume(&mut self, held: u64) -> bool {
        match self.opened {
            Some(opened) if held > opened && held < LAST => {
                self.acknowledge(opened);
                self.after = held;
                self.written = 0;
                // In the file before any is sent, so that no later answer is about other numbers.
                let _ = self.rewrite();
            }
            _ if held > self.last() => return false,
            _ => drop(self.acknowledge(held)),
        }
        self.opened = None;
        true
    }

    /// Forgets the lines up to a number. Returns whether there were any.
    pub(super) fn acknowledge(&mut self, number: u64) -> bool {
        let before = self.after;
        while self.after < number && !self.lines.is_empty() {
            self.forget_first();
        }
        if self.lines.is_empty() && self.journal.length() > LITTER && !self.has_failed() {
            // If that fails, it is told with the next line.
            let _ = self.rewrite();
        }
        self.after > before
    }

    /// What a listener that has the lines up to a number is to be sent next, about so many bytes, and the number that
    /// it then has. What it lacks and no longer waits was dropped, and a line says so in its place.
    pub(super) fn batch(&self, has: u64, size: usize) -> Option<(String, u64)> {
        let (mut text, mut last) = (String::new(), has);
        if has < self.after {
            last = self.after;
            text = format!(
                "{{\"sequence\":{last},\"event\":\"dropped\",\"lines\":{}}}\n",
                last - has
            );
        }
        for (number, line) in self.since(last) {
            if text.len() >= size {
                break;
            }
            let fields = line.strip_prefix('{').unwrap_or(line);
            text += &format!("{{\"sequence\":{number},{fields}\n");
            last = number;
        }
        (last > has).then_some((text, last))
    }

    /// The file, if something in it is not yet safe from a power cut.
    pub(super) fn take_unsynced(&mut self) -> Option<File> {
        self.journal.take_unsynced()
    }

    /// Leaves in the file what waits and nothing else, and lets others use it.
    pub(super) fn close(&mut self) {
        // What fails leaves the file as it was, and `unwritten` says how much it lacks.
        let _ = self
            .rewrite()
            .or_else(|_| self.save().news.unwrap_or(Ok(())));
        // Not by closing it alone: where a child process is just being started, that has the file open too.
        let _ = self.lock.take().map(|lock| lock.unlock());
    }

    #[cfg(all(test, target_os = "linux"))]
    pub(super) fn journal(&mut self) -> &mut Journal {
        &mut self.journal
    }
}

/// What a line takes in the file at most, bytes.
fn cost(line: &str) -> u64 {
    (line.len() + OVERHEAD) as u64
}
