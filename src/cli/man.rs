//! `liftsim man`.

use super::{Arguments, Failure, Outcome, print};
use clap::{Args, CommandFactory};
use clap_mangen::Man as Page;
use std::process::ExitCode;

/// Print the manual, every command in it, in roff.
///
/// Read it with: liftsim man | man -l -
#[derive(Debug, Args)]
pub struct Man;

impl Man {
    /// Runs the command.
    pub fn run(self) -> Outcome {
        let mut command = Arguments::command();
        command.build();
        let mut roff = Vec::new();
        Page::new(command.clone())
            .render(&mut roff)
            .map_err(Failure::run)?;
        for verb in command
            .get_subcommands()
            .filter(|verb| verb.get_name() != "help")
        {
            Page::new(verb.clone())
                .render(&mut roff)
                .map_err(Failure::run)?;
        }
        print(&String::from_utf8_lossy(&roff))?;
        Ok(ExitCode::SUCCESS)
    }
}
