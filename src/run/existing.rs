//! Reads the contents of a directory as counts, and decides whether a run may continue from them.

use super::{AnyStudy, Identity, StudyError, Target, Trials};
use crate::counts::Counts;
use crate::results::{Checkpoint, Directory, Manifest, RESULTS, ResultsError};
use std::collections::BTreeSet;

/// How a run treats the existing contents of its directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// The run continues from the contents. Contents of another experiment are refused.
    Continue,
    /// The run keeps the counts that it wants and drops the others, because the directory belongs to the
    /// experiment by its name.
    Adopt,
    /// The run replaces the contents.
    Fresh,
}

/// The counts of a directory.
#[derive(Debug)]
pub(super) struct Existing {
    pub state: Checkpoint,
    /// The manifest of the run that made the counts, if they are a finished result.
    pub made_by: Option<Manifest>,
}

impl Existing {
    /// Reads the counts of an unfinished run or, if there are none, those of a finished result.
    pub fn read(
        directory: &Directory,
        study: &dyn AnyStudy,
        overwrite: Overwrite,
    ) -> Result<Option<Self>, ResultsError> {
        if overwrite == Overwrite::Fresh {
            return Ok(None);
        }
        directory.admit_any()?;
        if let Some(state) = directory.checkpoint()? {
            return Ok(Some(Self {
                state,
                made_by: None,
            }));
        }
        if !directory.is_finished() {
            return Ok(None);
        }
        match Self::finished(directory, study) {
            Err(_) if overwrite == Overwrite::Adopt => Ok(None),
            finished => finished.map(Some),
        }
    }

    /// Reads a finished result, with its counts if they can be recovered from its rows.
    fn finished(directory: &Directory, study: &dyn AnyStudy) -> Result<Self, ResultsError> {
        let manifest = directory.manifest()?;
        let points = directory.points(&manifest)?;
        let comparisons = directory.comparisons(&manifest)?;
        let origin = manifest.origin.clone();
        let there = study.behind(&origin).filter(|_| origin.results == RESULTS);
        let counts = match there {
            Some(there) => (there.recall(&points, &comparisons))
                .map_err(|error| directory.damaged_points(error))?,
            None => None,
        };
        Ok(Self {
            state: Checkpoint {
                shard: None,
                block: 1,
                points: 0,
                seconds: manifest.seconds,
                counts: counts.unwrap_or_default(),
                origin,
            },
            made_by: Some(manifest),
        })
    }

    /// Checks whether the run `here` may continue from these counts.
    pub fn admit(
        &self,
        directory: &Directory,
        here: &Checkpoint,
        study: &dyn AnyStudy,
        overwrite: Overwrite,
    ) -> Result<(), ResultsError> {
        let path = directory.path().to_owned();
        let is_adopted = overwrite == Overwrite::Adopt && self.state.shard.is_none();
        if !is_adopted && let Some(difference) = self.difference(here, study) {
            return Err(ResultsError::Different { path, difference });
        }
        let (held, asked) = (self.state.origin.trials, here.origin.trials);
        if held > asked {
            return Err(ResultsError::FewerTrials { path, held, asked });
        }
        Ok(())
    }

    /// The first difference that prevents the run `here` from using these counts. Differences in labels,
    /// captions, claims and the number of trials are ignored, and so are points that have no counts yet.
    fn difference(&self, here: &Checkpoint, study: &dyn AnyStudy) -> Option<String> {
        let (there, origin) = (&self.state.origin, &here.origin);
        let differs = |name, there: &dyn ToString, here: &dyn ToString| {
            let (there, here) = (there.to_string(), here.to_string());
            (there != here).then(|| format!("{name} is {there} there, {here} here"))
        };
        let shard = |state: &Checkpoint| match state.shard {
            Some(shard) => format!("shard {shard}"),
            None => "all of a run".to_owned(),
        };
        let trials = self.state.shard.map(|_| there.trials);
        let shared = [there, origin].map(|origin| origin.common_random_numbers);
        differs("seed", &there.seed, &origin.seed)
            .or_else(|| differs("common_random_numbers", &shared[0], &shared[1]))
            .or_else(|| differs("it", &shard(&self.state), &shard(here)))
            .or_else(|| differs("trials of a shard", &trials?, &origin.trials))
            .or_else(|| self.points_difference(study))
            .or_else(|| {
                // Finished results of another version are replaced. Unfinished counts are not.
                let is_unfinished = self.made_by.is_none();
                differs("results version", &there.results, &origin.results)
                    .filter(|_| is_unfinished)
            })
    }

    /// The difference between the studies, or the first stored point that this study does not have.
    fn points_difference(&self, study: &dyn AnyStudy) -> Option<String> {
        let Some(there) = study.behind(&self.state.origin) else {
            return Some("its config cannot be read any more".to_owned());
        };
        if there.name() != study.name() {
            return Some(format!("[{}] there, [{}] here", there.name(), study.name()));
        }
        Identity::difference(&there.identities(), &study.identities())
    }

    /// Keeps only the counts that the study wants.
    pub fn keep(&mut self, trials: &dyn Trials) {
        let targets = trials.targets().iter();
        let wanted: BTreeSet<_> = targets.map(|target| &target.key).collect();
        let counts: &mut Counts = &mut self.state.counts;
        counts.retain(|key| wanted.contains(key));
        if counts.iter().next().is_none() {
            self.state.seconds = 0.0;
            self.made_by = None;
        }
    }
}

/// Checks that the counts of a run, or of one share of a run, are possible.
pub(super) fn check(trials: &dyn Trials, state: &Checkpoint) -> Result<(), StudyError> {
    for Target { key, shape } in trials.targets() {
        let share = state.wanted();
        (state.counts).check(key, shape, share, state.origin.trials)?;
    }
    trials.check(&state.counts)
}
