//! A config as a study that can be run, whatever its kind.

use super::any::{AnyStudy, DrawError, Output};
use super::kind::Context;
use super::{STUDIES, parse};
use crate::claim::{Evidence, Narrative};
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::Drawing;
use crate::report::Section;
use crate::results::{
    Comparison, Directory, Manifest, Origin, Quantity, RESULTS, ResultsError, file_name,
};
use crate::run::{Identity, Runnable, StudyError, Trials};

/// A config's study, with the numbers of this run.
pub struct Loaded {
    study: Box<dyn AnyStudy>,
    config: Experiment,
    narrative: Narrative,
    origin: Origin,
}

impl Loaded {
    /// Plans what a config describes.
    ///
    /// # Errors
    /// Where a parameter of a point is out of range, or no region or record can be made for it.
    pub fn new(config: Experiment) -> Result<Self, StudyError> {
        let mut studies = STUDIES.iter();
        let entry = studies.find(|entry| entry.name == config.study());
        let entry = entry.expect("a config names a study");
        let context = Context::of(&config, entry.counts_trials);
        let study = (entry.read)(&config, context)?;
        Ok(Self {
            narrative: config.narrative(&study.scope())?,
            origin: origin(&config, context.trials),
            study,
            config,
        })
    }

    /// What the config asks.
    pub fn question(&self) -> &str {
        &self.config.header.question
    }

    /// Of the intervals.
    pub fn confidence(&self) -> f64 {
        self.config.header.confidence.get()
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
        Ok(Section {
            name,
            config: self.origin.config_name.clone(),
            question: self.question().to_owned(),
            narrative: self.narrative.clone(),
            trials: self.origin.trials,
            evidence: Evidence {
                scope: self.study.scope(),
                outcomes: self.study.outcomes(points)?,
                comparisons,
                quantities,
            },
        })
    }
}

impl Runnable for Loaded {
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

    fn of(&self, origin: &Origin) -> Option<Box<dyn Runnable>> {
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
        let mut config = parse(&origin.config_name, &origin.config)?;
        config.header.set_trials(origin.trials);
        config.header.seed = origin.seed;
        config.header.pilot = origin.pilot;
        Self::new(config)
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
