//! The interface between a study and a run.

use super::{Identity, StudyError, Trials};
use crate::claim::{Evidence, Outcome};
use crate::counts::Counts;
use crate::figure::FigureError;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::results::{Comparison, Origin, csv_bytes};
use crate::rule::OutOfRange;

/// A study of any kind. Its rows are passed as the bytes of `points.csv`.
pub trait AnyStudy: Send + Sync {
    /// The name of the study's table in the config.
    fn name(&self) -> &'static str;

    /// The identity of every point of the study.
    fn identities(&self) -> Vec<Identity>;

    /// The trials that the study counts, or `None` if the study computes everything.
    fn trials(&self) -> Option<Box<dyn Trials + '_>>;

    /// Recovers the counts from finished results of this study, if the results contain them.
    ///
    /// # Errors
    /// If the bytes are not the study's rows.
    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error>;

    /// The study that made other results, or `None` if this version cannot read its config.
    fn behind(&self, origin: &Origin) -> Option<Box<dyn AnyStudy>>;

    /// The output that the counts give.
    ///
    /// # Errors
    /// If the config asks for a number that the rows do not give.
    fn output(&self, counts: &Counts) -> Result<Output, StudyError>;

    /// The rates by which claims about curves are judged.
    ///
    /// # Errors
    /// If the bytes are not the study's rows.
    fn outcomes(&self, points: &[u8]) -> Result<Vec<Outcome>, csv::Error>;

    /// The false alarms that `check` tests.
    ///
    /// # Errors
    /// If the bytes are not the study's rows.
    fn false_alarms(&self, points: &[u8]) -> Result<Vec<Scenario>, csv::Error>;

    /// What is wrong with a config of which these are none; none if the study promises no rate at all.
    fn nothing_promised(&self) -> Option<OutOfRange>;

    /// The plot of the study's rows.
    ///
    /// # Errors
    /// If the bytes are not the study's rows, or the rows contain nothing to draw.
    fn plot(&self, points: &[u8], seed: u64) -> Result<Plot, DrawError>;
}

/// The output of a study.
#[derive(Clone, Debug)]
pub struct Output {
    /// The bytes of `points.csv`.
    pub points: Vec<u8>,
    /// The evidence for judging claims. It includes `comparisons.csv` and `quantities.csv`.
    pub evidence: Evidence,
    /// A table that the command prints for its user.
    pub findings: Option<Table>,
}

/// A header and lines.
pub type Table = (&'static [&'static str], Vec<Vec<String>>);

impl Output {
    /// The output files, each with its name.
    pub fn files(&self) -> Vec<(&'static str, Vec<u8>)> {
        let Evidence {
            comparisons,
            quantities,
            ..
        } = &self.evidence;
        let mut files = vec![("points.csv", self.points.clone())];
        if !comparisons.is_empty() {
            files.push(("comparisons.csv", csv_bytes(comparisons)));
        }
        if !quantities.is_empty() {
            files.push(("quantities.csv", csv_bytes(quantities)));
        }
        files
    }
}

/// Why the rows could not be drawn.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum DrawError {
    #[error(transparent)]
    Rows(#[from] csv::Error),
    #[error(transparent)]
    Figure(#[from] FigureError),
}
