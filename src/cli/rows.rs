//! A result in the format that is asked for.

use clap::{Args, ValueEnum};
use liftsim::detection::cell;
use serde_json::Value;

/// The formats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text to be read, its numbers rounded.
    #[default]
    Table,
    /// All that is known.
    Json,
    /// Rows with all digits.
    Csv,
    /// The same rows, to be pasted.
    Markdown,
}

/// The flag that chooses one.
#[derive(Debug, Args)]
pub struct FormatArguments {
    /// Print it as this.
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t)]
    format: Format,
    /// The same as --format json.
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

impl FormatArguments {
    /// A result in this format.
    pub fn show(&self, result: &impl Shown) -> String {
        let format = if self.json { Format::Json } else { self.format };
        format.show(result)
    }
}

/// What can be printed in every format. All of them have the same numbers.
pub trait Shown {
    /// To be read.
    fn text(&self) -> String;
    /// All that is known.
    fn json(&self) -> String;
    /// What becomes CSV and Markdown.
    fn rows(&self) -> Rows;
}

impl Format {
    /// A result in this format.
    pub fn show(self, result: &impl Shown) -> String {
        match self {
            Self::Table => result.text(),
            Self::Json => result.json(),
            Self::Csv => result.rows().csv(),
            Self::Markdown => result.rows().markdown(),
        }
    }
}

/// Cells under the names of their columns.
pub struct Rows {
    pub columns: Vec<String>,
    pub cells: Vec<Vec<String>>,
}

impl Rows {
    /// A row of each object: its values, else those of what is `around` all of them. What is nested has the name of the key
    /// that it is in before its own.
    pub fn of(columns: &[&str], objects: &[Value], around: &Value) -> Self {
        let value = |object: &Value, name: &str| {
            let found = find(object, name).or_else(|| around.get(name));
            found.map_or(String::new(), cell)
        };
        let row = |object| columns.iter().map(|name| value(object, name)).collect();
        Self {
            columns: columns.iter().map(|name| (*name).to_owned()).collect(),
            cells: objects.iter().map(row).collect(),
        }
    }

    /// As CSV.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in std::iter::once(&self.columns).chain(&self.cells) {
            writer.write_record(row).expect("a vector takes it");
        }
        let bytes = writer.into_inner().expect("a vector takes every byte");
        String::from_utf8(bytes).expect("cells are text")
    }

    /// As a table in Markdown.
    fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| {
            let cells: Vec<String> = cells
                .iter()
                .map(|cell| cell.replace('|', "\\|").replace('\n', " "))
                .collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = "|---".repeat(self.columns.len()) + "|\n";
        let rows: String = self.cells.iter().map(line).collect();
        line(&self.columns) + &rule + &rows
    }
}

/// The value of a key, or of one that is nested.
fn find<'a>(object: &'a Value, name: &str) -> Option<&'a Value> {
    let nested = || {
        let mut entries = object.as_object()?.iter();
        entries
            .find_map(|(of, inner)| inner.get(name.strip_prefix(of.as_str())?.strip_prefix('_')?))
    };
    object.get(name).or_else(nested)
}

/// A value as text of several lines.
pub fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}
