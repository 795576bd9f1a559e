//! The file of a spool before it is one: whether it can be used, and by nobody else.

use super::journal::beside;
use super::record::Unreadable;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The largest size of a spool, bytes.
pub const LARGEST: u64 = 1 << 30;

/// Why a file cannot be used as a spool.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", path.display())]
pub struct SpoolError {
    pub(super) path: PathBuf,
    pub(super) problem: Problem,
}

#[derive(Debug, thiserror::Error)]
pub(super) enum Problem {
    #[error("cannot be used: {0} (give another --spool)")]
    Unusable(#[from] io::Error),
    #[error("is not an ordinary file (give another --spool)")]
    Special,
    #[error("another monitor uses it (give another --spool: each has its own)")]
    Locked,
    #[error("{0} (move it away to begin a new stream, or give another --spool)")]
    Unreadable(#[from] Unreadable),
}

/// The lock of a spool, a file beside it, for the spool itself is replaced now and then.
pub(super) fn lock(path: &Path) -> Result<Option<File>, Problem> {
    let mut options = File::options();
    let file = options
        .create(true)
        .truncate(false)
        .write(true)
        .open(beside(path, "lock"))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(Problem::Locked),
        // A file system without locks: others are not kept out.
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// The content of a file, if there is any.
pub(super) fn content(path: &Path) -> Result<Option<Vec<u8>>, Problem> {
    let about = match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        about => about?,
    };
    if !about.is_file() {
        return Err(Problem::Special);
    }
    if about.len() > LARGEST {
        return Err(Unreadable::Foreign.into());
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(LARGEST).read_to_end(&mut bytes)?;
    Ok((!bytes.is_empty()).then_some(bytes))
}
