//! `liftsim status DIR…`: shows the progress of each directory.

use super::rows::{FormatArguments, Rows, Shown, pretty};
use super::{CommandResult, Failure, print, table};
use clap::{Args, ValueHint};
use liftsim::results::Directory;
use liftsim::run::Status;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Say how far each directory is: a result, a run that goes on, a shard, and the shards below it.
#[derive(Debug, Args)]
pub struct StatusCommand {
    /// Directories that `liftsim sweep` writes.
    #[arg(required = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    directories: Vec<PathBuf>,
    #[command(flatten)]
    format: FormatArguments,
}

impl StatusCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let mut found = Vec::new();
        for directory in &self.directories {
            if !directory.is_dir() {
                let place = directory.display();
                return Err(Failure::Input(anyhow::anyhow!(
                    "{place}: no directory (give what `liftsim sweep` writes)"
                )));
            }
            let shards = shards(directory);
            let status = Status::of(&Directory::new(directory));
            if shards.is_empty() || status.experiment.is_some() {
                found.push(facts(directory, &status));
            }
            let each = shards.iter();
            found.extend(each.map(|shard| facts(shard, &Status::of(&Directory::new(shard)))));
        }
        print(&self.format.show(&Found(found)))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What is known of each directory.
struct Found(Vec<Value>);

const COLUMNS: [&str; 8] = [
    "directory",
    "experiment",
    "shard",
    "points",
    "trials",
    "of",
    "percent",
    "state",
];

impl Shown for Found {
    fn text(&self) -> String {
        let mut rows = self.rows();
        for (row, found) in rows.cells.iter_mut().zip(&self.0) {
            let percent = found["percent"].as_f64();
            row[6] = percent.map_or(String::new(), |percent| format!("{percent:.1}"));
        }
        let header = COLUMNS.map(|name| if name == "percent" { "%" } else { name });
        table(&header, &rows.cells)
    }

    fn json(&self) -> String {
        pretty(&json!(self.0))
    }

    fn rows(&self) -> Rows {
        Rows::of(&COLUMNS, &self.0, &Value::Null)
    }
}

/// The directories of the shards, in the order of their numbers.
fn shards(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory.join("shards"));
    let entries = entries.into_iter().flatten().flatten();
    let mut shards: Vec<PathBuf> = (entries.map(|entry| entry.path()))
        .filter(|path| path.is_dir())
        .collect();
    let number = |path: &PathBuf| {
        let name = path.file_name()?.to_str()?;
        name.split('-').next()?.parse::<u64>().ok()
    };
    shards.sort_by_key(|path| (number(path), path.clone()));
    shards
}

fn facts(directory: &Path, status: &Status) -> Value {
    let mut facts = json!({
        "directory": directory.display().to_string(),
        "experiment": status.experiment,
        "shard": status.shard.map(|shard| shard.to_string()),
        "state": status.state.name(),
    });
    if status.experiment.is_some() {
        let Status { done, wanted, .. } = *status;
        facts["points"] = json!(status.points);
        facts["trials"] = json!(done);
        facts["of"] = json!(wanted);
        facts["percent"] = json!(match wanted {
            0 => 100.0,
            _ => done as f64 / wanted as f64 * 100.0,
        });
    }
    facts
}
