//! A lock that allows one run at a time in a directory.

use super::{Directory, ResultsError};
use crate::files;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// A lock held while a run may write into its directory; the system releases it when the process ends,
/// even if it is killed.
#[derive(Debug)]
pub struct Lock {
    _handle: Option<File>,
    /// The directories created for this run, innermost first.
    made: Vec<PathBuf>,
}

impl Drop for Lock {
    /// Removes empty directories that a refused run created.
    fn drop(&mut self) {
        for path in &self.made {
            if fs::remove_dir(path).is_err() {
                break;
            }
        }
    }
}

impl Directory {
    /// Creates the directory, locks it against other runs, and removes the temporary files of a killed run. On a
    /// file system without locks other runs are not kept out.
    ///
    /// # Errors
    /// If another run holds the lock, or the directory cannot be created.
    pub fn lock(&self) -> Result<Lock, ResultsError> {
        let unwritable = |error| self.unwritable(error);
        let paths = self.path().ancestors();
        let is_new = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let made = paths.take_while(is_new).map(Path::to_owned).collect();
        fs::create_dir_all(self.path()).map_err(unwritable)?;
        for open in [handle, lock_file] {
            let handle = open(self.path()).map_err(unwritable)?;
            match handle.try_lock() {
                Ok(()) => {
                    files::remove_drafts(self.path()).map_err(unwritable)?;
                    let _handle = Some(handle);
                    return Ok(Lock { _handle, made });
                }
                Err(TryLockError::WouldBlock) => {
                    let path = self.path().to_owned();
                    return Err(ResultsError::Locked { path });
                }
                Err(TryLockError::Error(_)) => {}
            }
        }
        let _handle = None;
        Ok(Lock { _handle, made })
    }

    /// Whether a run holds the lock.
    pub fn is_locked(&self) -> bool {
        let is_held = |handle: io::Result<File>| {
            let shared = handle.map(|handle| handle.try_lock_shared());
            matches!(shared, Ok(Err(TryLockError::WouldBlock)))
        };
        is_held(handle(self.path())) || is_held(File::open(self.path().join(LOCK_FILE)))
    }
}

/// The file that is locked if the directory itself cannot be, as on network file systems, which lock only
/// files open for writing.
const LOCK_FILE: &str = ".liftsim-lock";

fn lock_file(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.create(true).truncate(false).write(true);
    options.open(path.join(LOCK_FILE))
}

/// Opens the directory itself, so that no lock file is left behind.
#[cfg(unix)]
fn handle(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// Directories cannot be opened on this system.
#[cfg(not(unix))]
fn handle(path: &Path) -> io::Result<File> {
    lock_file(path)
}
