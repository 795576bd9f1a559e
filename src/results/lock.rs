//! One run at a time in a directory.

use super::{Directory, ResultsError};
use crate::files;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Held by a run as long as it may write into its directory; the system takes it back when the process
/// ends, however it ends.
#[derive(Debug)]
pub struct Lock {
    _handle: Option<File>,
    /// The directories that were not there before, innermost first.
    made: Vec<PathBuf>,
}

impl Drop for Lock {
    /// A run that is refused leaves no empty directory.
    fn drop(&mut self) {
        for path in &self.made {
            if fs::remove_dir(path).is_err() {
                break;
            }
        }
    }
}

impl Directory {
    /// Makes the directory, keeps others from writing into it, and removes what a killed run left half written. On a
    /// file system that knows no locks nobody is kept out.
    ///
    /// # Errors
    /// If another run holds it, or it cannot be made.
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

    /// Whether a run is writing here.
    pub fn is_locked(&self) -> bool {
        let is_held = |handle: io::Result<File>| {
            let shared = handle.map(|handle| handle.try_lock_shared());
            matches!(shared, Ok(Err(TryLockError::WouldBlock)))
        };
        is_held(handle(self.path())) || is_held(File::open(self.path().join(LOCK_FILE)))
    }
}

/// What is locked where a directory cannot be, as on network file systems, which ask for a file open for
/// writing.
const LOCK_FILE: &str = ".liftsim-lock";

fn lock_file(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.create(true).truncate(false).write(true);
    options.open(path.join(LOCK_FILE))
}

/// The directory itself, so that no file is left behind.
#[cfg(unix)]
fn handle(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// A directory has no handle here.
#[cfg(not(unix))]
fn handle(path: &Path) -> io::Result<File> {
    lock_file(path)
}
