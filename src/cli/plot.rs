//! `liftsim plot DIR`: draws the figure again from the stored rows.

use super::store::{line, store, stored};
use super::{CommandResult, Failure, print};
use clap::Args;
use liftsim::results::Directory;
use liftsim::run::DrawError;
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw the figure of a result directory again, from its counts; simulate nothing.
#[derive(Debug, Args)]
pub struct Plot {
    /// A directory of `sweep`.
    directory: PathBuf,
}

impl Plot {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let directory = Directory::new(self.directory);
        directory.manifest().map_err(Failure::input)?;
        let _lock = directory.lock().map_err(Failure::input)?;
        let mut manifest = directory.manifest().map_err(Failure::input)?;
        let study = stored(&directory, &manifest.origin)?;
        let points = directory.points(&manifest).map_err(Failure::input)?;
        let comparisons = directory.comparisons(&manifest).map_err(Failure::input)?;
        (study.verify(&points, &comparisons))
            .map_err(|error| Failure::input(directory.impossible(&error)))?;
        let drawing = study
            .draw(&points, &manifest)
            .map_err(|error| match error {
                DrawError::Rows(error) => Failure::input(directory.damaged_points(error)),
                DrawError::Figure(error) => Failure::run(error),
            })?;
        for (name, bytes) in drawing.files() {
            let is_new = store(&directory, &mut manifest, name, bytes)?;
            print(&line(&directory, name, is_new))?;
        }
        directory
            .write("run.json", &manifest.to_json())
            .map_err(Failure::run)?;
        Ok(ExitCode::SUCCESS)
    }
}
