//! The file behind a spool: lines are added at its end, and now and then it is written anew.

use crate::files;
use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// After a failure the disk is left alone for so long.
const REST: Duration = Duration::from_secs(1);

#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    /// None until the first content is in its place.
    file: Option<File>,
    /// How much of it is whole, bytes.
    length: u64,
    /// When writing failed last, if it has not succeeded since.
    failed: Option<Instant>,
    is_synced: bool,
}

impl Journal {
    /// A file that is not there yet.
    pub fn new(path: PathBuf) -> Self {
        Self {
            path,
            file: None,
            length: 0,
            failed: None,
            is_synced: true,
        }
    }

    /// A file of which so many bytes are whole.
    pub fn open(path: PathBuf, length: u64) -> io::Result<Self> {
        let file = File::options().write(true).open(&path)?;
        Ok(Self {
            file: Some(file),
            length,
            ..Self::new(path)
        })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn length(&self) -> u64 {
        self.length
    }

    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// Whether it failed just now, so that to try again is too early.
    pub fn rests(&self) -> bool {
        self.failed.is_some_and(|failed| failed.elapsed() < REST)
    }

    /// Adds a text at the end.
    pub fn append(&mut self, text: &str) -> io::Result<()> {
        let added = self.add(text);
        self.note(added)
    }

    fn add(&mut self, text: &str) -> io::Result<()> {
        let file = self.file.as_mut().ok_or(io::ErrorKind::NotFound)?;
        // Bytes of a write that failed, or was killed, may follow what is whole.
        file.set_len(self.length)?;
        file.seek(SeekFrom::Start(self.length))?;
        file.write_all(text.as_bytes())?;
        self.length += text.len() as u64;
        self.is_synced = false;
        Ok(())
    }

    /// Puts a text in the place of all. Whenever the program or the machine stops, one of the two is there, whole.
    pub fn replace(&mut self, text: &str) -> io::Result<()> {
        let draft = beside(&self.path, "new");
        let replaced = place(&draft, &self.path, text);
        match replaced {
            Ok(file) => {
                self.file = Some(file);
                self.length = text.len() as u64;
                self.is_synced = true;
                self.note(Ok(()))
            }
            Err(error) => {
                let _ = fs::remove_file(&draft);
                self.note(Err(error))
            }
        }
    }

    fn note(&mut self, result: io::Result<()>) -> io::Result<()> {
        self.failed = result.is_err().then(Instant::now);
        result
    }

    /// The file, if something in it is not yet safe from a power cut; who takes it sees to that.
    pub fn take_unsynced(&mut self) -> Option<File> {
        if self.is_synced {
            return None;
        }
        self.is_synced = true;
        self.file.as_ref()?.try_clone().ok()
    }

    #[cfg(all(test, target_os = "linux"))]
    pub fn fill_disk(&mut self) {
        self.file = File::options().write(true).open("/dev/full").ok();
    }

    #[cfg(all(test, target_os = "linux"))]
    pub fn free_disk(&mut self) {
        self.file = File::options().write(true).open(&self.path).ok();
        self.failed = self.failed.map(|failed| failed - REST);
    }
}

/// A name beside a file. It is always the same, so that what a killed program left is overwritten by the next.
pub(super) fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// Writes a text to a draft and moves it to its path.
fn place(draft: &Path, path: &Path, text: &str) -> io::Result<File> {
    // What is there may be a link; it is removed, not followed.
    let _ = fs::remove_file(draft);
    let mut file = File::options().write(true).create_new(true).open(draft)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    fs::rename(draft, path)?;
    // The file is in its place. That the move outlasts a power cut is tried, and no reason to write it again.
    let _ = files::sync(files::folder(path));
    Ok(file)
}
