//! Shards of one experiment, joined.

use super::{Campaign, Terms};
use crate::config::{Config, ConfigError};
use crate::ledger::{LedgerError, Refusal};
use crate::plan::Plan;
use crate::results::{Checkpoint, Directory, ResultsError, Shard};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Why counts cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// A directory cannot be read, or the joined counts not be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// No counts.
    #[error(
        "{}: holds no counts.json (give directories that `liftsim sweep --shard` has written)",
        .0.display()
    )]
    Nothing(PathBuf),
    /// Shares of two experiments.
    #[error(
        "{} and {}: not of one experiment: {difference} (merge each experiment by itself)",
        first.display(),
        second.display()
    )]
    Foreign {
        /// A directory.
        first: PathBuf,
        /// The one that does not go with it.
        second: PathBuf,
        /// The first thing that differs.
        difference: String,
    },
    /// The same trials twice.
    #[error(
        "{} and {}: {refusal} (leave one of them out)",
        first.display(),
        second.display()
    )]
    Overlap {
        /// A directory.
        first: PathBuf,
        /// The one that has the same trials.
        second: PathBuf,
        /// Which.
        refusal: Refusal,
    },
    /// The config of the shards is of another version.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// Something is there that the shards are no substitute for.
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
    /// What is missing of the whole.
    pub missing: Missing,
}

/// What a whole run has and these shards have not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    /// Shards of which there is no directory, where all are of the same cut.
    pub absent: Vec<Shard>,
    /// Directories that are not finished, and the trials of every point that they lack on average.
    pub unfinished: Vec<(PathBuf, u64)>,
}

/// Adds the counts of all `directories`, in time linear in their size.
///
/// # Errors
/// Where one has none, two are of different experiments, or two hold the same trials.
pub fn join(directories: &[Directory]) -> Result<Joined, MergeError> {
    let mut sum: Option<Checkpoint> = None;
    let mut missing = Missing::default();
    let mut shards = BTreeSet::new();
    for (index, directory) in directories.iter().enumerate() {
        let path = || directory.path().to_owned();
        let part = read(directory)?;
        let lacking = super::status::lacking(&part);
        if lacking > 0 {
            missing.unfinished.push((path(), lacking));
        }
        shards.extend(part.shard);
        let Some(sum) = &mut sum else {
            sum = Some(part);
            continue;
        };
        if let Some(difference) = sum.origin.difference(&part.origin) {
            let (first, second) = (directories[0].path().to_owned(), path());
            return Err(MergeError::Foreign {
                first,
                second,
                difference,
            });
        }
        (sum.counters.merge(&part.counters))
            .map_err(|error| overlap(&directories[..index], directory, &part, error))?;
        sum.told.extend(part.told);
        sum.seconds += part.seconds;
    }
    let mut state = sum.expect("there is at least one directory");
    state.shard = None;
    missing.absent = absent(&shards);
    Ok(Joined { state, missing })
}

fn read(directory: &Directory) -> Result<Checkpoint, MergeError> {
    let nothing = || MergeError::Nothing(directory.path().to_owned());
    directory.checkpoint()?.ok_or_else(nothing)
}

/// Who of `before` has what `part` has too.
fn overlap(
    before: &[Directory],
    directory: &Directory,
    part: &Checkpoint,
    error: LedgerError,
) -> MergeError {
    let has_it = |before: &&Directory| match before.checkpoint() {
        Ok(Some(mut other)) => other.counters.merge(&part.counters).is_err(),
        _ => false,
    };
    let first = before.iter().find(has_it).unwrap_or(directory);
    MergeError::Overlap {
        first: first.path().to_owned(),
        second: directory.path().to_owned(),
        refusal: error.refusal,
    }
}

/// The shards that are not among these.
fn absent(shards: &BTreeSet<Shard>) -> Vec<Shard> {
    let Some(count) = shards.first().map(|shard| shard.count) else {
        return Vec::new();
    };
    match shards.iter().all(|shard| shard.count == count) {
        true => (1..=count)
            .map(|number| Shard { number, count })
            .filter(|shard| !shards.contains(shard))
            .collect(),
        false => Vec::new(),
    }
}

impl Joined {
    /// The experiment in `directory` as the shards have it, ready to be written or gone on with.
    ///
    /// # Errors
    /// Where the directory holds another experiment, or trials that the shards have not.
    pub fn settle(self, directory: Directory) -> Result<(Config, Campaign), MergeError> {
        let config = self.state.origin.sweep()?;
        let plan = Plan::new(&config)?;
        let mut campaign = Campaign::open(&config, plan, directory, None, Terms::Continue)?;
        if !self.state.counters.covers(&campaign.state.counters) {
            return Err(MergeError::More(campaign.directory.path().to_owned()));
        }
        campaign.made_by = None;
        campaign.state = self.state;
        campaign.wanted.expect_in(&mut campaign.state.counters);
        campaign.save()?;
        Ok((config, campaign))
    }
}
