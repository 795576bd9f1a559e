//! The narrative of a config: `title`, `text`, `order` and any number of `[[claim]]`.
//!
//! The rule behind a verdict (what is tested, the margin, the family-wise level) stands in the config,
//! so it is fixed before the run and its hash is part of the result.

use super::values::{Excess, Level, Margin};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Deref;

/// What the report says of an experiment beside its picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Narrative {
    /// A short heading; by default the name of the file.
    pub title: Option<Words>,
    /// One paragraph for the report. A placeholder becomes a number with its interval: `{rate:LABEL@VALUE}`,
    /// `{false_alarm:LABEL@VALUE}`, `{size:LABEL}`, `{reachable:LABEL}`, `{quantity:NAME}`; an unknown label is refused
    /// with the names of all curves.
    pub text: Option<Words>,
    /// Where the experiment stands among the others: smaller comes first.
    #[serde(default = "order")]
    pub order: u64,
    /// What it tests.
    #[serde(default, rename = "claim")]
    pub claims: Vec<Claim>,
}

/// A statement of the paper and how it is put to the test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The statement.
    pub claim: Words,
    /// Where the paper makes it; none for a comparison that is this project's own.
    pub source: Option<Words>,
    /// The probability of a wrong verdict, over all comparisons of this claim.
    #[serde(default = "level")]
    pub level: Level,
    /// Differences up to this size do not count.
    #[serde(default = "margin")]
    pub margin: Margin,
    /// What is tested.
    pub test: Test,
}

/// What a claim says of the results, with curves by their labels: in a config a name or a table with one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[allow(missing_docs, reason = "the keys of a test are explained beside it")]
pub enum Test {
    /// Each of these curves (by default of all) grows along the axis.
    Grows { curves: Option<Vec<String>> },
    /// The first curve of each contrast lies above the second.
    Exceeds(Contrasts),
    /// Both curves of each contrast are equivalent within ± the margin.
    Equals(Contrasts),
    /// No false-alarm rate of these curves (by default of all) is above α beyond doubt, and each is surely
    /// at most `excess` times α.
    AlphaHeld {
        curves: Option<Vec<String>>,
        #[serde(default = "excess")]
        excess: Excess,
    },
    /// A number of `quantities.csv` lies in [from, to], of which one end may be left out.
    Quantity {
        name: Words,
        from: Option<f64>,
        to: Option<f64>,
    },
    /// The first curve needs a smaller Δ than the second for the same power, by more than `from` decibels.
    Gain {
        first: String,
        second: String,
        #[serde(default = "power")]
        power: Level,
        #[serde(default)]
        from: f64,
    },
}

/// What is compared with what: two curves by their labels, two series or two panels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "as the claim has them")]
pub struct Contrasts {
    pub first: String,
    pub second: String,
}

/// A text that is not blank, in one line, whatever lines it was written in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String")]
#[schemars(with = "String")]
pub struct Words(String);

/// A text without a word.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("must not be blank (say it in words)")]
pub struct Blank;

impl TryFrom<String> for Words {
    type Error = Blank;

    fn try_from(text: String) -> Result<Self, Blank> {
        let words: Vec<&str> = text.split_whitespace().collect();
        if words.is_empty() {
            return Err(Blank);
        }
        Ok(Self(words.join(" ")))
    }
}

impl Deref for Words {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

fn order() -> u64 {
    1000
}

fn level() -> Level {
    Level::new(0.001).expect("a probability")
}

fn margin() -> Margin {
    Margin::new(0.005).expect("below 1")
}

fn excess() -> Excess {
    Excess::new(1.2).expect("above 1")
}

fn power() -> Level {
    Level::new(0.9).expect("a probability")
}
