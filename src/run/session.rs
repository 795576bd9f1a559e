//! An experiment in its directory, worked off.

use super::existing::{Existing, Overwrite, check};
use super::missing::Work;
use super::save::Saver;
use super::{AnyStudy, Missing, Progress, StudyError, Target, Trials};
use crate::counts::Counts;
use crate::results::{Checkpoint, Directory, Lock, Manifest, Origin, ResultsError, Shard};
use std::time::{Duration, Instant};

/// An experiment in its directory, which nobody else writes into as long as this lives.
pub struct Session<'a> {
    trials: Box<dyn Trials + 'a>,
    directory: Directory,
    /// What is saved, and how far it is.
    pub(super) state: Checkpoint,
    /// What made the results that all counts come from, as long as nothing is added to them.
    pub(super) made_by: Option<Manifest>,
    /// Whether the results are here, down to the words of the config.
    pub(super) is_complete: bool,
    /// Whether the saved counts are others than before.
    is_new: bool,
    lock: Lock,
}

impl<'a> Session<'a> {
    /// Locks the directory and finds out what of the experiment, or of one share of it, is done there.
    ///
    /// # Errors
    /// Where the directory is in use, cannot be written, or holds what is not to be overwritten.
    pub fn open(
        study: &'a dyn AnyStudy,
        origin: &Origin,
        directory: Directory,
        shard: Option<Shard>,
        overwrite: Overwrite,
    ) -> Result<Self, ResultsError> {
        let lock = directory.lock()?;
        directory.check_writable()?;
        let trials = study.trials().unwrap_or_else(|| Box::new(()));
        let mut state = Checkpoint {
            origin: origin.clone(),
            shard,
            block: trials.block(),
            points: trials.points(),
            seconds: 0.0,
            counts: Counts::default(),
        };
        let is_new = overwrite == Overwrite::Fresh || shard.is_some();
        let is_complete = !is_new && directory.complete(&state.origin).is_some();
        let mut made_by = None;
        if let Some(mut existing) = Existing::read(&directory, study, overwrite)? {
            existing.admit(&directory, &state, study, overwrite)?;
            existing.keep(&*trials);
            state.counts = existing.state.counts;
            state.seconds = existing.state.seconds;
            made_by = existing.made_by;
        }
        let mut session = Self {
            trials,
            directory,
            state,
            made_by,
            is_complete,
            is_new: false,
            lock,
        };
        session.check()?;
        session.expect();
        Ok(session)
    }

    /// Where it lives.
    pub fn directory(&self) -> &Directory {
        &self.directory
    }

    /// The counts so far.
    pub fn counts(&self) -> &Counts {
        &self.state.counts
    }

    /// How many points are counted.
    pub fn points(&self) -> usize {
        self.state.points
    }

    /// Trials of every point that are wanted here.
    pub fn wanted(&self) -> u64 {
        let wanted = self.state.wanted();
        wanted.end - wanted.start
    }

    /// Wall clock of the simulation.
    pub fn seconds(&self) -> f64 {
        self.state.seconds
    }

    /// What made the results that all counts come from; none where anything was simulated since.
    pub fn made_by(&self) -> Option<&Manifest> {
        self.made_by.as_ref()
    }

    /// Whether there is nothing to do: the results are here, down to the words of the config.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// What is wanted and not counted; none where all is done.
    pub fn missing(&self) -> Option<Missing> {
        let missing = (!self.is_complete).then(|| self.missing_of(&self.needed()))?;
        (!missing.is_empty()).then_some(missing)
    }

    fn missing_of(&self, targets: &[usize]) -> Missing {
        let state = &self.state;
        Missing::new(&*self.trials, targets, &state.counts, &state.wanted())
    }

    /// What the progress of [`count`](Self::count) adds up to.
    pub fn work(&self, missing: &Missing) -> u64 {
        Work::new(&*self.trials, missing).size()
    }

    /// The targets of this run. A share does not know what the others find, so it counts all there may be.
    fn needed(&self) -> Vec<usize> {
        if self.state.shard.is_some() {
            (0..self.trials.targets().len()).collect()
        } else {
            self.trials.needed(&self.state.counts)
        }
    }

    /// Runs the pilots of what is missing.
    ///
    /// # Errors
    /// Where a pilot shows no decision.
    pub fn prepare(
        &mut self,
        missing: &Missing,
        progress: &dyn Progress,
    ) -> Result<(), StudyError> {
        let decisions = self.trials.prepare(&missing.targets(), progress)?;
        self.state.counts.decisions.extend(decisions);
        Ok(())
    }

    /// Simulates what is missing, and saves the counts every `period`, before and after. Says whether all of it
    /// is done.
    ///
    /// # Errors
    /// Where the counts cannot be saved; what was saved before is left.
    pub fn count(
        &mut self,
        missing: &Missing,
        period: Duration,
        progress: &dyn Progress,
    ) -> Result<bool, ResultsError> {
        let start = Instant::now();
        self.made_by = None;
        // A place that cannot be written is found out before it costs anything.
        self.save()?;
        let counts = std::mem::take(&mut self.state.counts).into();
        let saver = Saver::new(&self.directory, &self.state, &counts, period, progress);
        Work::new(&*self.trials, missing).count(&counts, &saver);
        let saved = saver.finish();
        self.state.counts = counts.into_inner().expect("nobody panics with the counts");
        self.state.seconds += start.elapsed().as_secs_f64();
        saved?;
        self.is_new = true;
        self.expect();
        self.save()?;
        progress.saved();
        Ok(!progress.is_stopped() || self.missing_of(&missing.targets()).is_empty())
    }

    /// Saves the counts, be they none. Says whether they, or the words of the config, are others than when the
    /// session was opened.
    ///
    /// # Errors
    /// Where they cannot be written.
    pub fn save(&mut self) -> Result<bool, ResultsError> {
        self.is_new |= self.directory.save(&self.state)?;
        Ok(self.is_new)
    }

    /// The lock under which results can be written.
    pub fn close(self) -> Lock {
        self.lock
    }

    /// Enters every counter, so that the file tells how much there is to do.
    pub(super) fn expect(&mut self) {
        let needed = self.needed();
        for Target { key, shape } in needed.into_iter().map(|at| &self.trials.targets()[at]) {
            self.state.counts.expect(key, shape);
        }
    }

    /// Whether the counts can be what they say.
    pub(super) fn check(&self) -> Result<(), ResultsError> {
        let checked = check(&*self.trials, &self.state);
        checked.map_err(|error| self.directory.impossible(&error))
    }
}
