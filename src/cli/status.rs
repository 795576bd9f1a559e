//! `liftsim status DIR…`: shows the progress of each directory.

use super::{CommandResult, Failure, print, table};
use clap::{Args, ValueHint};
use liftsim::results::Directory;
use liftsim::run::Status;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Say how far each directory is: a result, a run that goes on, a shard, and the shards below it.
#[derive(Debug, Args)]
pub struct StatusCommand {
    /// Directories that `liftsim sweep` writes.
    #[arg(required = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    directories: Vec<PathBuf>,
}

impl StatusCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let mut rows = Vec::new();
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
                rows.push(row(directory, &status));
            }
            let each = shards.iter();
            rows.extend(each.map(|shard| row(shard, &Status::of(&Directory::new(shard)))));
        }
        let header = [
            "directory",
            "experiment",
            "shard",
            "points",
            "trials",
            "of",
            "%",
            "state",
        ];
        print(&table(&header, &rows))?;
        Ok(ExitCode::SUCCESS)
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

fn row(directory: &Path, status: &Status) -> Vec<String> {
    let Status {
        points,
        done,
        wanted,
        ..
    } = status;
    let numbers = match status.experiment {
        Some(_) => {
            let percent = match wanted {
                0 => 100.0,
                _ => *done as f64 / *wanted as f64 * 100.0,
            };
            [
                points.map_or(String::new(), |points| points.to_string()),
                done.to_string(),
                wanted.to_string(),
                format!("{percent:.1}"),
            ]
        }
        None => [const { String::new() }; 4],
    };
    let shard = status
        .shard
        .map_or(String::new(), |shard| shard.to_string());
    [
        directory.display().to_string(),
        status.experiment.clone().unwrap_or_default(),
        shard,
    ]
    .into_iter()
    .chain(numbers)
    .chain([status.state.name().to_owned()])
    .collect()
}
