//! Why results cannot be read or written.

use std::io;
use std::path::PathBuf;

/// Why results cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// A file is missing or unreadable.
    #[error("{}: cannot be read: {error} (run `liftsim sweep` first)", path.display())]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// Files that no `sweep` has put there.
    #[error(
        "{}: holds {name}, but no run.json that tells where it comes from \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Foreign {
        /// Which directory.
        path: PathBuf,
        /// What it holds.
        name: &'static str,
    },
    /// A file is not what this program writes.
    #[error("{}: not a result of liftsim: {error} (simulate again with --fresh)", path.display())]
    Damaged {
        /// Which.
        path: PathBuf,
        /// Why.
        error: String,
    },
    /// Something else lives there.
    #[error(
        "{}: holds the result of a different experiment: {difference} \
         (choose another directory, or --fresh to replace it)",
        path.display()
    )]
    Different {
        /// Which directory.
        path: PathBuf,
        /// The first thing that differs.
        difference: String,
    },
    /// More has been done than is asked for.
    #[error(
        "{}: holds {held} trials per point, more than the {asked} asked for \
         (choose another directory, or --fresh to replace them)",
        path.display()
    )]
    FewerTrials {
        /// Which directory.
        path: PathBuf,
        /// Trials there.
        held: u64,
        /// Trials asked for.
        asked: u64,
    },
    /// Nothing can be written there.
    #[error("{}: cannot be written: {error} (choose another place)", path.display())]
    Unwritable {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The counts so far cannot be written.
    #[error(
        "{}: cannot be written: {error} (make room there and run the same command again: \
         what was saved before is not lost)",
        path.display()
    )]
    Unsaved {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// Counts so far that are not as they were written.
    #[error(
        "{}: damaged: {error} (restore the file, or --fresh to start over)",
        path.display()
    )]
    Checkpoint {
        /// Which.
        path: PathBuf,
        /// Why.
        error: String,
    },
    /// Another run is writing there.
    #[error(
        "{}: another run of liftsim is writing here (wait for it, or choose another directory)",
        path.display()
    )]
    Locked {
        /// Which directory.
        path: PathBuf,
    },
}
