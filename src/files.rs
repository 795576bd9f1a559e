//! Files that appear whole or not at all: written beside their place, synced, and moved into it.
//!
//! The name of a draft is new and a move replaces a symbolic link, not what it points to: a planted link is never
//! followed.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::{
    thread,
    time::{Duration, Instant},
};
use tempfile::{Builder, NamedTempFile};

/// What the name of every draft begins with.
const PREFIX: &str = ".liftsim-part";

/// A complete file that is not yet in its place. Dropped, it leaves nothing behind.
#[derive(Debug)]
pub struct Draft {
    part: NamedTempFile,
    path: PathBuf,
}

impl Draft {
    /// Writes the content of `path` to a draft.
    ///
    /// # Errors
    /// Where its folder or `content` refuses, or the disk is full.
    pub fn new(
        path: &Path,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> io::Result<Self> {
        let mut builder = Builder::new();
        builder.prefix(PREFIX);
        share(&mut builder);
        let part = builder.tempfile_in(folder(path))?;
        let mut out = BufWriter::new(part.as_file());
        content(&mut out)?;
        out.flush()?;
        drop(out);
        part.as_file().sync_all()?;
        let path = path.to_owned();
        Ok(Self { part, path })
    }

    /// Writes it to `out` instead.
    ///
    /// # Errors
    /// Where it cannot be read again, or `out` refuses.
    pub fn copy_to(mut self, out: &mut impl Write) -> io::Result<()> {
        self.part.rewind()?;
        io::copy(&mut self.part, out)?;
        out.flush()
    }

    /// Moves it to its path, over whatever is there.
    ///
    /// # Errors
    /// Where the file system refuses; what was there is then whole.
    pub fn replace(self) -> io::Result<()> {
        self.part.persist(&self.path)?;
        sync(folder(&self.path))
    }

    /// Moves it to its path, where nothing may be.
    ///
    /// # Errors
    /// Where a file exists there, or the file system refuses.
    pub fn create_new(self) -> io::Result<()> {
        self.part.persist_noclobber(&self.path)?;
        sync(folder(&self.path))
    }
}

/// Opens a file to be read. To open a pipe would wait for somebody who writes to it: where nobody does for three
/// seconds, reading it fails.
///
/// # Errors
/// Where it cannot be opened.
#[cfg(unix)]
pub fn open(path: &Path) -> io::Result<Box<dyn Read>> {
    use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
    if !fs::metadata(path)?.file_type().is_fifo() {
        return Ok(Box::new(File::open(path)?));
    }
    let mut options = File::options();
    let without_waiting = rustix::fs::OFlags::NONBLOCK.bits() as i32;
    let file = options
        .read(true)
        .custom_flags(without_waiting)
        .open(path)?;
    Ok(Box::new(Pipe {
        file,
        is_written: false,
        until: Instant::now() + Duration::from_secs(3),
    }))
}

/// Opens a file to be read.
///
/// # Errors
/// Where it cannot be opened.
#[cfg(not(unix))]
pub fn open(path: &Path) -> io::Result<Box<dyn Read>> {
    Ok(Box::new(File::open(path)?))
}

/// A pipe that is looked at every few milliseconds.
#[cfg(unix)]
struct Pipe {
    file: File,
    /// Whether there was anybody who writes.
    is_written: bool,
    until: Instant,
}

#[cfg(unix)]
impl Read for Pipe {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.file.read(buffer) {
                Ok(0) if !self.is_written => {
                    if Instant::now() > self.until {
                        let nobody = "it is a pipe that nobody writes to";
                        return Err(io::Error::new(io::ErrorKind::TimedOut, nobody));
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => self.is_written = true,
                read => {
                    self.is_written = true;
                    return read;
                }
            }
            thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Writes a file over whatever is there.
///
/// # Errors
/// Where it cannot be written; what was there is then whole.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    Draft::new(path, |out| out.write_all(bytes))?.replace()
}

/// Removes the drafts of processes that were killed. Nobody else may be writing in `folder`.
///
/// # Errors
/// Where one is there and cannot be removed.
pub fn remove_drafts(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name().to_string_lossy().starts_with(PREFIX) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// The folder that a file is in.
pub(crate) fn folder(path: &Path) -> &Path {
    let parent = path.parent();
    parent
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// A temporary file is its owner's alone; a result has the permissions of any other file.
#[cfg(unix)]
fn share(builder: &mut Builder) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn share(_: &mut Builder) {}

/// Makes a move durable.
#[cfg(unix)]
pub(crate) fn sync(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// A folder cannot be opened here, and need not be.
#[cfg(not(unix))]
pub(crate) fn sync(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// The disk fills up half way: what was there is whole, and nothing is left behind.
    #[test]
    fn a_failure_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, "old").unwrap();
        let full = |out: &mut BufWriter<&File>| {
            out.write_all(&[0; 1 << 16])?;
            Err(io::ErrorKind::StorageFull.into())
        };
        assert!(Draft::new(&path, full).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["file"]);
    }

    #[test]
    fn what_is_there_is_replaced_only_when_asked() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let draft = |text: &'static str| Draft::new(&path, |out| out.write_all(text.as_bytes()));
        draft("one").unwrap().create_new().unwrap();
        assert!(draft("two").unwrap().create_new().is_err());
        assert_eq!(fs::read(&path).unwrap(), b"one");
        draft("two").unwrap().replace().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        drop(draft("three").unwrap());
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["file"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let [path, precious] = ["file", "precious"].map(|name| folder.path().join(name));
        fs::write(&precious, "old").unwrap();
        symlink(&precious, &path).unwrap();
        let draft = || Draft::new(&path, |out| out.write_all(b"new")).unwrap();
        assert!(draft().create_new().is_err());
        draft().replace().unwrap();
        assert_eq!(fs::read(&precious).unwrap(), b"old");
        assert_eq!(fs::read(&path).unwrap(), b"new");
        let mode = |path| fs::symlink_metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&path), mode(&precious), "as any other file");
    }

    /// A pipe is read to its end, however late that is written; and one that nobody writes to does not hang.
    #[cfg(unix)]
    #[test]
    fn pipes_do_not_hang() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&path).status();
        assert!(made.unwrap().success());
        let read = || {
            let mut text = String::new();
            open(&path)?.read_to_string(&mut text).map(|_| text)
        };
        let writer = thread::spawn({
            let path = path.clone();
            move || {
                let mut pipe = File::options().write(true).open(path).unwrap();
                for part in ["one ", "two"] {
                    thread::sleep(Duration::from_millis(100));
                    pipe.write_all(part.as_bytes()).unwrap();
                }
            }
        });
        assert_eq!(read().unwrap(), "one two");
        writer.join().unwrap();
        let nobody = read().unwrap_err().to_string();
        assert_eq!(nobody, "it is a pipe that nobody writes to");
    }

    #[test]
    fn drafts_of_the_dead_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(".liftsim-partAbCdEf"), "half").unwrap();
        fs::write(folder.path().join("points.csv"), "whole").unwrap();
        remove_drafts(folder.path()).unwrap();
        assert_eq!(names(folder.path()), ["points.csv"]);
    }
}
