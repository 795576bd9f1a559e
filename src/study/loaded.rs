//! A config as a study that can be run, whatever its kind.

use super::kind::{Context, Study};
use crate::claim::{Evidence, Narrative, Scope};
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::{Drawing, render};
use crate::plot::layout;
use crate::report::Section;
use crate::results::{Comparison, Directory, Manifest, Origin, RESULTS, ResultsError, file_name};
use crate::run::{AnyStudy, DrawError, Output, StudyError};

/// A config's study, with the numbers of this run.
pub struct Loaded {
    /// What the config describes.
    pub study: Box<dyn AnyStudy>,
    /// What its results are known by.
    pub origin: Origin,
    /// What the config asks.
    pub question: String,
    /// Of the intervals.
    pub confidence: f64,
    /// How many points there are, in words.
    pub points: String,
    scope: Scope,
    narrative: Narrative,
}

impl Loaded {
    /// Of a config with the table of `S`.
    pub(super) fn of<S: Study>(config: &Experiment) -> Result<Self, StudyError> {
        config.check_used(S::USES, S::COUNTS_TRIALS)?;
        let context = Context::of(config, S::COUNTS_TRIALS);
        let study = S::read(config, context)?;
        let scope = study.scope();
        Ok(Self {
            narrative: config.narrative(&scope)?,
            scope,
            points: study.points(),
            study: Box::new(study),
            origin: origin(config, context.trials),
            question: config.header.question.clone(),
            confidence: context.confidence,
        })
    }

    /// Judges the claims, fills the text and lays out the picture once on empty counts, so that whatever they
    /// need is known to be there before anything is simulated. A study that is computed is judged when it is.
    ///
    /// # Errors
    /// If a claim or the text is about something that is not among the results, or the picture does not fit on
    /// its sheet.
    pub fn check(&self) -> Result<(), StudyError> {
        if self.study.trials().is_none() {
            return Ok(());
        }
        let output = self.study.output(&Counts::default())?;
        self.judge(&output)?;
        layout(&self.study.plot(&output.points, self.origin.seed)?)?;
        Ok(())
    }

    /// Judges the claims on what a study came to, and fills the text.
    ///
    /// # Errors
    /// Where a claim or the text is about something that is not among the results.
    pub fn judge(&self, output: &Output) -> Result<(), StudyError> {
        self.section("", output.evidence.clone()).judge()?;
        Ok(())
    }

    /// Whether the rows of a finished result can have been counted, so far as they hold their counts.
    ///
    /// # Errors
    /// If they contradict themselves, each other or the number of trials.
    pub fn verify(&self, points: &[u8], comparisons: &[Comparison]) -> Result<(), StudyError> {
        let recalled = self.study.recall(points, comparisons)?;
        let (Some(counts), Some(trials)) = (recalled, self.study.trials()) else {
            return Ok(());
        };
        let all = self.origin.trials;
        for target in trials.targets() {
            counts.check(&target.key, &target.shape, 0..all, all)?;
        }
        trials.check(&counts)
    }

    /// Draws `points.csv`.
    ///
    /// # Errors
    /// Where the bytes are not the study's, or drawing fails.
    pub fn draw(&self, points: &[u8], manifest: &Manifest) -> Result<Drawing, DrawError> {
        let plot = self.study.plot(points, manifest.origin.seed)?;
        Ok(render(&plot, &manifest.provenance())?)
    }

    /// For the report, from the files of `directory`.
    ///
    /// # Errors
    /// Where one of them is missing or damaged.
    pub fn report(&self, name: &str, directory: &Directory) -> Result<Section, ResultsError> {
        let manifest = directory.manifest()?;
        let comparisons = directory.comparisons(&manifest)?;
        let quantities = directory.quantities(&manifest)?;
        let points = directory.points(&manifest)?;
        self.verify(&points, &comparisons)
            .map_err(|error| directory.impossible(&error))?;
        let outcomes = self.study.outcomes(&points);
        let evidence = Evidence {
            scope: self.scope.clone(),
            outcomes: outcomes.map_err(|error| directory.damaged_points(error))?,
            comparisons,
            quantities,
        };
        Ok(self.section(name, evidence))
    }

    fn section(&self, name: &str, evidence: Evidence) -> Section {
        Section {
            name: name.to_owned(),
            config: self.origin.config_name.clone(),
            question: self.question.clone(),
            narrative: self.narrative.clone(),
            trials: self.origin.trials,
            evidence,
        }
    }
}

/// What a config's results are known by.
fn origin(config: &Experiment, trials: u64) -> Origin {
    let header = &config.header;
    Origin {
        config_name: file_name(config.name()),
        config: config.text().to_owned(),
        seed: header.seed,
        trials,
        pilot: header.pilot,
        common_random_numbers: header.common_random_numbers,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        results: RESULTS,
    }
}
