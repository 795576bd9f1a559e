//! Files that are kept between recordings: JSON with a name and a version in it, replaced whole or not at all, so that a run
//! that is killed leaves what was there before it.

use crate::files;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::error::Error;
use std::io::{self, Read};
use std::path::Path;

/// What kind of file it is.
#[derive(Debug)]
pub(super) struct Kind {
    /// The name in the file.
    pub format: &'static str,
    /// The version that this program writes, and the newest it reads.
    pub version: u64,
    /// The largest size, bytes.
    pub longest: u64,
    /// What it holds.
    pub what: &'static str,
    /// How one is made.
    pub made: &'static str,
    /// What to do with a damaged one.
    pub anew: &'static str,
}

/// A file: what every version begins with, and what it holds.
#[derive(Serialize)]
struct Headed<T> {
    format: &'static str,
    version: u64,
    #[serde(flatten)]
    content: T,
}

/// Why a file that is kept cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct KeptError {
    path: String,
    problem: Problem,
}

#[derive(Debug, thiserror::Error)]
pub(super) enum Problem {
    #[error("cannot be read: {0} ({1})")]
    Unreadable(io::Error, &'static str),
    #[error("cannot be written: {0} (choose another place)")]
    Unwritable(io::Error),
    #[error("no {}, which begins with \"format\": \"{}\" (choose another file)", .0.what, .0.format)]
    Foreign(&'static Kind),
    #[error(
        "version {0}, and this program reads up to {1} (use the program that wrote it, or a newer one)"
    )]
    Newer(u64, u64),
    #[error("damaged: {0} ({1})")]
    Damaged(serde_json::Error, &'static str),
    #[error("damaged: {0}")]
    Wrong(Box<dyn Error + Send + Sync>),
    #[error("{0}")]
    Unfit(Box<dyn Error + Send + Sync>),
}

impl Problem {
    /// Of the file of this name.
    pub fn of(self, path: &str) -> KeptError {
        KeptError {
            path: path.to_owned(),
            problem: self,
        }
    }
}

impl Kind {
    /// The bytes of a file, up to one more than the largest size.
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, KeptError> {
        let mut text = Vec::new();
        let longest = self.longest + 1;
        let read = files::open(path).and_then(|file| file.take(longest).read_to_end(&mut text));
        match read {
            Ok(_) => Ok(text),
            Err(error) => {
                Err(Problem::Unreadable(error, self.made).of(&path.display().to_string()))
            }
        }
    }

    /// Writes a text over whatever is there.
    pub fn write(path: &Path, text: &str) -> Result<(), KeptError> {
        let saved = files::replace(path, text.as_bytes());
        saved.map_err(|error| Problem::Unwritable(error).of(&path.display().to_string()))
    }

    /// What a text holds.
    pub fn parse<T: DeserializeOwned>(&'static self, text: &[u8]) -> Result<T, Problem> {
        if text.len() as u64 > self.longest {
            return Err(Problem::Foreign(self));
        }
        let damaged = |error| Problem::Damaged(error, self.anew);
        let mut content: Map<String, Value> = match serde_json::from_slice(text) {
            Ok(content) => content,
            Err(error) if self.is_begun(text) => return Err(damaged(error)),
            Err(_) => return Err(Problem::Foreign(self)),
        };
        let format = content.remove("format");
        let version = content.remove("version").and_then(|it| it.as_u64());
        match version {
            Some(version) if format == Some(self.format.into()) => {
                if version > self.version {
                    return Err(Problem::Newer(version, self.version));
                }
            }
            _ => return Err(Problem::Foreign(self)),
        }
        serde_json::from_value(Value::Object(content)).map_err(damaged)
    }

    /// The text of a file that holds this.
    pub fn text<T: Serialize>(&self, content: T) -> String {
        let headed = Headed {
            format: self.format,
            version: self.version,
            content,
        };
        let json = serde_json::to_string(&headed);
        json.expect("numbers and names can be written") + "\n"
    }

    /// Whether a text begins as such a file does, so that what follows was lost.
    fn is_begun(&self, text: &[u8]) -> bool {
        text.starts_with(format!(r#"{{"format":"{}""#, self.format).as_bytes())
    }
}
