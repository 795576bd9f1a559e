//! The reproduction report: the tables of claims, a picture and a paragraph for each experiment, and the equations cited.
//!
//! Its numbers come from the result files and its words from the configs. It contains no clock, host or
//! revision, so the same results give the same bytes. It is made once, as a [`Report`]; Markdown and a page are views of it.

mod claims;
mod document;
mod equations;
mod markdown;
mod published;
mod section;
mod text;
mod words;

pub use document::{Block, Part, Report, Span, Target, Text};
pub use published::Paper;
pub use section::{ReportError, Section};
pub use text::{PlaceholderError, fill};

use document::plain;
use published::Cited;
use section::Judged;
use words::{cite, spans};

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
            title: TITLE.to_owned(),
            opening,
            claims,
            experiments: chapters.collect(),
            equations: equations::part(cited),
        })
    }
}

/// The first line of a report.
const TITLE: &str = "Reproduction report";

/// Whether a file in Markdown is a report.
pub fn is_report(text: &[u8]) -> bool {
    text.strip_prefix(b"# ")
        .is_some_and(|text| text.starts_with(TITLE.as_bytes()))
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
