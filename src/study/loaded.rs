//! A config as a study of any kind that can be run.

use super::kind::{Context, Study};
use crate::claim::{Evidence, Narrative, Scope};
use crate::config::Source;
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::{Drawing, FigureError, OVERLAY, render};
use crate::plot::{LayoutError, Options, Overlay, OverlayError, Plot, layout};
use crate::report::{Paper, Section};
use crate::results::{Comparison, Directory, Manifest, Origin, RESULTS, ResultsError, file_name};
use crate::run::{AnyStudy, DrawError, Output, StudyError};

/// A config's study, with the numbers of this run.
pub struct Loaded {
    /// What the config describes.
    pub study: Box<dyn AnyStudy>,
    /// The origin that identifies its results.
    pub origin: Origin,
    /// The question of the config.
    pub question: String,
    /// Confidence of the intervals.
    pub confidence: f64,
    /// How many points there are, in words.
    pub points: String,
    /// How its figure is drawn.
    pub figure: Options,
    /// The curves of one's own that lie over the figure, and their text.
    overlay: Option<(Overlay, String)>,
    scope: Scope,
    narrative: Narrative,
    source: Source,
}

impl Loaded {
    /// Loads a config with the table of `S`.
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
            figure: config.header.figure.clone(),
            overlay: None,
            source: config.source().clone(),
        })
    }

    /// Lays curves of one's own over the figure, a table as text.
    ///
    /// # Errors
    /// If it is no such table.
    pub fn set_overlay(&mut self, text: String) -> Result<(), OverlayError> {
        self.overlay = Some((Overlay::parse(&text)?, text));
        Ok(())
    }

    /// The text of the curves of one's own.
    pub fn overlay(&self) -> Option<&str> {
        self.overlay.as_ref().map(|(_, text)| &text[..])
    }

    /// Judges the claims, fills the text and lays out the picture once on empty counts. This shows, before
    /// any simulation, that everything they need exists. A study without trials is judged when computed.
    ///
    /// # Errors
    /// If a claim or the text is about something that is not among the results, or the picture does not
    /// fit on its sheet.
    pub fn check(&self) -> Result<(), StudyError> {
        if self.study.trials().is_none() {
            return Ok(());
        }
        let output = self.study.output(&Counts::default())?;
        self.judge(&output)?;
        let (plot, _) = self.plot(&output.points)?;
        let laid = layout(&plot);
        laid.map(drop).map_err(|error| self.blamed(error))
    }

    /// A text that does not fit is the config's, such as a label.
    fn blamed(&self, error: LayoutError) -> StudyError {
        let place = match &error {
            LayoutError::Clipped(text) => {
                (self.source.text().find(text.as_str())).map(|start| start..start + text.len())
            }
            _ => None,
        };
        match place {
            Some(span) => self.source.at(Some(span), error).into(),
            None => error.into(),
        }
    }

    /// Judges the claims on the results of a study, and fills the text.
    ///
    /// # Errors
    /// If a claim or the text is about something that is not among the results.
    pub fn judge(&self, output: &Output) -> Result<(), StudyError> {
        self.section("", output.evidence.clone()).judge()?;
        Ok(())
    }

    /// Checks that the rows of a finished result are possible counts, as far as they hold their counts.
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

    /// The picture of `points.csv` as the options want it, and what its reader must be told.
    ///
    /// # Errors
    /// If the bytes do not belong to the study, or the options do not fit its picture.
    pub fn plot(&self, points: &[u8]) -> Result<(Plot, Vec<String>), DrawError> {
        let plot = self.study.plot(points, self.origin.seed)?;
        let overlay = self.overlay.as_ref().map(|(overlay, _)| overlay);
        let drawn = self.figure.apply(plot, overlay);
        Ok(drawn.map_err(FigureError::Options)?)
    }

    /// Draws `points.csv`.
    ///
    /// # Errors
    /// If the bytes do not belong to the study, or drawing fails.
    pub fn draw(&self, points: &[u8], manifest: &Manifest) -> Result<Drawing, DrawError> {
        let (plot, notes) = self.plot(points)?;
        let mut files = render(&plot, &manifest.provenance(), &self.figure)?;
        let own = self
            .overlay()
            .map(|text| (OVERLAY, text.as_bytes().to_vec()));
        files.extend(own);
        Ok(Drawing { files, notes })
    }

    /// The section of the report, from the files of `directory`.
    ///
    /// # Errors
    /// If one of the files is missing or damaged.
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
            paper: Paper::of_study(self.study.name()),
            narrative: self.narrative.clone(),
            trials: self.origin.trials,
            evidence,
        }
    }
}

/// The origin that identifies a config's results.
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
