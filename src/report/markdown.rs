//! A report as Markdown.

use super::document::{Block, Part, Report, Span, Target};
use crate::claim::Verdict;
use std::iter;

impl Report {
    /// The report as a file of Markdown, beside the directories of the experiments.
    pub fn markdown(&self) -> String {
        let mut written = format!("# {}\n\n{}", self.title, blocks(&self.opening));
        for Part {
            title, blocks: of, ..
        } in &self.claims
        {
            written += &format!("## {title}\n\n{}", blocks(of));
        }
        written += "## Experiments\n\n";
        for Part { id, title, .. } in &self.experiments {
            written += &format!("- [{title}](#{id})\n");
        }
        written += "\n";
        for Part {
            id,
            title,
            blocks: of,
        } in self.experiments.iter().chain(&self.equations)
        {
            written += &format!("<a id=\"{id}\"></a>\n\n## {title}\n\n{}", blocks(of));
        }
        written
    }
}

fn blocks(blocks: &[Block]) -> String {
    blocks.iter().map(block).collect()
}

fn block(block: &Block) -> String {
    match block {
        Block::Paragraph(words) => format!("{}\n\n", text(words)),
        Block::Table { head, rows } => {
            let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
            let head_row = row(head.iter().map(|it| (*it).to_owned()).collect());
            let rule = format!("|{}\n", "---|".repeat(head.len()));
            let rows = rows.iter().map(|cells| {
                let cells = cells.iter().map(|cell| text(cell).replace('|', "\\|"));
                row(cells.collect())
            });
            let lines: String = iter::once(head_row).chain([rule]).chain(rows).collect();
            lines + "\n"
        }
        Block::Picture {
            name,
            alternative,
            caption,
        } => {
            let alternative = alternative.replace(['[', ']'], "");
            format!(
                "![{alternative}]({name}/figure.png)\n\n*{}*\n\n",
                text(caption)
            )
        }
    }
}

/// A line of Markdown.
pub(super) fn text(spans: &[Span]) -> String {
    spans.iter().map(span).collect()
}

fn span(span: &Span) -> String {
    match span {
        Span::Plain(words) => words.clone(),
        Span::Code(code) | Span::Formula(code) => format!("`{code}`"),
        Span::Emphasis(words) => format!("*{}*", text(words)),
        Span::Strong(words) => format!("**{}**", text(words)),
        Span::Link(Target::Here(place), words) => format!("[{}](#{place})", text(words)),
        Span::Link(Target::Elsewhere(path), words) => format!("[{}]({path})", text(words)),
        Span::Anchor(id) => format!("<a id=\"{id}\"></a>"),
        Span::Verdict(verdict) => match verdict {
            Verdict::HoldsWhere(places) => format!("**{}** {places}", verdict.name()),
            _ => format!("**{}**", verdict.name()),
        },
    }
}
