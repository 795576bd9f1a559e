//! A study whose kind is not known, its rows in bytes.

use super::kind::{Study, Table};
use crate::claim::{Outcome, Scope};
use crate::counts::Counts;
use crate::figure::{Drawing, FigureError, render};
use crate::results::{Comparison, Manifest, Quantity, csv_bytes};
use crate::run::{Identity, StudyError, Trials};

/// A study whose kind is not known, its rows in bytes.
pub trait AnyStudy: Send + Sync {
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
    fn scope(&self) -> Scope;
    fn outcomes(&self, points: &[u8]) -> Result<Vec<Outcome>, csv::Error>;
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

    fn scope(&self) -> Scope {
        Study::scope(self)
    }

    fn outcomes(&self, points: &[u8]) -> Result<Vec<Outcome>, csv::Error> {
        let rows: Vec<S::Row> = read(points)?;
        Ok(Study::outcomes(self, &rows))
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
