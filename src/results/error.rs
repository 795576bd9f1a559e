//! Why results cannot be read or written.

use std::io;
use std::path::PathBuf;

/// Why results cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ResultsError {
    #[error("{}: cannot be read: {error} (run `liftsim sweep` first)", path.display())]
    Unreadable { path: PathBuf, error: io::Error },
    #[error(
        "{}: holds {name}, but no run.json that says where it comes from \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Foreign { path: PathBuf, name: &'static str },
    #[error("{}: not a result of liftsim: {error} (simulate again with --fresh)", path.display())]
    Damaged { path: PathBuf, error: String },
    #[error(
        "{}: holds the result of a different experiment: {difference} \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Different { path: PathBuf, difference: String },
    #[error(
        "{}: holds {held} trials per point, more than the {asked} asked for \
         (choose another directory, or --fresh to replace them)",
        path.display()
    )]
    FewerTrials {
        path: PathBuf,
        held: u64,
        asked: u64,
    },
    #[error("{}: cannot be written: {error} (choose another place)", path.display())]
    Unwritable { path: PathBuf, error: io::Error },
    #[error(
        "{}: cannot be written: {error} (make room there and run the same command again: \
         what was saved before is not lost)",
        path.display()
    )]
    Unsaved { path: PathBuf, error: io::Error },
    #[error(
        "{}: damaged: {error} (restore the file, or --fresh to start over)",
        path.display()
    )]
    Checkpoint { path: PathBuf, error: String },
    #[error(
        "{}: another run of liftsim is writing here (wait for it, or choose another directory)",
        path.display()
    )]
    Locked { path: PathBuf },
}
