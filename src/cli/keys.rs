//! `liftsim keys`: the reference of every table and key of a config.

use super::{CommandResult, print, simulate};
use clap::Args;
use liftsim::study::reference;
use std::process::ExitCode;

/// Print the reference of every table and key of a config.
///
/// `configs/README.md` and `configs/schema.json` are what it prints.
#[derive(Debug, Args)]
pub struct Keys {
    /// As a JSON Schema, for editors: `#:schema ./schema.json` in a config's first line.
    #[arg(long)]
    schema: bool,
}

impl Keys {
    pub fn run(self) -> CommandResult {
        if self.schema {
            print(&format!("{:#}\n", reference::schema()))?;
        } else {
            print(&(reference::markdown() + &simulate::reference()))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
