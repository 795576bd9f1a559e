//! Why a value was refused, in the words of a user: its path, its position, and the rule.

use crate::format::{brief, shorten};
use crate::suggest::among;
use serde::de::{Error, Expected, Unexpected};
use std::fmt::{self, Display};
use std::ops::Range;

/// Why a value was refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The path from the value that was read, such as `impulses.nu`; blank for that value itself.
    pub path: String,
    /// Its position in the text.
    pub span: Option<Range<usize>>,
    message: String,
}

impl Refusal {
    pub(super) fn at(mut self, span: &Range<usize>) -> Self {
        self.span.get_or_insert_with(|| span.clone());
        self
    }

    /// Prepends `prefix` to the path.
    pub fn within(self, prefix: &str) -> Self {
        if prefix.is_empty() {
            self
        } else {
            self.under(prefix)
        }
    }

    pub(super) fn under(mut self, step: &str) -> Self {
        let is_index = self.path.is_empty() || self.path.starts_with('[');
        let separator = if is_index { "" } else { "." };
        self.path = format!("{step}{separator}{}", self.path);
        self
    }
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() {
            f.write_str(&self.message)
        } else {
            write!(f, "{}: {}", self.path, self.message)
        }
    }
}

impl std::error::Error for Refusal {}

impl Error for Refusal {
    fn custom<T: Display>(message: T) -> Self {
        Self {
            path: String::new(),
            span: None,
            message: message.to_string(),
        }
    }

    fn invalid_type(got: Unexpected, expected: &dyn Expected) -> Self {
        // serde gives the name of the Rust type, which means nothing to a user.
        let expected = match expected.to_string() {
            name if name.starts_with("struct ") => "a table".to_owned(),
            words => words,
        };
        Self::custom(format_args!("must be {expected}, got {}", described(got)))
    }

    fn invalid_value(got: Unexpected, expected: &dyn Expected) -> Self {
        Self::invalid_type(got, expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        // serde names the type, which only its author knows.
        let expected = match expected.to_string().rsplit_once(" with ") {
            Some((_, items)) => format!("a list of {}", items.trim_end_matches(" elements")),
            None => expected.to_string(),
        };
        Self::custom(format_args!("must be {expected}, got {length} of them"))
    }

    fn unknown_variant(got: &str, known: &'static [&'static str]) -> Self {
        let known = known.iter().copied();
        Self::custom(format_args!(
            "unknown value {}",
            among(&shorten(got), known)
        ))
    }

    fn unknown_field(got: &str, known: &'static [&'static str]) -> Self {
        let known = known.iter().copied();
        Self::custom(format_args!("unknown key {}", among(&shorten(got), known)))
    }

    fn missing_field(name: &'static str) -> Self {
        Self::custom(format_args!("required key `{name}` is missing (add it)"))
    }
}

fn described(got: Unexpected) -> String {
    match got {
        Unexpected::Bool(flag) => flag.to_string(),
        Unexpected::Unsigned(number) => number.to_string(),
        Unexpected::Signed(number) => number.to_string(),
        Unexpected::Float(number) => brief(number),
        Unexpected::Str(text) => format!("\"{}\"", shorten(text)),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::Seq => "a list".to_owned(),
        other => other.to_string(),
    }
}
