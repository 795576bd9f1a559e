//! Shards of one experiment, joined.

use super::{Experiment, Overwrite, Session};
use crate::counts::{Counts, CountsError};
use crate::results::{Checkpoint, Directory, ResultsError, Shard};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Why counts cannot be joined.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum MergeError {
    #[error(transparent)]
    Results(#[from] ResultsError),
    #[error(
        "{}: holds no counts.json (give directories that `liftsim sweep --shard` has written)",
        .0.display()
    )]
    Nothing(PathBuf),
    #[error(
        "{} and {}: not of one experiment: {difference} (merge each experiment by itself)",
        first.display(),
        second.display()
    )]
    Foreign {
        first: PathBuf,
        second: PathBuf,
        difference: String,
    },
    #[error(
        "{} and {}: {error} (leave one of them out)",
        first.display(),
        second.display()
    )]
    Overlap {
        first: PathBuf,
        second: PathBuf,
        error: CountsError,
    },
    #[error(
        "{}: holds trials that are not in the shards (give another --out)",
        .0.display()
    )]
    More(PathBuf),
}

/// Shards added up.
#[derive(Debug)]
pub struct Joined {
    /// The counts of all.
    pub state: Checkpoint,
    /// What the whole run has and these shards have not.
    pub absent: Absent,
}

/// What a whole run has and these shards have not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Absent {
    /// Shards of which there is no directory, where all are of the same cut.
    pub shards: Vec<Shard>,
    /// Directories that are not finished, and the trials of every point that they lack on average.
    pub unfinished: Vec<(PathBuf, u64)>,
}

/// Adds the counts of all `directories`, in time linear in their size.
///
/// # Errors
/// Where one has none, two are of different experiments, or two hold the same trials.
pub fn join(directories: &[Directory]) -> Result<Joined, MergeError> {
    let mut sum: Option<Checkpoint> = None;
    let mut absent = Absent::default();
    let mut shards = BTreeSet::new();
    for (index, directory) in directories.iter().enumerate() {
        let path = || directory.path().to_owned();
        let nothing = || MergeError::Nothing(path());
        let part = directory.checkpoint()?.ok_or_else(nothing)?;
        let lacking = part.lacking();
        if lacking > 0 {
            absent.unfinished.push((path(), lacking));
        }
        shards.extend(part.shard);
        let Some(sum) = &mut sum else {
            sum = Some(part);
            continue;
        };
        if let Some(difference) = sum.origin.difference(&part.origin) {
            return Err(MergeError::Foreign {
                first: directories[0].path().to_owned(),
                second: path(),
                difference,
            });
        }
        (sum.counts.merge(&part.counts))
            .map_err(|error| overlap(&directories[..index], directory, &part.counts, error))?;
        sum.seconds += part.seconds;
    }
    let mut state = sum.expect("there is at least one directory");
    state.shard = None;
    absent.shards = without_directory(&shards);
    Ok(Joined { state, absent })
}

/// Who of `before` has what `part` has too.
fn overlap(
    before: &[Directory],
    directory: &Directory,
    part: &Counts,
    error: CountsError,
) -> MergeError {
    let has_it = |before: &&Directory| match before.checkpoint() {
        Ok(Some(mut other)) => other.counts.merge(part).is_err(),
        _ => false,
    };
    let first = before.iter().find(has_it).unwrap_or(directory);
    MergeError::Overlap {
        first: first.path().to_owned(),
        second: directory.path().to_owned(),
        error,
    }
}

/// The shards that are not among these.
fn without_directory(shards: &BTreeSet<Shard>) -> Vec<Shard> {
    let Some(count) = shards.first().map(|shard| shard.count) else {
        return Vec::new();
    };
    if shards.iter().any(|shard| shard.count != count) {
        return Vec::new();
    }
    (1..=count)
        .map(|number| Shard { number, count })
        .filter(|shard| !shards.contains(shard))
        .collect()
}

impl Joined {
    /// The experiment in `directory` as the shards have it, ready to be written or gone on with.
    ///
    /// # Errors
    /// Where the directory holds another experiment, or trials that the shards have not.
    pub fn settle<'a>(
        self,
        experiment: &'a dyn Experiment,
        directory: Directory,
    ) -> Result<Session<'a>, MergeError> {
        let mut session = Session::open(experiment, directory, None, Overwrite::Continue)?;
        if !self.state.counts.covers(session.counts()) {
            return Err(MergeError::More(session.directory().path().to_owned()));
        }
        session.made_by = None;
        session.is_complete = false;
        session.state = self.state;
        session.check()?;
        session.expect();
        session.save()?;
        Ok(session)
    }
}
