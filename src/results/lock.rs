//! One run at a time in a directory.

use super::{Directory, ResultsError};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;

/// Held by a run as long as it may write into its directory; the system takes it back when the process
/// ends, however it ends.
#[derive(Debug)]
pub struct Lock {
    _handle: Option<File>,
}

impl Directory {
    /// Makes the directory and keeps others from writing into it. On a file system that knows no
    /// locks nobody is kept out.
    ///
    /// # Errors
    /// Where another run holds it, or it cannot be made.
    pub fn lock(&self) -> Result<Lock, ResultsError> {
        let unwritable = |error| ResultsError::Unwritable {
            path: self.path().to_owned(),
            error,
        };
        fs::create_dir_all(self.path()).map_err(unwritable)?;
        let handle = handle(self.path()).map_err(unwritable)?;
        match handle.try_lock() {
            Ok(()) => Ok(Lock {
                _handle: Some(handle),
            }),
            Err(TryLockError::WouldBlock) => Err(ResultsError::Locked {
                path: self.path().to_owned(),
            }),
            Err(TryLockError::Error(_)) => Ok(Lock { _handle: None }),
        }
    }

    /// Whether a run is writing here.
    pub fn is_locked(&self) -> bool {
        let shared = handle(self.path()).map(|handle| handle.try_lock_shared());
        matches!(shared, Ok(Err(TryLockError::WouldBlock)))
    }
}

/// The directory itself, so that no file is left behind.
#[cfg(unix)]
fn handle(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// A directory has no handle here.
#[cfg(not(unix))]
fn handle(path: &Path) -> io::Result<File> {
    File::create(path.join(".liftsim-lock"))
}
