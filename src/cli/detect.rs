//! `liftsim detect RECORDING`: rest, rides and what decided them, in a recording.

use super::found::Found;
use super::output::{self, Output, Ready};
use super::rides::{RideArguments, Rides};
use super::rows::{FormatArguments, Shown};
use super::{CommandResult, Failure};
use anyhow::anyhow;
use clap::Args;
use liftsim::detection::DetectReport;
use liftsim::figure::{self, FigureError};
use liftsim::monitor::SavedState;
use std::path::PathBuf;
use std::process::ExitCode;

/// Find the rides in a recording: when each started and stopped, where it went, and by what decisions.
///
/// RECORDING is a table as phyphox, Science Journal, Sensor Logger, Physics Toolbox, Xsens, Witmotion, Campbell
/// loggers or an Arduino write it, or any with a column of times and one of acceleration; also in a zip archive,
/// a workbook or JSON. The record is explained as a whole: pulses of acceleration are a ride where their changes of
/// speed sum to zero. Where two explanations are close the stretch is undecided, and both are printed. The whitening
/// filter, and the sample X that every decision compares with, are learnt from the rest in the recording.
///
/// Each decision keeps its level only if the whitened record at rest is exchangeable, and there are twenty a second.
/// The result says how many decisions at rest were wrong in this recording.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    liftsim simulate --out ride.csv && liftsim detect ride.csv --figure ride.png\n  \
    liftsim detect log.csv --time t --acceleration az --unit mg\n  \
    liftsim detect ride.csv --save-state lift.json && liftsim monitor --state lift.json < samples")]
pub struct Detect {
    #[command(flatten)]
    format: FormatArguments,
    /// Write the rides as CSV too.
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
    rides: RideArguments,
}

const NO_REST: &str =
    "too little rest to learn a state from (record a few seconds of rest before or after the ride)";

/// The files for the results.
struct Outputs {
    state: Option<Output>,
    csv: Option<Output>,
    figure: Option<Output>,
}

impl Detect {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let outputs = self.outputs()?;
        let rides = self.rides.find(false)?;
        let Rides {
            recording,
            detection,
            settings: (settings, rate),
            ..
        } = &rides;
        let saved = SavedState {
            first_sample: (recording.samples().first())
                .map(|first| (first.time, first.acceleration)),
            knowledge: detection.knowledge.clone(),
            settings: settings.clone(),
            rate: *rate,
            running: None,
        };
        if saved.knowledge.reference.is_none() && self.save_state.is_some() {
            return Err(self.rides.refused(anyhow!(NO_REST)));
        }
        rides.warn();
        let report = DetectReport::new(self.rides.name(), recording, detection);
        let found = Found { report, detection };
        self.write(outputs, &found, &saved)?;
        output::print_beside(self.files(), &self.format.show(&found))?;
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses what is in the way before anything takes long.
    fn outputs(&self) -> Result<Outputs, Failure> {
        let picture = |path: &PathBuf| Output::picture("--figure", path, self.force);
        let file = |path: &PathBuf| Output::new(path, self.force);
        let outputs = Outputs {
            figure: self.figure.as_ref().map(picture).transpose()?,
            state: self.save_state.as_ref().map(file).transpose()?,
            csv: self.csv.as_ref().map(file).transpose()?,
        };
        self.rides.apart(self.files())?;
        Ok(outputs)
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        let files = [&self.figure, &self.save_state, &self.csv];
        files.into_iter().flatten()
    }

    /// All files or none.
    fn write(&self, to: Outputs, found: &Found, saved: &SavedState) -> Result<(), Failure> {
        let Found { report, detection } = found;
        let mut written = Vec::new();
        if let Some(figure) = to.figure {
            let name = self.rides.name();
            let plot =
                figure::detection::plot(detection, &name, report.recording.counts_from.as_deref());
            let plot = plot.map_err(|error| match error {
                FigureError::Short => self.rides.refused(error.into()),
                error => Failure::run(error),
            })?;
            written.push(figure.draw(&plot, &format!("recording {name}"))?);
        }
        if let Some(state) = to.state {
            written.push(state.write(saved.to_json().as_bytes())?);
        }
        if let Some(csv) = to.csv {
            written.push(csv.write(found.rows().csv().as_bytes())?);
        }
        written.into_iter().try_for_each(Ready::publish)
    }
}
