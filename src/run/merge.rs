//! Shards of one experiment, joined.

use super::existing::check;
use super::{AnyStudy, Overwrite, Session, StudyError, Trials};
use crate::counts::{Counts, CountsError, Key};
use crate::results::{Checkpoint, Directory, Origin, RESULTS, ResultsError, Shard};
use crate::rule::OutOfRange;
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

/// What a whole run has and these shards have not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Absent {
    /// Shards of which there is no directory, where all are of the same cut.
    pub shards: Vec<Shard>,
    /// Directories that are not finished, and the trials of every point that they lack on average.
    pub unfinished: Vec<(PathBuf, u64)>,
}

/// The counts of a shard.
///
/// # Errors
/// Where there are none.
pub fn part(directory: &Directory) -> Result<Checkpoint, MergeError> {
    let path = || directory.path().to_owned();
    (directory.checkpoint()?).ok_or_else(|| MergeError::Nothing(path()))
}

/// Adds the counts of all `shards`, in time linear in their size, as those of the experiment in `directory`, ready
/// to be written or gone on with.
///
/// # Errors
/// Where a shard has none or none that it can have, two are of different experiments or hold the same trials, or
/// the directory holds another experiment or trials that the shards have not.
pub fn merge<'a>(
    study: &'a dyn AnyStudy,
    origin: &Origin,
    shards: &[Directory],
    directory: Directory,
) -> Result<(Session<'a>, Absent), MergeError> {
    let (sum, absent) = join(study, shards)?;
    let is_finished = directory.is_finished() && directory.checkpoint()?.is_none();
    let mut session = Session::open(study, origin, directory, None, Overwrite::Continue)?;
    let more = || MergeError::More(session.directory().path().to_owned());
    if !sum.counts.covers(session.counts()) {
        return Err(more());
    }
    // A finished result that does not say its counts may have trials that the shards lack.
    let says_nothing = session.counts().iter().next().is_none();
    if is_finished && says_nothing && (!absent.shards.is_empty() || !absent.unfinished.is_empty()) {
        return Err(more());
    }
    session.made_by = None;
    session.is_complete = false;
    session.state.counts = sum.counts;
    session.state.seconds = sum.seconds;
    session.check()?;
    session.expect();
    session.save()?;
    Ok((session, absent))
}

/// The counts of all, and what is not among them.
fn join(
    study: &dyn AnyStudy,
    directories: &[Directory],
) -> Result<(Checkpoint, Absent), MergeError> {
    let trials = study.trials().unwrap_or_else(|| Box::new(()));
    let known: BTreeSet<&Key> = trials.targets().iter().map(|target| &target.key).collect();
    let mut sum: Option<Checkpoint> = None;
    let mut absent = Absent::default();
    let mut shards = BTreeSet::new();
    for (index, directory) in directories.iter().enumerate() {
        let path = || directory.path().to_owned();
        let mut part = part(directory)?;
        if let Some(sum) = &sum
            && let Some(difference) = sum.origin.difference(&part.origin)
        {
            return Err(MergeError::Foreign {
                first: directories[0].path().to_owned(),
                second: path(),
                difference,
            });
        }
        // What cannot be might add up to what can.
        let checked = check_part(&*trials, &known, &part);
        checked.map_err(|error| directory.impossible(&error))?;
        // A counter that is not there lacks every trial.
        let targets = trials.targets().iter().filter(|_| part.shard.is_some());
        targets.for_each(|target| part.counts.expect(&target.key, &target.shape));
        let lacking = part.lacking();
        if lacking > 0 {
            absent.unfinished.push((path(), lacking));
        }
        shards.extend(part.shard);
        let Some(sum) = &mut sum else {
            sum = Some(part);
            continue;
        };
        (sum.counts.merge(&part.counts))
            .map_err(|error| overlap(&directories[..index], directory, &part.counts, error))?;
        sum.seconds += part.seconds;
    }
    absent.shards = without_directory(&shards);
    Ok((sum.expect("there is at least one directory"), absent))
}

/// Whether a shard can be what it says: cut as the experiment is, of its counters, of its own trials.
fn check_part(
    trials: &dyn Trials,
    known: &BTreeSet<&Key>,
    part: &Checkpoint,
) -> Result<(), StudyError> {
    let numbers = [
        ("results", part.origin.results.into(), RESULTS.into()),
        ("block", part.block, trials.block()),
        ("points", part.points as u64, trials.points() as u64),
    ];
    for (name, there, here) in numbers {
        if there != here {
            return Err(OutOfRange::new(name, format_args!("be {here}"), there).into());
        }
    }
    let counted = part.counts.iter().map(|(key, _)| key);
    let mut keys = counted.chain(part.counts.decisions.keys());
    if let Some(key) = keys.find(|key| !known.contains(key)) {
        return Err(format!("counter {key}: not of this experiment").into());
    }
    check(trials, part)
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
