//! The reproduction report: pictures, a paragraph each, and the table of claims, as Markdown.
//!
//! Its numbers come from the result files and its words from the configs. It contains no clock, host or
//! revision, so the same results give the same bytes.

mod text;

pub use text::{PlaceholderError, fill};

use crate::claim::{
    self, Claim, ClaimError, Enough, Evidence, Judgement, Narrative, Verdict, trials_to_decide,
};
use crate::format::thousands;
use std::fmt::Write;

/// One experiment and its results.
#[derive(Clone, Debug)]
pub struct Section {
    /// The name of its directory, beside the report.
    pub name: String,
    /// File name of its config.
    pub config: String,
    /// The question in its config.
    pub question: String,
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
            let (verdict, places) = verdict(&judgement.verdict);
            let Judgement { evidence, .. } = judgement;
            text += &format!("{}: {verdict}{places}\n    {evidence}\n", &*claim.claim);
            if judgement.verdict != Verdict::Undecided {
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

    fn title(&self) -> &str {
        self.narrative.title.as_deref().unwrap_or(&self.name)
    }
}

/// The report on all experiments; `configs` is the path from the report to their configs, `preface` the
/// Markdown at the top.
///
/// # Errors
/// If a claim or a text refers to something that is not in the results.
pub fn markdown(
    mut sections: Vec<Section>,
    configs: &str,
    preface: &str,
) -> Result<Vec<u8>, ReportError> {
    sections.sort_by_key(|section| (section.narrative.order, section.name.clone()));
    let judged: Vec<(Vec<Judgement>, String)> = sections
        .iter()
        .map(Section::judge)
        .collect::<Result<_, _>>()?;
    let mut text = format!(
        "# Reproduction report\n\n\
         Every picture, number and verdict here comes from the result files beside it. `liftsim figures` \
         makes them again from the [configs]({configs}).\n\n",
    );
    if !preface.trim().is_empty() {
        text += &format!("{}\n\n", preface.trim());
    }
    text += &claims_tables(&sections, &judged, configs);
    text += &contents(&sections);
    for (section, (_, paragraph)) in sections.iter().zip(&judged) {
        text += &chapter(section, paragraph, configs);
    }
    Ok(text.into_bytes())
}

/// A table of contents with one line per experiment.
fn contents(sections: &[Section]) -> String {
    let mut text = "## Experiments\n\n".to_owned();
    for section in sections {
        let Section { name, .. } = section;
        writeln!(text, "- [{}](#{name})", section.title()).expect("a string takes every line");
    }
    text + "\n"
}

/// The paper's claims with a count of the verdicts, then this project's own comparisons.
fn claims_tables(
    sections: &[Section],
    judged: &[(Vec<Judgement>, String)],
    configs: &str,
) -> String {
    let (mut of_paper, mut own) = (String::new(), String::new());
    let mut verdicts = Vec::new();
    for (section, (judgements, _)) in sections.iter().zip(judged) {
        for (claim, judgement) in section.narrative.claims.iter().zip(judgements) {
            let row = claim_row(section, claim, judgement, configs);
            match &claim.source {
                Some(_) => {
                    of_paper += &row;
                    verdicts.push(&judgement.verdict);
                }
                None => own += &row,
            }
        }
    }
    let mut text = String::new();
    if !of_paper.is_empty() {
        text += &format!(
            "## What the paper claims\n\n{} The rule behind a verdict stands in the config. *Holds* takes a \
             test of superiority, non-inferiority or equivalence at the family-wise level. *Holds where* names \
             for every curve the range of the axis in which the claim is shown, though it is refuted elsewhere: at \
             least two neighbouring values of those that were tested, without a gap. Where the values at which it is \
             shown lie apart, or there are none, a claim with a counter-example *does not hold*; the counter-examples \
             are counted, and the worst is named. *Undecided* means that the \
             trials were too few to tell. *α is held* means that no rate is above α beyond doubt and that each \
             is surely at most the stated multiple of it. Points that share their noise are compared \
             trial by trial (*paired*), others by their counts; the bands in the pictures are pointwise and no \
             test.\n\n\
             | claim | where the paper makes it | how it was tested | numbers | verdict |\n\
             |---|---|---|---|---|\n{of_paper}\n",
            summary(&verdicts),
        );
    }
    if !own.is_empty() {
        text += &format!(
            "## Beyond the paper\n\n| comparison | how it was tested | numbers | verdict |\n\
             |---|---|---|---|\n{own}\n"
        );
    }
    text
}

/// The numbers of the paper's claims by verdict, in words.
fn summary(verdicts: &[&Verdict]) -> String {
    let count = |is_it: fn(&Verdict) -> bool| verdicts.iter().filter(|v| is_it(v)).count();
    format!(
        "Of {} claims {} hold, {} hold in part, {} do not hold and {} are undecided.",
        verdicts.len(),
        count(|verdict| matches!(verdict, Verdict::Holds)),
        count(|verdict| matches!(verdict, Verdict::HoldsWhere(_))),
        count(|verdict| matches!(verdict, Verdict::DoesNotHold)),
        count(|verdict| matches!(verdict, Verdict::Undecided)),
    )
}

fn claim_row(section: &Section, claim: &Claim, judgement: &Judgement, configs: &str) -> String {
    let Section { name, config, .. } = section;
    let trials = if section.evidence.outcomes.is_empty() {
        String::new()
    } else {
        format!("; {} trials per point", thousands(section.trials))
    };
    let source = claim.source.as_deref().map(|source| cell(source) + " | ");
    let (verdict, places) = verdict(&judgement.verdict);
    format!(
        "| [{}](#{name}) | {}{}{trials} ([{config}]({configs}/{config})) | {} | {} |\n",
        cell(&claim.claim),
        source.unwrap_or_default(),
        cell(&judgement.how),
        cell(&judgement.evidence),
        cell(&format!("**{verdict}**{places}")),
    )
}

/// A verdict in words, and where it holds if that is not everywhere.
fn verdict(verdict: &Verdict) -> (&'static str, String) {
    match verdict {
        Verdict::Holds => ("holds", String::new()),
        Verdict::HoldsWhere(places) => ("holds where", format!(" {places}")),
        Verdict::DoesNotHold => ("does not hold", String::new()),
        Verdict::Undecided => ("undecided", String::new()),
    }
}

/// Escapes a text for a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn chapter(section: &Section, paragraph: &str, configs: &str) -> String {
    let Section {
        name,
        config,
        evidence,
        ..
    } = section;
    let mut files = vec![format!("[points.csv]({name}/points.csv)")];
    for (file, is_there) in [
        ("comparisons.csv", !evidence.comparisons.is_empty()),
        ("quantities.csv", !evidence.quantities.is_empty()),
    ] {
        files.extend(is_there.then(|| format!("[{file}]({name}/{file})")));
    }
    files.push(format!("[{config}]({configs}/{config})"));
    let question: Vec<&str> = section.question.split_whitespace().collect();
    let question = question.join(" ");
    let paragraph = if paragraph.is_empty() {
        String::new()
    } else {
        format!("{paragraph}\n\n")
    };
    format!(
        "<a id=\"{name}\"></a>\n\n## {}\n\n![{}]({name}/figure.png)\n\n*{question}*\n\n{paragraph}{}\n\n",
        section.title(),
        question.replace(['[', ']'], ""),
        files.join(" · "),
    )
}
