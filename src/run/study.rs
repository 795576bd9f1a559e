//! A study as a run takes it.

use super::{Identity, StudyError, Trials};
use crate::claim::{Evidence, Outcome};
use crate::counts::Counts;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{Comparison, Origin, csv_bytes};

/// A study whose kind is not known, its rows as the bytes of `points.csv`.
pub trait AnyStudy: Send + Sync {
    /// The name of its table.
    fn name(&self) -> &'static str;

    /// What it is of, point by point.
    fn identities(&self) -> Vec<Identity>;

    /// What it counts; none where everything is computed.
    fn trials(&self) -> Option<Box<dyn Trials + '_>>;

    /// The counts behind finished results of its own, where these tell them.
    ///
    /// # Errors
    /// Where the bytes are not the study's rows.
    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error>;

    /// The study behind other results; none where this version cannot read its config.
    fn behind(&self, origin: &Origin) -> Option<Box<dyn AnyStudy>>;

    /// What the counts come to.
    ///
    /// # Errors
    /// Where a number is asked for that the rows do not give.
    fn output(&self, counts: &Counts) -> Result<Output, StudyError>;

    /// The rates that claims about curves are judged by.
    ///
    /// # Errors
    /// Where the bytes are not the study's rows.
    fn outcomes(&self, points: &[u8]) -> Result<Vec<Outcome>, csv::Error>;

    /// The picture of its rows.
    ///
    /// # Errors
    /// Where the bytes are not the study's rows, or there is nothing to draw.
    fn plot(&self, points: &[u8], seed: u64) -> Result<Plot, DrawError>;
}

/// What a study comes to.
#[derive(Clone, Debug)]
pub struct Output {
    /// `points.csv`
    pub points: Vec<u8>,
    /// What claims are judged by, `comparisons.csv` and `quantities.csv` in it.
    pub evidence: Evidence,
    /// A table for whoever ran it.
    pub findings: Option<Table>,
}

/// A header and lines.
pub type Table = (&'static [&'static str], Vec<Vec<String>>);

impl Output {
    /// The files by their names.
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

/// Why rows could not be drawn.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum DrawError {
    #[error(transparent)]
    Rows(#[from] csv::Error),
    #[error(transparent)]
    Figure(#[from] FigureError),
}
