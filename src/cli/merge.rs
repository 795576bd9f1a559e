//! `liftsim merge DIR…`: merges shards into one result.

use super::store::stored;
use super::{CommandResult, Failure, output, print, sweep};
use clap::{Args, ValueHint};
use liftsim::results::{Directory, Shard};
use liftsim::run::{self, Absent, MergeError};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Join the shards of one experiment into the files of the whole run.
///
/// The bytes are those of a run without shards. Where shards are missing or unfinished, what is there is
/// joined in counts.json, from which `liftsim sweep` goes on, and the rest is named; the exit code is 0 then,
/// too, and no points.csv is written. The shards are left as they are.
#[derive(Debug, Args)]
pub struct Merge {
    /// Directories that `liftsim sweep --shard` has written.
    #[arg(required = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    directories: Vec<PathBuf>,
    /// Where to write; results/<name of the config>/ by default.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
}

impl Merge {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        if let Some(out) = &self.out {
            output::not_stdout("--out", output::DIRECTORY, out)?;
        }
        let directories: Vec<Directory> =
            self.directories.into_iter().map(Directory::new).collect();
        let origin = run::part(&directories[0]).map_err(Failure::input)?.origin;
        let name = Path::new(&origin.config_name);
        let out = self.out.unwrap_or_else(|| sweep::default_directory(name));
        let loaded = stored(&directories[0], &origin)?;
        let merged = run::merge(&*loaded.study, &origin, &directories, Directory::new(&out));
        let (session, absent) = merged.map_err(failure)?;
        if session.missing().is_none() {
            print(&sweep::finish(&loaded, session, None)?)?;
            return Ok(ExitCode::SUCCESS);
        }
        print(&incomplete(&absent, &origin.command_line(), &out))?;
        Ok(ExitCode::SUCCESS)
    }
}

fn failure(error: MergeError) -> Failure {
    match error {
        MergeError::Results(liftsim::results::ResultsError::Unsaved { .. }) => Failure::run(error),
        error => Failure::input(error),
    }
}

/// Lists the missing parts in words.
fn incomplete(absent: &Absent, command: &str, out: &Path) -> String {
    let mut text = String::from("incomplete:\n");
    if !absent.shards.is_empty() {
        let shards = absent.shards.iter().map(Shard::to_string);
        let shards = shards.collect::<Vec<_>>().join(", ");
        text += &format!("  no directory of shard {shards}\n");
    }
    for (directory, trials) in &absent.unfinished {
        let directory = directory.display();
        text += &format!("  {directory}: {trials} trials of each point are missing\n");
    }
    let counts = out.join("counts.json");
    let (counts, out) = (counts.display(), out.display());
    text + &format!(
        "{counts}  written\nmerge again when they are there, or `{command} --out {out}` \
         simulates them\n"
    )
}
