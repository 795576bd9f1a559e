//! The reproduction report: the tables of claims, a picture and a paragraph for each experiment, and the equations cited.
//!
//! Its numbers come from the result files and its words from the configs. It contains no clock, host or
//! revision, so the same results give the same bytes. It is made once, as a [`Report`]; Markdown and a page are views of it.

mod claims;
mod document;
mod equations;
mod markdown;
mod text;
mod words;

pub use document::{Block, Part, Report, Span, Target, Text};
pub use equations::Paper;
pub use text::{PlaceholderError, fill};

use crate::claim::{
    self, Claim, ClaimError, Enough, Evidence, Judgement, Narrative, Verdict, trials_to_decide,
};
use document::plain;
use equations::Cited;
use words::{cite, spans};

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

    fn title(&self) -> &str {
        self.narrative.title.as_deref().unwrap_or(&self.name)
    }
}

/// A section with what its results say.
struct Judged {
    section: Section,
    judgements: Vec<Judgement>,
    paragraph: String,
}

impl Report {
    /// The report on all experiments; `configs` is the path from the report to their configs, `preface` the
    /// paragraphs at the top.
    ///
    /// # Errors
    /// If a claim or a text refers to something that is not in the results.
    pub fn new(
        mut sections: Vec<Section>,
        configs: &str,
        preface: &str,
    ) -> Result<Self, ReportError> {
        sections.sort_by_key(|section| (section.narrative.order, section.name.clone()));
        let judged = sections.into_iter().map(|section| {
            let (judgements, paragraph) = section.judge()?;
            Ok(Judged {
                section,
                judgements,
                paragraph,
            })
        });
        let judged: Vec<Judged> = judged.collect::<Result<_, _>>()?;
        let mut cited = Cited::new();
        let opening = opening(configs, preface, &mut cited);
        let claims = claims::parts(&judged, configs, &mut cited);
        let chapters = judged.iter();
        let chapters = chapters.map(|judged| chapter(judged, configs, &mut cited));
        Ok(Self {
            title: "Reproduction report".to_owned(),
            opening,
            claims,
            experiments: chapters.collect(),
            equations: equations::part(cited),
        })
    }
}

/// Where the report comes from, and the preface.
fn opening(configs: &str, preface: &str, cited: &mut Cited) -> Vec<Block> {
    let mut origin = spans(
        "Every picture, number and verdict here comes from the result files beside it. `liftsim figures` makes them again from the ",
    );
    origin.push(Span::Link(
        Target::Elsewhere(configs.to_owned()),
        plain("configs"),
    ));
    origin.extend(plain("."));
    let paragraphs = preface.split("\n\n").map(str::trim);
    let paragraphs = (paragraphs.filter(|it| !it.is_empty()))
        .map(|it| Block::Paragraph(cite(spans(it), Paper::Raifeld, cited)));
    [Block::Paragraph(origin)]
        .into_iter()
        .chain(paragraphs)
        .collect()
}

/// The picture of an experiment, its paragraph and its files.
fn chapter(judged: &Judged, configs: &str, cited: &mut Cited) -> Part {
    let Section {
        name,
        config,
        evidence,
        paper,
        ..
    } = &judged.section;
    let question: Vec<&str> = judged.section.question.split_whitespace().collect();
    let question = question.join(" ");
    let picture = Block::Picture {
        name: name.clone(),
        caption: cite(spans(&question), *paper, cited),
        alternative: question,
    };
    let paragraph = (!judged.paragraph.is_empty())
        .then(|| Block::Paragraph(cite(spans(&judged.paragraph), *paper, cited)));
    let mut files = vec![(format!("{name}/points.csv"), "points.csv")];
    for (file, is_there) in [
        ("comparisons.csv", !evidence.comparisons.is_empty()),
        ("quantities.csv", !evidence.quantities.is_empty()),
    ] {
        files.extend(is_there.then(|| (format!("{name}/{file}"), file)));
    }
    files.push((format!("{configs}/{config}"), config));
    let links = files
        .into_iter()
        .map(|(path, file)| vec![Span::Link(Target::Elsewhere(path), plain(file))]);
    let files: Vec<Text> = links.collect();
    let files = Block::Paragraph(files.join(&Span::Plain(" · ".to_owned())));
    Part {
        id: name.clone(),
        title: judged.section.title().to_owned(),
        blocks: [picture]
            .into_iter()
            .chain(paragraph)
            .chain([files])
            .collect(),
    }
}
