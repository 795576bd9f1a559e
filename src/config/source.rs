//! A config's text, and errors that point into it: file, line and column, the problem and the remedy.

use super::refusal::Refusal;
use super::shipped::{SHIPPED, Shipped};
use super::tree::Node;
use crate::files;
use crate::format::as_written;
use crate::rule::OutOfRange;
use crate::suggest::nearest;
use serde::de::DeserializeOwned;
use std::error::Error;
use std::fmt;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;
use unicode_width::UnicodeWidthStr;

/// Why a config was refused, and where.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ConfigError(Box<Report>);

#[derive(Debug)]
struct Report {
    file: String,
    place: Option<Place>,
    message: String,
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
    /// In characters, as editors count.
    column: usize,
    /// The text of the line before the place and from it on, shortened.
    before: String,
    from: String,
    /// What of the latter is underlined, in columns of a terminal.
    width: usize,
}

/// Why a file cannot be a config.
#[derive(Debug, thiserror::Error)]
enum Unreadable {
    #[error("cannot be read: {0} (check the path)")]
    Io(#[from] io::Error),
    #[error(
        "no such file, nor with .toml, nor a shipped config{hint} (check the path, or see `liftsim new`)"
    )]
    Unknown { hint: String },
    #[error("no such file (check the path; `{0}` alone is the shipped config)")]
    Shipped(&'static str),
    #[error("the shipped config of this name is for `liftsim {0}` (see `liftsim new`)")]
    Elsewhere(&'static str),
    #[error("is not text in UTF-8 or UTF-16 (save it as UTF-8)")]
    NotText,
    #[error("is empty (`liftsim new` has configs to begin with)")]
    Empty,
    #[error("holds a NUL, which no text does (save it as UTF-8)")]
    Nul,
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
    /// If it cannot be read, is not text or is too large.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        match read(path) {
            Ok(text) => Ok(Self { name, text }),
            Err(error) => Err(Self::new(&name, "").at(None, error)),
        }
    }

    /// The text of a file, for a command. A name without `.toml` that is no file is that of a file with it, or else of
    /// a shipped config.
    ///
    /// # Errors
    /// As [`Source::load`]; and if there is no such file, or the shipped config of this name is for another command.
    pub fn find(path: &Path, command: &'static str) -> Result<Self, ConfigError> {
        // A folder may have the name too, as one of results has; a pipe is no file, but can be read.
        let is_there = |path: &Path| path.exists() && !path.is_dir();
        let with_end = path.with_extension("toml");
        if is_there(path) {
            return Self::load(path);
        }
        if path.extension().is_none() && is_there(&with_end) {
            return Self::load(&with_end);
        }
        let shipped = path.to_str().and_then(Shipped::find);
        let error = match shipped {
            Some(shipped) if shipped.command == command => {
                return Ok(Self::new(&format!("{}.toml", shipped.name), shipped.text));
            }
            Some(Shipped { command, .. }) => Unreadable::Elsewhere(command),
            None if path.is_dir() => return Self::load(path),
            None => missing(path, command),
        };
        Err(Self::new(&path.display().to_string(), "").at(None, error))
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
    /// If there is no text, or it is not TOML.
    pub fn parse(&self) -> Result<Node, ConfigError> {
        if self.text.trim().is_empty() {
            return Err(self.at(None, Unreadable::Empty));
        }
        if let Some(place) = self.text.find('\0') {
            return Err(self.at(Some(place..place + 1), Unreadable::Nul));
        }
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
        let message = error.into().to_string();
        let written = span.clone().and_then(|span| self.text.get(span));
        ConfigError(Box::new(Report {
            file: self.name.clone(),
            place: span.map(|span| self.place(span)),
            message: as_written(message, written.unwrap_or_default()),
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
        let (start, end) = (
            span.start.min(self.text.len()),
            span.end.min(self.text.len()),
        );
        let (before, rest) = self.text.split_at(start);
        let before = before.rsplit('\n').next().unwrap_or_default();
        let marked = self.text[start..end].lines().next().unwrap_or_default();
        let from = rest.lines().next().unwrap_or_default();
        let length = before.chars().count();
        let skipped = length.saturating_sub(BEFORE);
        let first = |text: &str| text.chars().take(FROM).map(visible).collect::<String>();
        Place {
            line: self.text[..start].matches('\n').count() + 1,
            column: length + 1,
            before: before.chars().skip(skipped).map(visible).collect(),
            width: first(marked).width().max(1),
            from: first(from),
        }
    }
}

/// Why nothing is found at a path.
fn missing(path: &Path, command: &str) -> Unreadable {
    let names = SHIPPED.iter().filter(|shipped| shipped.command == command);
    let mut names = names.map(|shipped| shipped.name);
    let stem = path.file_stem().and_then(|stem| stem.to_str());
    let name = stem.unwrap_or_default();
    if let Some(name) = names.clone().find(|shipped| *shipped == name) {
        return Unreadable::Shipped(name);
    }
    if path.extension().is_some() {
        return Unreadable::Io(io::ErrorKind::NotFound.into());
    }
    let near = nearest(name, &mut names);
    Unreadable::Unknown {
        hint: near.map_or(String::new(), |near| format!(", did you mean `{near}`?")),
    }
}

fn read(path: &Path) -> Result<String, Unreadable> {
    let mut bytes = Vec::new();
    let file = files::open(path)?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(Unreadable::TooLarge);
    }
    decoded(&bytes).ok_or(Unreadable::NotText)
}

/// Text in UTF-8 or, as its first bytes say, UTF-16; none if it is neither.
pub fn decoded(bytes: &[u8]) -> Option<String> {
    let utf16 = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let (units, rest) = bytes.as_chunks();
        let units: Vec<u16> = units.iter().copied().map(unit).collect();
        String::from_utf16(&units).ok().filter(|_| rest.is_empty())
    };
    match bytes {
        [0xFF, 0xFE, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [0xEF, 0xBB, 0xBF, rest @ ..] => str::from_utf8(rest).ok().map(str::to_owned),
        all => str::from_utf8(all).ok().map(str::to_owned),
    }
}

fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().to_owned()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(place) = &self.place else {
            return write!(f, "{}: {}", self.file, self.message);
        };
        let Place {
            line,
            column,
            before,
            from,
            width,
        } = place;
        writeln!(f, "{}:{line}:{column}: {}", self.file, self.message)?;
        let number = line.to_string();
        let blank = " ".repeat(number.len());
        writeln!(f, " {blank} |")?;
        writeln!(f, " {number} | {before}{from}")?;
        let indent = " ".repeat(before.width());
        write!(f, " {blank} | {indent}{}", "^".repeat(*width))
    }
}

/// The most characters of a line that a message shows before the place, and from it on.
const BEFORE: usize = 120;
const FROM: usize = 80;

/// A character as a message shows it. A tab would be as wide as the terminal likes, and a control character might do
/// anything.
fn visible(character: char) -> char {
    match character {
        '\t' => ' ',
        it if it.is_control() => char::REPLACEMENT_CHARACTER,
        it => it,
    }
}
