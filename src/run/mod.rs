//! Counting trials: the trials that a study wants, those that its directory has, and those that are missing.
//! The missing trials run block by block on one machine or on many.
//!
//! A study describes its [`Trials`]. A directory holds a finished result or the counts of a run that was
//! stopped, and either is read as [`Counts`](crate::counts::Counts). Trials that are wanted and not counted
//! are missing, and only these are simulated. So resuming a run, raising its number of trials, adding a curve
//! or a claim, and finding everything done are the same operation.
//!
//! # On 10⁴ cores
//! This is an estimate on paper for `sweep --shard i/10000` with the 156 points of Fig. 6, which share one
//! noise, and 10¹⁰ trials (intervals of ±10⁻⁵):
//!
//! - *Blocks.* The one group has 10¹⁰ / 1024 ≈ 9.8 · 10⁶ blocks, and each task has 976 or 977 of them: no
//!   task does 0.2 % more than another. At 100 ns for a trial of a point, a block takes 16 ms and a task
//!   16 s. Below ten blocks per task the shares become uneven, and tasks beyond the number of blocks have
//!   nothing to do.
//! - *Overhead.* Every task plans the whole run (a fraction of a second) and runs the pilots of its own
//!   points. The pilots do not shrink with the share. An experiment of pilots alone is no faster on many
//!   cores.
//! - *Files.* Each task writes one `counts.json`: 10⁴ files of 39 kB, 390 MB together. A file holds a stretch
//!   and a count for each of 336 counters, so it does not grow with its trials. The files are rewritten every
//!   five seconds, which is 78 MB/s for all tasks together. No task reads another task's file, and no task
//!   waits.
//! - *Merge.* One process reads the files one after the other and keeps one set of counts, so it needs the
//!   memory of one file. We measured 800 shards/s on one busy core (`merge_is_linear` in
//!   `tests/program/shards.rs` prints the rate for 500 and 1000). The time is proportional to the number of
//!   shards: 10⁴ take 12 s, about as long as a task.

mod estimate;
mod existing;
mod identity;
mod merge;
mod missing;
mod save;
mod session;
mod status;
mod study;
mod trials;

pub use estimate::{Estimate, whole};
pub use existing::Overwrite;
pub use identity::Identity;
pub use merge::{Absent, MergeError, merge, part};
pub use missing::Missing;
pub use session::Session;
pub use status::{State, Status};
pub use study::{AnyStudy, DrawError, Output, Table};
pub use trials::{Group, Progress, StudyError, Target, Trials};
