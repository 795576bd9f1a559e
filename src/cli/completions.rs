//! `liftsim completions SHELL`.

use super::{CommandResult, print};
use clap::{Args, Command};
use clap_complete::Shell;
use std::process::ExitCode;

/// Print a completion script for a shell.
///
/// For bash: liftsim completions bash > ~/.local/share/bash-completion/completions/liftsim
#[derive(Debug, Args)]
pub struct Completions {
    /// Which shell.
    shell: Shell,
}

impl Completions {
    /// Runs the command; `program` is the whole command line.
    pub fn run(self, mut program: Command) -> CommandResult {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "liftsim", &mut script);
        print(&String::from_utf8_lossy(&script))?;
        Ok(ExitCode::SUCCESS)
    }
}
