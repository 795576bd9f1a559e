//! What a single value must be, and the refusal of one that is not.

use crate::format::shorten;
use std::fmt::{self, Display};

/// A rule for one number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "what a name says is not said again")]
pub enum Rule {
    /// Finite.
    Positive,
    /// Strictly between 0 and 1.
    Level,
    /// From the first to the second, both included, of a unit.
    Within(f64, f64, &'static str),
}

/// A value that breaks its rule.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}must {rule}, got {got}{remedy}", prefix(key))]
pub struct OutOfRange {
    /// The key or the flag, as the user writes it; blank where whoever reads the value adds it.
    pub key: String,
    /// After "must".
    pub rule: String,
    /// As the user wrote it.
    pub got: String,
    /// Why, or what to do, in brackets after a space; or nothing.
    pub remedy: &'static str,
}

fn prefix(key: &str) -> String {
    if key.is_empty() {
        String::new()
    } else {
        format!("{key}: ")
    }
}

/// A rule, and a remedy for who breaks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explained(pub Rule, pub &'static str);

impl Explained {
    /// As [`Rule::check`].
    ///
    /// # Errors
    /// Where the value breaks the rule.
    pub fn check(self, key: &str, value: &impl Checked) -> Result<(), OutOfRange> {
        (self.0.check(key, value)).map_err(|error| error.explained(self.1))
    }
}

/// A value with a rule; one that may be left out is checked where it is there.
pub trait Checked {
    /// The number, and how it is written.
    fn written(&self) -> Option<(f64, String)>;
}

impl Rule {
    /// Whether the value of `key` keeps the rule.
    ///
    /// # Errors
    /// Where it does not.
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
            Self::Within(least, most, "") => write!(f, "lie in [{least}, {most}]"),
            Self::Within(least, most, unit) => write!(f, "lie in [{least}, {most}] {unit}"),
        }
    }
}

impl OutOfRange {
    /// `got` breaks a rule, which reads on after "must".
    pub fn new(key: impl Into<String>, rule: impl Display, got: impl Display) -> Self {
        Self {
            key: key.into(),
            rule: rule.to_string(),
            got: shorten(&got.to_string()).into_owned(),
            remedy: "",
        }
    }

    /// The same of a value without a key; what stands in brackets behind the rule is the remedy.
    pub fn of(rule: &'static str, got: impl Display) -> Self {
        let (rule, remedy) = rule.split_at(rule.find(" (").unwrap_or(rule.len()));
        Self::new("", rule, got).explained(remedy)
    }

    /// The same with a remedy.
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
