//! `liftsim plot DIR`: draws the figure again from the stored rows.

use super::output::Output;
use super::store::{line, store, stored};
use super::{CommandResult, Failure, print};
use clap::Args;
use liftsim::figure;
use liftsim::plot::WIDTH;
use liftsim::results::Directory;
use liftsim::run::DrawError;
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw the figure of a result directory again, from its counts; simulate nothing.
///
/// With --figure it is drawn to a file of your own, as wide as your page wants it. Type is as large as in any other
/// width, 7 points at least; the layout changes.
#[derive(Debug, Args)]
#[command(after_help = "For a column of a journal:\n  \
    liftsim plot results/fig6 --figure fig6.pdf --width 88 --no-caption")]
pub struct Plot {
    /// A directory of `sweep`.
    directory: PathBuf,
    /// Draw to this file, and leave the directory as it is.
    #[arg(long, value_name = "FILE.pdf|FILE.svg|FILE.png")]
    figure: Option<PathBuf>,
    /// The width of the figure, mm [default: 140].
    #[arg(long, value_name = "MM", requires = "figure", value_parser = width)]
    width: Option<f64>,
    /// Dots per inch of a PNG.
    #[arg(long, value_name = "N", requires = "figure", default_value_t = figure::DPI)]
    #[arg(value_parser = clap::value_parser!(u32).range(50..=1200))]
    dpi: u32,
    /// Leave the caption out.
    #[arg(long, requires = "figure")]
    no_caption: bool,
    /// Leave the legend out.
    #[arg(long, requires = "figure")]
    no_legend: bool,
    /// Replace the file if it exists.
    #[arg(long, requires = "figure")]
    force: bool,
}

/// How the name of a figure may end.
const KINDS: [&str; 3] = ["pdf", "svg", "png"];

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;

impl Plot {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let file = match &self.figure {
            Some(path) => Some(Output::named(path, self.force, "--figure", &KINDS)?),
            None => None,
        };
        let directory = Directory::new(self.directory.clone());
        directory.manifest().map_err(Failure::input)?;
        let _lock = directory.lock().map_err(Failure::input)?;
        let mut manifest = directory.manifest().map_err(Failure::input)?;
        let study = stored(&directory, &manifest.origin)?;
        let points = directory.points(&manifest).map_err(Failure::input)?;
        let comparisons = directory.comparisons(&manifest).map_err(Failure::input)?;
        (study.verify(&points, &comparisons))
            .map_err(|error| Failure::input(directory.impossible(&error)))?;
        let undrawn = |error| match error {
            DrawError::Rows(error) => Failure::input(directory.damaged_points(error)),
            DrawError::Figure(error) => Failure::run(error),
        };
        if let Some(file) = file {
            let plot = self.changed(study.plot(&points, &manifest).map_err(undrawn)?);
            let path = file.path().display().to_string();
            (file.draw_at(&plot, &manifest.provenance(), self.dpi)?).publish()?;
            print(&format!("{path}  written\n"))?;
            return Ok(ExitCode::SUCCESS);
        }
        let drawing = study.draw(&points, &manifest).map_err(undrawn)?;
        for (name, bytes) in drawing.files() {
            let is_new = store(&directory, &mut manifest, name, bytes)?;
            print(&line(&directory, name, is_new))?;
        }
        directory
            .write("run.json", &manifest.to_json())
            .map_err(Failure::run)?;
        Ok(ExitCode::SUCCESS)
    }

    /// The plot as the flags want it.
    fn changed(&self, mut plot: liftsim::plot::Plot) -> liftsim::plot::Plot {
        if self.no_caption {
            plot.caption.clear();
        }
        if self.no_legend {
            plot.legend = None;
        }
        match self.width {
            Some(width) if (width * POINTS - WIDTH).abs() > 1.0 => plot.resized(width * POINTS),
            _ => plot,
        }
    }
}

fn width(text: &str) -> Result<f64, String> {
    let width = text.parse().ok();
    let width = width.filter(|width| (60.0..=300.0).contains(width));
    width.ok_or_else(|| "must lie in 60 to 300 mm".to_owned())
}
