//! `monitor --save-state`: a running monitor in a file, from which another goes on.

use super::readings::{Readings, Taken};
use super::{Failure, output, warn};
use anyhow::{Context, anyhow};
use liftsim::files;
use liftsim::monitor::{Knowledge, Monitor, Running, RunningError, SavedState};
use liftsim::recording::{Reading, StreamColumns};
use liftsim::track::Watch;
use serde::{Deserialize, Serialize};
use std::io::BufRead;
use std::path::{Path, PathBuf};

/// The build of this program.
const BUILD: &str = concat!(env!("CARGO_PKG_VERSION"), ", ", env!("LIFTSIM_REVISION"));

/// A monitor as it runs, and how far it has read.
#[derive(Serialize, Deserialize)]
pub struct Going {
    pub monitor: Monitor,
    pub trips: Option<Watch>,
    pub columns: Option<StreamColumns>,
    pub taken: Taken,
}

impl Going {
    /// The one in a state, unless another build wrote it.
    pub fn of(saved: &SavedState) -> Result<Option<Self>, Failure> {
        let Some(running) = &saved.running else {
            return Ok(None);
        };
        match running.parts(BUILD) {
            Ok(going) => Ok(Some(going)),
            Err(error @ RunningError::Build(_)) => {
                warn(format_args!(
                    "the saved state {error}: what it knows of rest is used, and what the cage has done is not known"
                ));
                Ok(None)
            }
            Err(error) => Err(Failure::input(error)),
        }
    }

    /// Refuses to read the stream in another way than this one did. Without flags it is read in the same way.
    pub fn check(&self, reading: &Reading, has_drum: bool) -> Result<(), Failure> {
        let Some(columns) = &self.columns else {
            return Ok(());
        };
        if *reading != Reading::default() && reading != columns.options() {
            return Err(Failure::Input(anyhow!(
                "the flags for columns, units and axis are not those with which the saved monitor ran (leave them out, or \
                 begin anew with --begins)"
            )));
        }
        if has_drum != columns.has_drum() {
            let with = match columns.has_drum() {
                true => "with",
                false => "without",
            };
            return Err(Failure::Input(anyhow!(
                "the saved monitor ran {with} --expected-moving (do so again, or begin anew with --begins)"
            )));
        }
        Ok(())
    }
}

/// The file of a running monitor.
pub struct Kept {
    path: PathBuf,
    /// What does not change.
    state: SavedState,
    is_warned: bool,
}

impl Kept {
    /// Refuses a file that is there, but for the one that the monitor goes on from.
    pub fn check(path: &Path, from: Option<&Path>) -> Result<(), Failure> {
        output::not_stdout("--save-state", output::KEPT, path)?;
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            let folder = folder.display();
            return Err(Failure::Input(anyhow!(
                "--save-state: {folder}: no such folder (make it first)"
            )));
        }
        let from = from.map(output::place);
        if path.exists() && from != Some(output::place(path)) {
            let path = path.display();
            return Err(Failure::Input(anyhow!(
                "{path}: --save-state writes over no file but that of --state (go on from it with --state {path}, give another \
                 name, or delete it)"
            )));
        }
        Ok(())
    }

    pub fn new(path: &Path, state: &SavedState) -> Self {
        Self {
            path: path.to_owned(),
            state: SavedState {
                first_sample: None,
                running: None,
                ..state.clone()
            },
            is_warned: false,
        }
    }

    /// Writes it; where that fails, it warns once, and the monitor goes on.
    pub fn save<R: BufRead>(
        &mut self,
        monitor: &Monitor,
        trips: Option<&Watch>,
        readings: &Readings<R>,
    ) {
        if let Err(error) = self.write(monitor, trips, readings)
            && !self.is_warned
        {
            self.is_warned = true;
            warn(format_args!("{error:#} (the monitor goes on)"));
        }
    }

    /// Writes it whole or not at all.
    pub fn write<R: BufRead>(
        &self,
        monitor: &Monitor,
        trips: Option<&Watch>,
        readings: &Readings<R>,
    ) -> anyhow::Result<()> {
        let going = Going {
            monitor: monitor.clone(),
            trips: trips.cloned(),
            columns: readings.columns(),
            taken: readings.taken(),
        };
        let state = SavedState {
            knowledge: Knowledge {
                reference: monitor.reference().cloned(),
                ..self.state.knowledge.clone()
            },
            running: Some(Running::new(BUILD, &going)),
            ..self.state.clone()
        };
        files::replace(&self.path, state.to_json().as_bytes())
            .with_context(|| format!("{}: the state cannot be saved", self.path.display()))
    }
}
