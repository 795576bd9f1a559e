//! Merges the shards of one experiment.

use super::existing::check;
use super::{AnyStudy, Overwrite, Session, StudyError, Trials};
use crate::counts::{Counts, CountsError, Key};
use crate::results::{Checkpoint, Directory, Origin, RESULTS, ResultsError, Shard};
use crate::rule::OutOfRange;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Why counts cannot be merged.
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

/// The parts of a whole run that the shards lack.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Absent {
    /// Shards that have no directory. The list is empty if the given shards disagree on the number of shards.
    pub shards: Vec<Shard>,
    /// Unfinished directories, each with the number of trials that it lacks per point on average.
    pub unfinished: Vec<(PathBuf, u64)>,
}

/// Reads the counts of a shard.
///
/// # Errors
/// If the directory holds no counts or they cannot be read.
pub fn part(directory: &Directory) -> Result<Checkpoint, MergeError> {
    let path = || directory.path().to_owned();
    (directory.checkpoint()?).ok_or_else(|| MergeError::Nothing(path()))
}

/// Adds the counts of all `shards` in time linear in their size. The sum becomes the counts of the experiment
/// in `directory`, from which results can be written or the run continued.
///
/// # Errors
/// If a shard has no counts or impossible counts, if two shards belong to different experiments or hold the
/// same trials, or if the directory holds another experiment or trials that the shards lack.
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
    // A finished result without counts may have trials that the shards lack, so an incomplete sum is refused.
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

/// The sum of all counts, and the parts of the run that are absent from it.
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
        // Check each part before adding it, because impossible counts might add up to a possible sum.
        let checked = check_part(&*trials, &known, &part);
        checked.map_err(|error| directory.impossible(&error))?;
        // A counter that a shard has not entered yet lacks every trial.
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

/// Checks that a shard is possible: it has the experiment's blocks and points, holds only the experiment's
/// counters, and counts only its own trials.
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

/// Names the first directory of `before` whose trials overlap those of `part`.
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

/// The shards that are not in `shards`.
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
