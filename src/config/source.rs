//! A config's text, and errors that point into it: file, line and column, the problem and the remedy.

use super::refusal::Refusal;
use super::tree::Node;
use crate::rule::OutOfRange;
use serde::de::DeserializeOwned;
use std::error::Error;
use std::fmt;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

/// Why a config was refused, and where.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ConfigError(Box<Report>);

#[derive(Debug)]
struct Report {
    file: String,
    place: Option<Place>,
    error: Box<dyn Error + Send + Sync>,
}

/// An error from checking values against each other, with its position or the keys to blame.
#[derive(Debug)]
pub struct Conflict {
    /// The position in the text, if known.
    pub span: Option<Range<usize>>,
    /// Paths that may be to blame, the likeliest first.
    pub keys: Vec<String>,
    /// The error itself.
    pub error: Box<dyn Error + Send + Sync>,
}

impl From<OutOfRange> for Conflict {
    fn from(error: OutOfRange) -> Self {
        Self::of([error.key.clone()], error)
    }
}

impl Conflict {
    /// An error at a position.
    pub fn at(span: &Range<usize>, error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self {
            span: Some(span.clone()),
            keys: Vec::new(),
            error: error.into(),
        }
    }

    /// An error caused by a value at one of these paths.
    pub fn of(
        keys: impl IntoIterator<Item = impl Into<String>>,
        error: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> Self {
        Self {
            span: None,
            keys: keys.into_iter().map(Into::into).collect(),
            error: error.into(),
        }
    }
}

/// A line of the file with the offending part underlined.
#[derive(Clone, Debug)]
struct Place {
    line: usize,
    column: usize,
    text: String,
    width: usize,
}

/// Why a file cannot be a config.
#[derive(Debug, thiserror::Error)]
enum Unreadable {
    #[error("cannot be read: {0} (check the path)")]
    Io(#[from] io::Error),
    #[error("is larger than {} kB, which no config is (check the path)", MOST_BYTES / 1000)]
    TooLarge,
}

/// Configs are written by hand, so a larger file is a mistake.
const MOST_BYTES: u64 = 1_000_000;

/// A config's text and its name in messages.
#[derive(Clone, Debug)]
pub struct Source {
    name: String,
    text: String,
}

impl Source {
    /// A text with its name in messages.
    pub fn new(name: &str, text: &str) -> Self {
        Self {
            name: name.to_owned(),
            text: text.to_owned(),
        }
    }

    /// A file's text.
    ///
    /// # Errors
    /// If the file cannot be read, is not UTF-8 or is too large.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        match read(path) {
            Ok(text) => Ok(Self { name, text }),
            Err(error) => Err(Self::new(&name, "").at(None, error)),
        }
    }

    /// The name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Parses the text into a tree of keys and values.
    ///
    /// # Errors
    /// If the text is not TOML.
    pub fn parse(&self) -> Result<Node, ConfigError> {
        Node::parse(&self.text).map_err(|error| self.at(error.span(), first_line(error.message())))
    }

    /// Reads a tree of this text into any type that serde reads; paths in messages start with `prefix`.
    ///
    /// # Errors
    /// If a key is unknown or missing, or a value does not fit.
    pub fn read<T: DeserializeOwned>(&self, tree: &Node, prefix: &str) -> Result<T, ConfigError> {
        T::deserialize(tree).map_err(|refusal: Refusal| {
            let span = refusal.span.clone().unwrap_or(tree.span.clone());
            self.at(Some(span), refusal.within(prefix))
        })
    }

    /// An error at a place.
    pub fn at(
        &self,
        span: Option<Range<usize>>,
        error: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> ConfigError {
        ConfigError(Box::new(Report {
            file: self.name.clone(),
            place: span.map(|span| self.place(span)),
            error: error.into(),
        }))
    }

    /// An error for a conflict of values of `tree`; `otherwise` is its position if no key to blame is written.
    pub fn conflict(
        &self,
        tree: &Node,
        conflict: Conflict,
        otherwise: &Range<usize>,
    ) -> ConfigError {
        let blamed = conflict.keys.iter().find_map(|path| tree.get(path));
        let span = conflict.span.or(blamed.map(|node| node.span.clone()));
        self.at(Some(span.unwrap_or(otherwise.clone())), conflict.error)
    }

    fn place(&self, span: Range<usize>) -> Place {
        let before = &self.text[..span.start.min(self.text.len())];
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let text = self.text[start..].lines().next().unwrap_or_default();
        let column = before[start..].chars().count() + 1;
        let marked = self.text[span.start.min(self.text.len())..span.end.min(self.text.len())]
            .lines()
            .next();
        Place {
            line: before.matches('\n').count() + 1,
            column,
            text: text.to_owned(),
            width: marked.map_or(1, |marked| marked.chars().count().max(1)),
        }
    }
}

fn read(path: &Path) -> Result<String, Unreadable> {
    let mut text = String::new();
    let file = std::fs::File::open(path)?;
    file.take(MOST_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MOST_BYTES {
        Err(Unreadable::TooLarge)
    } else {
        Ok(text)
    }
}

fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().to_owned()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(place) = &self.place else {
            return write!(f, "{}: {}", self.file, self.error);
        };
        let Place { line, column, .. } = place;
        writeln!(f, "{}:{line}:{column}: {}", self.file, self.error)?;
        let number = line.to_string();
        let blank = " ".repeat(number.len());
        writeln!(f, " {blank} |")?;
        writeln!(f, " {number} | {}", window(&place.text, *column))?;
        let indent = " ".repeat((column - 1).min(BEFORE));
        let width = place.width.min(MOST_SHOWN);
        write!(f, " {blank} | {indent}{}", "^".repeat(width))
    }
}

/// The most characters of a line that a message shows.
const MOST_SHOWN: usize = 200;
const BEFORE: usize = 120;

/// The part of a long line around a column.
fn window(text: &str, column: usize) -> String {
    let skipped = (column - 1).saturating_sub(BEFORE);
    text.chars().skip(skipped).take(MOST_SHOWN).collect()
}
