//! `liftsim plot DIR`: draws the figure again from the stored rows.

use super::figure::{FigureFlags, redraw, undrawn, warn_of_notes};
use super::output::{self, Output};
use super::store::stored;
use super::{CommandResult, Failure, print, warn};
use clap::{Args, ValueHint};
use liftsim::figure::{DPI, OVERLAY};
use liftsim::results::{Directory, Origin};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Draw the figure of a result directory again, from its counts; simulate nothing.
///
/// With --figure it is drawn to a file of your own, and the directory is left as it is. Type is as large as in any
/// other width, 7 points at least; the layout changes.
#[derive(Debug, Args)]
#[command(after_help = "For a column of a journal:\n  \
    liftsim plot results/fig6 --figure fig6.pdf --width 88 --no-caption")]
pub struct Plot {
    /// A directory of `sweep`.
    #[arg(value_hint = ValueHint::DirPath)]
    directory: PathBuf,
    /// Draw to this file, and leave the directory as it is.
    #[arg(
        long = "figure",
        value_name = "FILE.pdf|FILE.svg|FILE.png",
        conflicts_with = "format"
    )]
    file: Option<PathBuf>,
    /// Replace the file of --figure if it exists.
    #[arg(long, requires = "file")]
    force: bool,
    #[command(flatten)]
    figure: FigureFlags,
}

/// How the name of a figure may end.
const KINDS: [&str; 3] = ["pdf", "svg", "png"];

impl Plot {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let file = match &self.file {
            Some(path) => Some(Output::named(path, self.force, "--figure", &KINDS)?),
            None => None,
        };
        let directory = Directory::new(self.directory.clone());
        let manifest = directory.manifest().map_err(Failure::input)?;
        let mut study = stored(&directory, &manifest.origin)?;
        // Wherever they came from, the curves of one's own lie in the directory.
        let has_own = manifest.files.contains_key(OVERLAY);
        study.figure.overlay = has_own.then(|| OVERLAY.into());
        self.figure.lay_over(&mut study, directory.path())?;
        let points = directory.points(&manifest).map_err(Failure::input)?;
        let comparisons = directory.comparisons(&manifest).map_err(Failure::input)?;
        (study.verify(&points, &comparisons))
            .map_err(|error| Failure::input(directory.impossible(&error)))?;
        warn_if_changed(&manifest.origin);
        let Some(file) = file else {
            print(&redraw(&study, &directory)?)?;
            return Ok(ExitCode::SUCCESS);
        };
        let (plot, notes) = (study.plot(&points)).map_err(|error| undrawn(&directory, error))?;
        warn_of_notes(&notes);
        let path = file.path().clone();
        let dpi = study.figure.dpi.map_or(DPI, |dpi| dpi.get() as u32);
        (file.draw_at(&plot, &manifest.provenance(), dpi)?).publish()?;
        output::print_written(&path)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Says if a config of that name, here or in configs/, is no longer the one that was run.
fn warn_if_changed(origin: &Origin) {
    let name = &origin.config_name;
    let near = [Path::new(name).to_owned(), Path::new("configs").join(name)];
    for path in near {
        match fs::read_to_string(&path) {
            Ok(text) if text != origin.config => {
                let path = path.display();
                warn(format_args!(
                    "{path} has changed since it was run, and is not what is drawn (`liftsim sweep {path}` runs it)"
                ));
            }
            _ => {}
        }
    }
}
