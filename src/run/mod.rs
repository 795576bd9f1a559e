//! Trials that are counted: what a study wants, what its directory has of it, what is missing, done block by
//! block on one machine or on many.
//!
//! A study describes its [`Trials`]. What a directory has, a finished result or the counts of a run that was
//! stopped, is read as [`Counts`](crate::counts::Counts); missing is what is wanted and not counted, and that is simulated. So to
//! resume a run, to raise its trials, to add a curve or a claim and to find everything done are the same
//! operation.
//!
//! # On 10⁴ cores
//! On paper, for the 156 points of Fig. 6, which share one noise, and 10¹⁰ trials (intervals of ±10⁻⁵), in
//! `sweep --shard i/10000`:
//!
//! - *Blocks.* 10¹⁰ / 1024 ≈ 9.8 · 10⁶ for the one group, 976 or 977 for each task: nobody does 0.2 % more than
//!   another. At 100 ns for a trial of a point, a block takes 16 ms and a task 16 s; below ten blocks for a
//!   task the shares get uneven, and tasks beyond the number of blocks have nothing to do.
//! - *Overhead.* Every task plans the whole (a fraction of a second) and runs the pilots of its own points;
//!   these do not shrink with the share. An experiment of pilots alone is no faster on many cores.
//! - *Files.* One `counts.json` for each task, 10⁴ in all, 39 kB each and 390 MB together: a stretch and a count
//!   for each of 336 counters, so a file does not grow with its trials. Rewritten every five seconds, that
//!   is 78 MB/s of all the tasks together. No task reads what another writes, and none waits.
//! - *Merge.* One process reads the files one after the other and keeps one set of counts, so its memory is that
//!   of one file. 800 shards/s were measured on one busy core (`merge_is_linear` in `tests/program/shards.rs`
//!   prints it for 500 and 1000), in proportion to their number: 10⁴ take 12 s, about as long as a task.

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
