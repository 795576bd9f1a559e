//! `liftsim man`.

use super::{CommandResult, Failure, print};
use clap::{Args, Command};
use clap_mangen::Man as Page;
use std::process::ExitCode;

/// Print the manual of all commands in roff.
///
/// Read it with: liftsim man | man -l -
#[derive(Debug, Args)]
pub struct Man;

impl Man {
    /// Runs the command; `program` is the whole command line.
    pub fn run(self, mut program: Command) -> CommandResult {
        program.build();
        let mut roff = Vec::new();
        let commands = program.get_subcommands();
        let commands = commands.filter(|command| command.get_name() != "help");
        for command in std::iter::once(&program).chain(commands) {
            Page::new(command.clone())
                .render(&mut roff)
                .map_err(Failure::run)?;
        }
        print(&String::from_utf8_lossy(&roff))?;
        Ok(ExitCode::SUCCESS)
    }
}
