//! Rules for single values, and the error for a value that breaks one.

use crate::format::{brief, shorten};
use std::fmt::{self, Display};

/// A rule for one number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub enum Rule {
    /// Finite.
    Positive,
    /// Strictly between 0 and 1.
    Level,
    /// In a closed interval: lower end, upper end, unit.
    Within(f64, f64, &'static str),
}

/// A value that breaks its rule.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}must {rule}, got {got}{remedy}", prefix(key))]
pub struct OutOfRange {
    /// The key or the flag, as the user writes it; blank if the caller adds it later.
    pub key: String,
    /// The text after "must".
    pub rule: String,
    /// The value as the user wrote it.
    pub got: String,
    /// The reason or what to do, in brackets after a space; may be empty.
    pub remedy: &'static str,
}

fn prefix(key: &str) -> String {
    if key.is_empty() {
        String::new()
    } else {
        format!("{key}: ")
    }
}

/// A rule with a remedy for its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explained(pub Rule, pub &'static str);

impl Explained {
    /// Like [`Rule::check`], with the remedy in the error.
    ///
    /// # Errors
    /// If the value breaks the rule.
    pub fn check(self, key: &str, value: &impl Checked) -> Result<(), OutOfRange> {
        (self.0.check(key, value)).map_err(|error| error.explained(self.1))
    }
}

/// A value that can be checked; an optional one is checked if it is present.
pub trait Checked {
    /// The number and its text.
    fn written(&self) -> Option<(f64, String)>;
}

impl Rule {
    /// Checks the value of `key`.
    ///
    /// # Errors
    /// If the value breaks the rule.
    pub fn check(self, key: &str, value: &impl Checked) -> Result<(), OutOfRange> {
        match value.written() {
            Some((number, got)) if !self.holds(number) => Err(OutOfRange::new(key, self, got)),
            _ => Ok(()),
        }
    }

    fn holds(self, value: f64) -> bool {
        match self {
            Self::Positive => value > 0.0 && value.is_finite(),
            Self::Level => value > 0.0 && value < 1.0,
            Self::Within(least, most, _) => (least..=most).contains(&value),
        }
    }
}

impl Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Positive => f.write_str("be positive and finite"),
            Self::Level => f.write_str("lie strictly between 0 and 1"),
            Self::Within(least, most, unit) => {
                write!(f, "lie in [{}, {}]", brief(*least), brief(*most))?;
                match *unit {
                    "" => Ok(()),
                    unit => write!(f, " {unit}"),
                }
            }
        }
    }
}

impl OutOfRange {
    /// An error for the value `got` of `key`; `rule` is the text after "must".
    pub fn new(key: impl Into<String>, rule: impl Display, got: impl Display) -> Self {
        Self {
            key: key.into(),
            rule: rule.to_string(),
            got: shorten(&got.to_string()).into_owned(),
            remedy: "",
        }
    }

    /// The same for a value without a key; a bracketed text at the end of `rule` is the remedy.
    pub fn of(rule: &'static str, got: impl Display) -> Self {
        let (rule, remedy) = rule.split_at(rule.find(" (").unwrap_or(rule.len()));
        Self::new("", rule, got).explained(remedy)
    }

    /// The same for a value in `place`, a table or an entry of a list.
    #[must_use]
    pub fn under(self, place: impl Display) -> Self {
        let key = format!("{place}.{}", self.key);
        Self { key, ..self }
    }

    /// Adds a remedy.
    #[must_use]
    pub fn explained(self, remedy: &'static str) -> Self {
        Self { remedy, ..self }
    }
}

impl Checked for f64 {
    fn written(&self) -> Option<(f64, String)> {
        Some((*self, self.to_string()))
    }
}

impl Checked for usize {
    fn written(&self) -> Option<(f64, String)> {
        Some((*self as f64, self.to_string()))
    }
}

impl<T: Checked> Checked for Option<T> {
    fn written(&self) -> Option<(f64, String)> {
        self.as_ref().and_then(Checked::written)
    }
}
