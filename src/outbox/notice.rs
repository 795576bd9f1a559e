//! What a user should know of the way to a listener.

use super::address::Address;
use std::fmt::{self, Display};
use std::io;
use std::path::PathBuf;
use std::time::Duration;

/// Something that happened on the way, in words with a remedy.
#[derive(Debug)]
pub enum Notice {
    /// The listener is not reached, or not as agreed.
    Trouble {
        /// Where it should be.
        address: Address,
        /// What is wrong.
        trouble: Trouble,
        /// Where lines wait.
        spool: PathBuf,
    },
    /// It is reached again.
    Again(Address),
    /// The spool was full, and so many of its oldest lines were dropped.
    Full(PathBuf, u64),
    /// The spool cannot be written.
    Unwritable(PathBuf, io::Error),
    /// It can be written again.
    Writable(PathBuf),
}

/// Why a connection ended, or never began.
#[derive(Debug, thiserror::Error)]
pub enum Trouble {
    /// Nobody is there.
    #[error("cannot be reached: {0} (start a listener there, or correct --tcp)")]
    Unreachable(io::Error),
    /// The connection broke.
    #[error("the connection broke: {0}")]
    Broken(io::Error),
    /// The listener closed it.
    #[error("the listener closed the connection")]
    Closed,
    /// The listener says nothing.
    #[error(
        "the listener has not answered for {} s (it must send the number of the last line that it has, or 0, on a line \
         by itself, when it is reached and when it has stored lines)", .0.as_secs_f64()
    )]
    Silent(Duration),
    /// The listener says something else.
    #[error(
        "the listener must send the number of the last line that it has, or 0, on a line by itself, got {0:?}"
    )]
    Confused(String),
    /// The listener knows more than there is.
    #[error(
        "the listener says that it has line {said}, and {last} was the last (correct the listener, or move the spool \
         away to begin a new stream)"
    )]
    Ahead {
        /// The number that it sent.
        said: u64,
        /// The last that it can have.
        last: u64,
    },
}

impl Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Trouble {
                address,
                trouble,
                spool,
            } => {
                let spool = spool.display();
                write!(
                    f,
                    "{address}: {trouble}; lines wait in {spool}, and it is tried again"
                )
            }
            Self::Again(address) => write!(f, "{address}: the listener is reached again"),
            Self::Full(path, lines) => {
                let path = path.display();
                write!(
                    f,
                    "{path}: is full; oldest lines that were dropped: {lines}, and the listener is told how many it \
                     lacks (start the listener, or give more --spool-size)"
                )
            }
            Self::Unwritable(path, error) => {
                let path = path.display();
                write!(
                    f,
                    "{path}: cannot be written: {error}; lines wait in memory, and are lost if the program ends before \
                     they are sent (free space on the disk)"
                )
            }
            Self::Writable(path) => write!(
                f,
                "{}: is written again, and holds all that waits",
                path.display()
            ),
        }
    }
}

impl Notice {
    /// Whether something is wrong, and not right again.
    pub fn is_warning(&self) -> bool {
        !matches!(self, Self::Again(_) | Self::Writable(_))
    }
}
