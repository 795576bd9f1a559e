//! The tables of claims, and what they say of their verdicts.

use super::document::{Block, Part, Span, Target, Text, plain};
use super::published::Cited;
use super::section::{Judged, Section};
use super::words::{cite, spans};
use crate::claim::{Claim, Judgement, Verdict};
use crate::format::thousands;

/// What the verdicts mean.
const VERDICTS: &str = "The rule behind a verdict stands in the config. *Holds* takes a test of superiority, non-inferiority or \
    equivalence at the family-wise level. *Holds where* names for every curve the range of the axis in which the claim is shown, \
    though it is refuted elsewhere: at least two neighbouring values of those that were tested, without a gap. Where the values at \
    which it is shown lie apart, or there are none, a claim with a counter-example *does not hold*; the counter-examples are \
    counted, and the worst is named. *Undecided* means that the trials were too few to tell. *α is held* means that no rate is \
    above α beyond doubt and that each is surely at most the stated multiple of it. Points that share their noise are compared trial \
    by trial (*paired*), others by their counts; the bands in the pictures are pointwise and no test.";

/// The paper's claims with a count of the verdicts, then this project's own comparisons.
pub(super) fn parts(judged: &[Judged], configs: &str, cited: &mut Cited) -> Vec<Part> {
    let (mut of_paper, mut own, mut verdicts) = (Vec::new(), Vec::new(), Vec::new());
    for Judged {
        section,
        judgements,
        ..
    } in judged
    {
        for (claim, judgement) in section.narrative.claims.iter().zip(judgements) {
            let row = row(section, claim, judgement, configs, cited);
            match &claim.source {
                Some(_) => {
                    of_paper.push(row);
                    verdicts.push(&judgement.verdict);
                }
                None => own.push(row),
            }
        }
    }
    let mut parts = Vec::new();
    if !of_paper.is_empty() {
        let words = spans(&format!("{} {VERDICTS}", summary(&verdicts)));
        let head = vec![
            "claim",
            "where the paper makes it",
            "how it was tested",
            "numbers",
            "verdict",
        ];
        parts.push(part(
            "What the paper claims",
            vec![Block::Paragraph(words), table(head, of_paper)],
        ));
    }
    if !own.is_empty() {
        let head = vec!["comparison", "how it was tested", "numbers", "verdict"];
        parts.push(part("Beyond the paper", vec![table(head, own)]));
    }
    parts
}

fn part(title: &str, blocks: Vec<Block>) -> Part {
    Part {
        // As GitHub makes it of a heading.
        id: title.to_lowercase().replace(' ', "-"),
        title: title.to_owned(),
        blocks,
    }
}

fn table(head: Vec<&'static str>, rows: Vec<Vec<Text>>) -> Block {
    Block::Table { head, rows }
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

fn row(
    section: &Section,
    claim: &Claim,
    judgement: &Judgement,
    configs: &str,
    cited: &mut Cited,
) -> Vec<Text> {
    let Section {
        name,
        config,
        paper,
        ..
    } = section;
    let statement = Span::Link(Target::Here(name.clone()), spans(&claim.claim));
    let statement = cite(vec![statement], *paper, cited);
    let source = claim
        .source
        .as_deref()
        .map(|source| cite(spans(source), *paper, cited));
    let trials = if section.evidence.outcomes.is_empty() {
        String::new()
    } else {
        format!("; {} trials per point", thousands(section.trials))
    };
    let mut how = spans(&format!("{}{trials} (", judgement.how));
    how.push(Span::Link(
        Target::Elsewhere(format!("{configs}/{config}")),
        plain(config),
    ));
    how.extend(plain(")"));
    let verdict = vec![Span::Verdict(judgement.verdict.clone())];
    let rest = [how, spans(&judgement.evidence), verdict];
    [statement].into_iter().chain(source).chain(rest).collect()
}
