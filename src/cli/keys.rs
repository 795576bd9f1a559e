//! `liftsim keys`: the reference of every table and key of a config.

use super::{CommandResult, Failure, completions, print, simulate};
use anyhow::anyhow;
use clap::Args;
use liftsim::study::reference::{self, Chapter};
use liftsim::suggest::nearest;
use std::collections::BTreeSet;
use std::process::ExitCode;

/// Print the reference of every table and key of a config.
///
/// `configs/README.md` and `configs/schema.json` are what it prints.
#[derive(Debug, Args)]
pub struct Keys {
    /// Only this table, such as whitening, or else the keys of this name in all tables.
    #[arg(conflicts_with = "schema", add = completions::of_keys())]
    name: Option<String>,
    /// As a JSON Schema, for editors: `#:schema ./schema.json` in a config's first line.
    #[arg(long)]
    schema: bool,
}

impl Keys {
    pub fn run(self) -> CommandResult {
        if self.schema {
            print(&format!("{:#}\n", reference::schema()))?;
            return Ok(ExitCode::SUCCESS);
        }
        let mut chapters = chapters();
        if let Some(name) = &self.name {
            let known = chapters.clone();
            chapters = reference::matching(chapters, name);
            if chapters.is_empty() {
                return Err(unknown(name, &known));
            }
        }
        let chapters: Vec<String> = chapters.iter().map(Chapter::to_string).collect();
        print(&chapters.concat())?;
        Ok(ExitCode::SUCCESS)
    }
}

fn chapters() -> Vec<Chapter> {
    vec![
        reference::config(),
        reference::monitor_options(),
        simulate::reference(),
    ]
}

/// The names of all tables and keys.
pub fn names() -> BTreeSet<String> {
    let chapters = chapters();
    let names = chapters.iter().flat_map(Chapter::names);
    names.map(str::to_owned).collect()
}

fn unknown(name: &str, known: &[Chapter]) -> Failure {
    let near = nearest(name, known.iter().flat_map(Chapter::names));
    let hint = near.map_or(String::new(), |near| format!(", did you mean {near}?"));
    Failure::Input(anyhow!(
        "no table or key is called {name}{hint} (`liftsim keys` lists all)"
    ))
}
