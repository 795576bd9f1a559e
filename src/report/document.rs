//! What a report says, apart from how it is written down: parts of paragraphs, tables and pictures.

use crate::claim::Verdict;

/// A report: Markdown and a page are views of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The heading of all of it.
    pub title: String,
    /// What stands before the first part.
    pub opening: Vec<Block>,
    /// Parts on all experiments together.
    pub claims: Vec<Part>,
    /// A part for each experiment.
    pub experiments: Vec<Part>,
    /// The equations that are cited, if any are.
    pub equations: Option<Part>,
}

/// A part with its heading.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// By which links lead here.
    pub id: String,
    /// Its heading.
    pub title: String,
    /// What it says.
    pub blocks: Vec<Block>,
}

/// A piece that stands by itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Paragraph(Text),
    /// Rows of as many cells as there are heads.
    Table {
        /// What each column holds.
        head: Vec<&'static str>,
        /// The cells, row by row.
        rows: Vec<Vec<Text>>,
    },
    /// The picture of an experiment.
    Picture {
        /// The name of the experiment, whose directory has the picture.
        name: String,
        /// What stands for it where it cannot be seen.
        alternative: String,
        /// What stands below it.
        caption: Text,
    },
}

/// A line of text.
pub type Text = Vec<Span>;

/// A piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Span {
    /// Words.
    Plain(String),
    /// What a computer reads, letter by letter.
    Code(String),
    /// A formula, with `_` before what is set low and `^` before what is set high: `x_(i−1)`.
    Formula(String),
    /// Words to be stressed.
    Emphasis(Text),
    /// Words to be stressed more.
    Strong(Text),
    /// Words that lead elsewhere.
    Link(Target, Text),
    /// A place that links lead to.
    Anchor(String),
    /// The verdict on a claim.
    Verdict(Verdict),
}

/// Where a link leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// To a part or an anchor of the report.
    Here(String),
    /// To a file, by its path from the report, or to an address.
    Elsewhere(String),
}

/// Words alone.
pub(super) fn plain(text: &str) -> Text {
    vec![Span::Plain(text.to_owned())]
}
