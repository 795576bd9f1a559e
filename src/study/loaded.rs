//! A config as a study that can be run, whatever its kind.

use super::{Study, Table, build};
use crate::claim::{Evidence, Narrative, Outcome, Scope};
use crate::counts::Counts;
use crate::experiment::Experiment as Config;
use crate::figure::{Drawing, FigureError, render};
use crate::report::Section;
use crate::results::{
    Comparison, Directory, Manifest, Origin, Quantity, RESULTS, ResultsError, csv_bytes, file_name,
};
use crate::run::{Experiment, Identity, StudyError, Trials};
use crate::schedule::DEFAULT_PILOT_TRIALS;

/// A study whose kind is not known, its rows in bytes.
pub(super) trait AnyStudy: Send + Sync {
    fn name(&self) -> &'static str;
    fn identities(&self) -> Vec<Identity>;
    fn trials(&self) -> Option<Box<dyn Trials + '_>>;
    fn points(&self) -> String;
    fn output(&self, counts: &Counts) -> Result<Output, StudyError>;
    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error>;
    fn draw(&self, points: &[u8], manifest: &Manifest) -> Result<Drawing, DrawError>;
    fn curves(&self, points: &[u8]) -> Result<(Scope, Vec<Outcome>), csv::Error>;
}

impl<S: Study> AnyStudy for S {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn identities(&self) -> Vec<Identity> {
        Study::identities(self)
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Study::trials(self)
    }

    fn points(&self) -> String {
        Study::points(self)
    }

    fn output(&self, counts: &Counts) -> Result<Output, StudyError> {
        let rows = self.rows(counts);
        Ok(Output {
            points: csv_bytes(&rows),
            comparisons: self.comparisons(&rows, counts),
            quantities: self.quantities(&rows)?,
            findings: self.findings(&rows),
            rows: rows.len(),
        })
    }

    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error> {
        let rows: Vec<S::Row> = read(points)?;
        Ok(Study::recall(self, &rows, comparisons))
    }

    fn draw(&self, points: &[u8], manifest: &Manifest) -> Result<Drawing, DrawError> {
        let rows: Vec<S::Row> = read(points)?;
        if rows.is_empty() {
            return Err(FigureError::NoRows(S::NAME).into());
        }
        let plot = self.plot(&rows, manifest.origin.seed)?;
        Ok(render(&plot, &manifest.provenance())?)
    }

    fn curves(&self, points: &[u8]) -> Result<(Scope, Vec<Outcome>), csv::Error> {
        let rows: Vec<S::Row> = read(points)?;
        Ok(Study::curves(self, &rows))
    }
}

fn read<R: serde::de::DeserializeOwned>(bytes: &[u8]) -> Result<Vec<R>, csv::Error> {
    csv::Reader::from_reader(bytes).deserialize().collect()
}

/// Why rows could not be drawn.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum DrawError {
    #[error(transparent)]
    Rows(#[from] csv::Error),
    #[error(transparent)]
    Figure(#[from] FigureError),
}

/// What a study comes to.
#[derive(Clone, Debug)]
pub struct Output {
    /// `points.csv`
    pub points: Vec<u8>,
    /// `comparisons.csv`
    pub comparisons: Vec<Comparison>,
    /// `quantities.csv`
    pub quantities: Vec<Quantity>,
    /// A table for whoever ran it.
    pub findings: Option<Table>,
    /// How many rows `points` has.
    pub rows: usize,
}

impl Output {
    /// The files by their names.
    pub fn files(&self) -> Vec<(&'static str, Vec<u8>)> {
        let mut files = vec![("points.csv", self.points.clone())];
        if !self.comparisons.is_empty() {
            files.push(("comparisons.csv", csv_bytes(&self.comparisons)));
        }
        if !self.quantities.is_empty() {
            files.push(("quantities.csv", csv_bytes(&self.quantities)));
        }
        files
    }
}

/// A config's study, with the numbers of this run.
pub struct Loaded {
    study: Box<dyn AnyStudy>,
    origin: Origin,
    question: String,
    narrative: Narrative,
    confidence: f64,
}

impl Loaded {
    /// Plans what a config describes.
    ///
    /// # Errors
    /// Where a parameter of a point is out of range, or no region or record can be made for it.
    pub fn new(config: &Config) -> Result<Self, StudyError> {
        let study = build(config)?;
        let (question, narrative, confidence) = match config {
            Config::Sweep(c) => (&c.question, &c.narrative, c.confidence),
            Config::Exhibit(c) => (&c.question, &c.narrative, c.confidence),
        };
        Ok(Self {
            study,
            origin: origin(config),
            question: question.clone(),
            narrative: narrative.clone(),
            confidence,
        })
    }

    /// What the config asks.
    pub fn question(&self) -> &str {
        &self.question
    }

    /// Of the intervals.
    pub fn confidence(&self) -> f64 {
        self.confidence
    }

    /// How many points there are, in words.
    pub fn points(&self) -> String {
        self.study.points()
    }

    /// What the counts come to.
    ///
    /// # Errors
    /// Where a number is asked for that the rows do not give.
    pub fn output(&self, counts: &Counts) -> Result<Output, StudyError> {
        self.study.output(counts)
    }

    /// Judges the claims and fills the text once on empty counts, so that what they name is known to be there
    /// before anything is simulated. What is computed is judged when it is.
    ///
    /// # Errors
    /// Where a claim or the text is about something that is not among the results.
    pub fn check(&self) -> Result<(), StudyError> {
        if self.study.trials().is_none() {
            return Ok(());
        }
        self.judge(&self.study.output(&Counts::default())?)
    }

    /// Judges the claims on what a study came to, and fills the text.
    ///
    /// # Errors
    /// Where a claim or the text is about something that is not among the results.
    pub fn judge(&self, output: &Output) -> Result<(), StudyError> {
        let (comparisons, quantities) = (output.comparisons.clone(), output.quantities.clone());
        let section = self.section(String::new(), &output.points, comparisons, quantities)?;
        section.judge()?;
        Ok(())
    }

    /// Draws `points.csv`.
    ///
    /// # Errors
    /// Where the bytes are not the study's, or drawing fails.
    pub fn draw(&self, points: &[u8], manifest: &Manifest) -> Result<Drawing, DrawError> {
        self.study.draw(points, manifest)
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
        self.section(name.to_owned(), &points, comparisons, quantities)
            .map_err(|error| directory.damaged_points(error))
    }

    fn section(
        &self,
        name: String,
        points: &[u8],
        comparisons: Vec<Comparison>,
        quantities: Vec<Quantity>,
    ) -> Result<Section, csv::Error> {
        let (scope, outcomes) = self.study.curves(points)?;
        Ok(Section {
            name,
            config: self.origin.config_name.clone(),
            question: self.question.clone(),
            narrative: self.narrative.clone(),
            trials: self.origin.trials,
            evidence: Evidence {
                scope,
                outcomes,
                comparisons,
                quantities,
            },
        })
    }
}

impl Experiment for Loaded {
    fn name(&self) -> &'static str {
        self.study.name()
    }

    fn origin(&self) -> &Origin {
        &self.origin
    }

    fn identities(&self) -> Vec<Identity> {
        self.study.identities()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        self.study.trials()
    }

    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error> {
        self.study.recall(points, comparisons)
    }

    fn of(&self, origin: &Origin) -> Option<Box<dyn Experiment>> {
        let there = Self::again(origin).ok()?;
        Some(Box::new(there))
    }
}

impl Loaded {
    /// The experiment behind results.
    ///
    /// # Errors
    /// Where this version cannot read its config.
    pub fn again(origin: &Origin) -> Result<Self, StudyError> {
        let config = Config::parse(&origin.config_name, &origin.config)?;
        let mut config = config.with_trials(origin.trials)?;
        match &mut config {
            Config::Sweep(config) => (config.seed, config.pilot) = (origin.seed, origin.pilot),
            Config::Exhibit(config) => config.seed = origin.seed,
        }
        Self::new(&config)
    }
}

/// What a config's results are known by.
pub fn origin(config: &Config) -> Origin {
    let (name, text, seed, trials) = match config {
        Config::Sweep(c) => (c.name(), c.text(), c.seed, c.trials),
        Config::Exhibit(c) => (c.name(), c.text(), c.seed, c.trials),
    };
    let (pilot, common_random_numbers) = match config {
        Config::Sweep(config) => (config.pilot, config.common_random_numbers),
        Config::Exhibit(_) => (DEFAULT_PILOT_TRIALS, true),
    };
    Origin {
        config_name: file_name(name),
        config: text.to_owned(),
        seed,
        trials,
        pilot,
        common_random_numbers,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        results: RESULTS,
    }
}
