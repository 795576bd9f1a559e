//! Lets any study be used without knowing its kind.

use super::{Loaded, Study};
use crate::claim::{Evidence, Outcome};
use crate::counts::Counts;
use crate::figure::FigureError;
use crate::gate::Scenario;
use crate::plot::Plot;
use crate::results::{Comparison, Origin, csv_bytes};
use crate::rule::OutOfRange;
use crate::run::{AnyStudy, DrawError, Identity, Output, StudyError, Trials};

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

    fn recall(
        &self,
        points: &[u8],
        comparisons: &[Comparison],
    ) -> Result<Option<Counts>, csv::Error> {
        Ok(Study::recall(self, &rows::<S>(points)?, comparisons))
    }

    fn behind(&self, origin: &Origin) -> Option<Box<dyn AnyStudy>> {
        Some(Loaded::again(origin).ok()?.study)
    }

    fn output(&self, counts: &Counts) -> Result<Output, StudyError> {
        let rows = self.rows(counts);
        Ok(Output {
            points: csv_bytes(&rows),
            evidence: Evidence {
                scope: self.scope(),
                outcomes: Study::outcomes(self, &rows),
                comparisons: self.comparisons(&rows, counts),
                quantities: self.quantities(&rows)?,
            },
            findings: self.findings(&rows),
        })
    }

    fn outcomes(&self, points: &[u8]) -> Result<Vec<Outcome>, csv::Error> {
        Ok(Study::outcomes(self, &rows::<S>(points)?))
    }

    fn false_alarms(&self, points: &[u8]) -> Result<Vec<Scenario>, csv::Error> {
        Ok(Study::false_alarms(self, &rows::<S>(points)?))
    }

    fn nothing_promised(&self) -> Option<OutOfRange> {
        S::nothing_promised()
    }

    fn plot(&self, points: &[u8], seed: u64) -> Result<Plot, DrawError> {
        let rows = rows::<S>(points)?;
        if rows.is_empty() {
            return Err(FigureError::NoRows(S::NAME).into());
        }
        Ok(Study::plot(self, &rows, seed)?)
    }
}

fn rows<S: Study>(points: &[u8]) -> Result<Vec<S::Row>, csv::Error> {
    csv::Reader::from_reader(points).deserialize().collect()
}
