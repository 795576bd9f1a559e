//! An experiment in the report: what its config says, its results, and the verdicts that these give.

use super::published::Paper;
use super::text::{PlaceholderError, fill};
use crate::claim::{
    self, Claim, ClaimError, Enough, Evidence, Judgement, Narrative, Verdict, trials_to_decide,
};

/// One experiment and its results.
#[derive(Clone, Debug)]
pub struct Section {
    /// The name of its directory, beside the report.
    pub name: String,
    /// File name of its config.
    pub config: String,
    /// The question in its config.
    pub question: String,
    /// The paper whose equations it cites.
    pub paper: Paper,
    /// The texts and claims of its config.
    pub narrative: Narrative,
    /// Trials per point.
    pub trials: u64,
    /// Its results.
    pub evidence: Evidence,
}

/// Why an experiment cannot be reported.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ReportError {
    #[error("{config}: text: {error}")]
    Placeholder {
        config: String,
        error: PlaceholderError,
    },
    #[error("{config}: claim {number}, \"{claim}\": {error}")]
    Claim {
        config: String,
        /// The number of the claim, from 1.
        number: usize,
        claim: String,
        error: ClaimError,
    },
}

impl Section {
    /// The verdict on each claim, and the paragraph with its numbers.
    ///
    /// # Errors
    /// If a claim or the text refers to something that is not in the results.
    pub fn judge(&self) -> Result<(Vec<Judgement>, String), ReportError> {
        let judgements = (1..).zip(&self.narrative.claims).map(|(number, claim)| {
            claim::judge(claim, number, &self.evidence)
                .map_err(|error| self.refused(claim, number, error))
        });
        let judgements = judgements.collect::<Result<_, _>>()?;
        let text = self.narrative.text.as_deref().unwrap_or_default();
        let text = fill(text, &self.evidence).map_err(|error| ReportError::Placeholder {
            config: self.config.clone(),
            error,
        })?;
        Ok((judgements, text))
    }

    /// The verdict on each claim as plain text, and for an undecided one how many trials would decide it.
    ///
    /// # Errors
    /// As [`Section::judge`].
    pub fn verdicts(&self) -> Result<String, ReportError> {
        let (judgements, _) = self.judge()?;
        let mut text = String::new();
        for (number, (claim, judgement)) in (1..).zip(self.narrative.claims.iter().zip(judgements))
        {
            let Judgement {
                evidence, verdict, ..
            } = judgement;
            text += &format!("{}: {verdict}\n    {evidence}\n", &*claim.claim);
            if verdict != Verdict::Undecided {
                continue;
            }
            let (evidence, trials) = (&self.evidence, self.trials);
            let enough = trials_to_decide(claim, number, evidence, trials);
            text += &match enough.map_err(|error| self.refused(claim, number, error))? {
                Enough::Trials(trials) => format!(
                    "    if the rates stay as they are, about {trials} trials per point decide it (--trials)\n"
                ),
                Enough::Unknown => "    more trials may decide it (--trials); so far the numbers do not say how many\n".to_owned(),
            };
        }
        Ok(text)
    }

    fn refused(&self, claim: &Claim, number: usize, error: ClaimError) -> ReportError {
        ReportError::Claim {
            config: self.config.clone(),
            number,
            claim: claim.claim.to_string(),
            error,
        }
    }

    pub(super) fn title(&self) -> &str {
        self.narrative.title.as_deref().unwrap_or(&self.name)
    }
}

/// A section with what its results say.
pub(super) struct Judged {
    pub section: Section,
    pub judgements: Vec<Judgement>,
    pub paragraph: String,
}
