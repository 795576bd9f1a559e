//! The formats of the gate: those of all commands, and those of machines that run tests.

use crate::cli::rows;
use clap::ValueEnum;
use clap::builder::PossibleValue;

/// How findings are printed.
#[derive(Clone, Copy, Debug)]
pub enum Format {
    Rows(rows::Format),
    Junit,
    Github,
}

impl Default for Format {
    fn default() -> Self {
        Self::Rows(rows::Format::Table)
    }
}

impl ValueEnum for Format {
    fn value_variants<'a>() -> &'a [Self] {
        use rows::Format::{Csv, Json, Markdown, Table};
        &[
            Self::Rows(Table),
            Self::Rows(Json),
            Self::Rows(Csv),
            Self::Rows(Markdown),
            Self::Junit,
            Self::Github,
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self {
            Self::Rows(format) => return format.to_possible_value(),
            Self::Junit => (
                "junit",
                "XML as test runners write it: a fail is a failure, an inconclusive one is skipped",
            ),
            Self::Github => (
                "github",
                "Annotations of a GitHub workflow: an error for each fail, a warning for each inconclusive one",
            ),
        };
        Some(PossibleValue::new(name).help(help))
    }
}
