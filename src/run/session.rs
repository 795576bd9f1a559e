//! Runs an experiment in its directory.

use super::existing::{Existing, Overwrite, check};
use super::missing::Work;
use super::save::Saver;
use super::{AnyStudy, Missing, Progress, StudyError, Target, Trials};
use crate::counts::Counts;
use crate::results::{Checkpoint, Directory, Lock, Manifest, Origin, ResultsError, Shard};
use std::time::{Duration, Instant};

/// An experiment in its directory. The session locks the directory, so no other process writes into it.
pub struct Session<'a> {
    trials: Box<dyn Trials + 'a>,
    directory: Directory,
    /// The state that is saved: the counts so far and the run they belong to.
    pub(super) state: Checkpoint,
    /// The manifest of the results that all counts come from, as long as no counts are added.
    pub(super) made_by: Option<Manifest>,
    /// Whether the directory holds the results of exactly this config, word for word.
    pub(super) is_complete: bool,
    /// Whether the saved counts differ from those at the start of the session.
    is_new: bool,
    lock: Lock,
}

impl<'a> Session<'a> {
    /// Locks the directory and reads the part of the experiment, or of one share of it, that is done there.
    ///
    /// # Errors
    /// If the directory is in use, cannot be written, or holds something that must not be overwritten.
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

    /// The directory of the experiment.
    pub fn directory(&self) -> &Directory {
        &self.directory
    }

    /// The counts so far.
    pub fn counts(&self) -> &Counts {
        &self.state.counts
    }

    /// The number of points that are counted.
    pub fn points(&self) -> usize {
        self.state.points
    }

    /// The number of trials of every point that this run wants.
    pub fn wanted(&self) -> u64 {
        let wanted = self.state.wanted();
        wanted.end - wanted.start
    }

    /// Wall-clock time of the simulation, in seconds.
    pub fn seconds(&self) -> f64 {
        self.state.seconds
    }

    /// The manifest of the results that all counts come from, or `None` if counts were added since.
    pub fn made_by(&self) -> Option<&Manifest> {
        self.made_by.as_ref()
    }

    /// Whether the directory holds the results of exactly this config, so that the run has nothing to do.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// The trials that are wanted and not counted, or `None` if everything is done.
    pub fn missing(&self) -> Option<Missing> {
        let missing = (!self.is_complete).then(|| self.missing_of(&self.needed()))?;
        (!missing.is_empty()).then_some(missing)
    }

    fn missing_of(&self, targets: &[usize]) -> Missing {
        let state = &self.state;
        Missing::new(&*self.trials, targets, &state.counts, &state.wanted())
    }

    /// The total work that [`count`](Self::count) reports as progress.
    pub fn work(&self, missing: &Missing) -> u64 {
        Work::new(&*self.trials, missing).size()
    }

    /// The targets of this run. A share does not know the counts of the other shares, so it counts every
    /// target.
    fn needed(&self) -> Vec<usize> {
        if self.state.shard.is_some() {
            (0..self.trials.targets().len()).collect()
        } else {
            self.trials.needed(&self.state.counts)
        }
    }

    /// Runs the pilots of the missing targets.
    ///
    /// # Errors
    /// If a pilot shows no decision.
    pub fn prepare(
        &mut self,
        missing: &Missing,
        progress: &dyn Progress,
    ) -> Result<(), StudyError> {
        let decisions = self.trials.prepare(&missing.targets(), progress)?;
        self.state.counts.decisions.extend(decisions);
        Ok(())
    }

    /// Simulates the missing trials. Saves the counts before, after, and every `period` in between. Returns
    /// whether all missing trials are done.
    ///
    /// # Errors
    /// If the counts cannot be saved. Counts that were saved before remain.
    pub fn count(
        &mut self,
        missing: &Missing,
        period: Duration,
        progress: &dyn Progress,
    ) -> Result<bool, ResultsError> {
        let start = Instant::now();
        self.made_by = None;
        // Save once before simulating, so that a directory that cannot be written costs no simulation time.
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

    /// Saves the counts, even if there are no counts. Returns whether the counts or the text of the config
    /// changed since the session was opened.
    ///
    /// # Errors
    /// If the counts cannot be written.
    pub fn save(&mut self) -> Result<bool, ResultsError> {
        self.is_new |= self.directory.save(&self.state)?;
        Ok(self.is_new)
    }

    /// Ends the session and returns its lock, under which results can be written.
    pub fn close(self) -> Lock {
        self.lock
    }

    /// Enters every counter, so that the file shows how many trials are left to do.
    pub(super) fn expect(&mut self) {
        let needed = self.needed();
        for Target { key, shape } in needed.into_iter().map(|at| &self.trials.targets()[at]) {
            self.state.counts.expect(key, shape);
        }
    }

    /// Checks that the counts are possible.
    pub(super) fn check(&self) -> Result<(), ResultsError> {
        let checked = check(&*self.trials, &self.state);
        checked.map_err(|error| self.directory.impossible(&error))
    }
}
