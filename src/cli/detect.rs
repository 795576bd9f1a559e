//! `liftsim detect RECORDING`: rest, rides and what decided them, in a recording.

use super::found::Found;
use super::progress;
use super::reading::ReadingArguments;
use super::watch::{Told, Watch, check_strength};
use super::{Failure, Outcome, print};
use anyhow::{Context, anyhow};
use clap::Args;
use indicatif::ProgressBar;
use liftsim::detection::Detection;
use liftsim::figure::{self, FigureError};
use liftsim::monitor::{Briefing, Design, Knowledge};
use liftsim::signal::recording::Recording;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Find the rides in a recording: when each started and stopped, where it went, and by what decisions.
///
/// RECORDING is CSV as phyphox, Science Journal or Sensor Logger write it, or any table with a column of times and
/// one of acceleration, also in a zip archive. What rest is like is learnt from the recording
/// itself: the level, the whitening filter, and the sample X that every decision compares with. So
/// there must be a few seconds of rest in it.
///
/// Each decision keeps its level only if the whitened record at rest is exchangeable, and there are twenty a second.
/// How many at rest were wrong in this recording is said with the result.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    liftsim record --out ride.csv && liftsim detect ride.csv --figure ride.png\n  \
    liftsim detect log.csv --time t --acceleration az --unit mg\n  \
    liftsim detect ride.csv --save-state lift.json && liftsim monitor --state lift.json < samples")]
pub struct Detect {
    /// The recording.
    recording: PathBuf,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Write the rides as CSV.
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Draw the record, the record whitened, the states and the decisions.
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    figure: Option<PathBuf>,
    /// Write what was learnt, for `monitor --state` and `detect --state`.
    #[arg(long, value_name = "FILE.json")]
    save_state: Option<PathBuf>,
    /// Replace files that exist.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    watch: Watch,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl Detect {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> Outcome {
        self.check_outputs()?;
        let Told { config, briefing } = self.watch.told()?;
        let reading = self.reading.over(config.reading)?;
        let recording = Recording::open(&self.recording, &reading).map_err(Failure::input)?;
        let named = || self.recording.display().to_string();
        let facts = recording.facts();
        check_strength(facts.least)
            .and(check_strength(facts.greatest))
            .with_context(named)
            .map_err(Failure::Input)?;
        for warning in recording.warnings() {
            eprintln!("warning: {warning}");
        }
        let passes = if briefing.is_some() { 1 } else { 3 };
        let bar = progress::passes(passes * recording.facts().samples, !quiet);
        let briefing = match briefing {
            Some(briefing) => briefing,
            None => {
                let rate = recording.rate();
                let design = config.settings.at(rate).with_context(named);
                let design = design.map_err(Failure::Input)?;
                Briefing {
                    knowledge: learn(&design, &recording, &self.recording, &bar)?,
                    settings: config.settings,
                    rate,
                }
            }
        };
        let design = briefing.design().map_err(Failure::input)?;
        let samples = recording.samples().map_err(Failure::input)?;
        let samples = progress::seen(samples, &bar);
        let detection = Detection::of(&design, briefing.knowledge.clone(), samples);
        bar.finish_and_clear();
        let detection = detection.map_err(Failure::input)?;
        let found = Found {
            path: &self.recording,
            recording: &recording,
            detection: &detection,
        };
        for warning in found.warnings() {
            eprintln!("warning: {warning}");
        }
        let drawn = (self.figure.as_ref()).map(|_| figure::detection(&detection, &found.name()));
        let drawn = drawn.transpose().map_err(|error| match error {
            FigureError::Short => Failure::Input(anyhow!("{}: {error}", named())),
            error => Failure::run(error),
        })?;
        if let Some(path) = &self.save_state {
            write(path, briefing.to_json().as_bytes(), self.force)?;
        }
        if let Some(path) = &self.csv {
            write(path, &found.csv(), self.force)?;
        }
        if let (Some(path), Some(drawing)) = (&self.figure, drawn) {
            let bytes = match is_svg(path) {
                true => drawing.svg,
                false => drawing.png,
            };
            write(path, &bytes, self.force)?;
        }
        print(&match self.json {
            true => found.json(),
            false => found.table(),
        })?;
        Ok(ExitCode::SUCCESS)
    }

    /// Before anything takes long.
    fn check_outputs(&self) -> Result<(), Failure> {
        let is_picture =
            |path: &PathBuf| path.extension().is_some_and(|e| e == "png" || e == "svg");
        if let Some(path) = self.figure.as_ref().filter(|path| !is_picture(path)) {
            return Err(Failure::Input(anyhow!(
                "--figure must end in .png or .svg, got {}",
                path.display()
            )));
        }
        let outputs = [&self.save_state, &self.csv, &self.figure];
        let in_the_way = |path: &&PathBuf| !self.force && path.exists();
        match outputs.into_iter().flatten().find(in_the_way) {
            Some(path) => Err(exists(path)),
            None => Ok(()),
        }
    }
}

fn learn(
    design: &Design,
    recording: &Recording,
    path: &Path,
    bar: &ProgressBar,
) -> Result<Knowledge, Failure> {
    let pass = || Ok(progress::seen(recording.samples()?, bar));
    let learnt = Knowledge::from_record(design, pass);
    learnt
        .map_err(Failure::input)?
        .with_context(|| path.display().to_string())
        .map_err(Failure::Input)
}

fn is_svg(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "svg")
}

fn exists(path: &Path) -> Failure {
    Failure::Input(anyhow!(
        "{}: is there already (give another name, or --force to replace it)",
        path.display()
    ))
}

fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let mut options = OpenOptions::new();
    match force {
        true => options.create(true).truncate(true),
        false => options.create_new(true),
    };
    options
        .write(true)
        .open(path)
        .and_then(|mut file| file.write_all(bytes))
        .with_context(|| format!("{}: cannot be written", path.display()))
        .map_err(Failure::Input)
}
