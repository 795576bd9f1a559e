//! The front end that `detect` and `track` share: a recording is read and its rides are found.

use super::monitor_options::{Beginning, MonitorArguments, check_strength};
use super::output::apart;
use super::reading::ReadingArguments;
use super::{Failure, warn};
use anyhow::anyhow;
use clap::Args;
use liftsim::detection::Detection;
use liftsim::monitor::{Reference, SavedState, Settings, SettingsError};
use liftsim::recording::{Reading, Recording};
use std::path::{Path, PathBuf};

/// A recording, how it is read, and how rides are found in it.
#[derive(Debug, Args)]
pub struct RideArguments {
    /// The recording.
    recording: PathBuf,
    /// How the recording begins, where you know it: it decides what is undecided otherwise.
    #[arg(long, value_name = "STATE", value_enum)]
    begins: Option<Beginning>,
    #[command(flatten)]
    options: MonitorArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

/// A recording and the rides in it.
pub struct Rides {
    pub recording: Recording,
    pub detection: Detection,
    /// The settings as given, and the rate that they are for, Hz.
    pub settings: (Settings, f64),
    /// Whether the user said how its clock is read, or which table it is.
    pub is_told: bool,
    /// What was known at first: what rest is like, and whether the recording begins with it.
    known: (Option<Reference>, Option<bool>),
}

impl Rides {
    fn of(
        recording: Recording,
        is_told: bool,
        settings: (Settings, f64),
        known: (Option<Reference>, Option<bool>),
    ) -> Result<Self, SettingsError> {
        let design = settings.0.at(settings.1)?;
        let (reference, begins_at_rest) = known.clone();
        let mut detection = Detection::of(&design, recording.samples(), reference, begins_at_rest);
        let zero = recording.facts().clock_zero;
        (detection.trips.iter_mut()).for_each(|trip| trip.date(zero));
        Ok(Self {
            recording,
            detection,
            settings,
            is_told,
            known,
        })
    }

    /// The same with up where a barometer has it, which may be down in the record.
    pub fn with_up(self, is_upside_down: bool) -> Result<Self, Failure> {
        let recording = self.recording.with_up(is_upside_down);
        if !is_upside_down {
            return Ok(Self { recording, ..self });
        }
        Self::of(recording, self.is_told, self.settings, self.known).map_err(Failure::input)
    }

    /// Prints the warnings about the rides.
    pub fn warn(&self) {
        for warning in self.detection.warnings(self.recording.rate()) {
            warn(warning);
        }
    }
}

/// The shortest recording in which anything can be found, s.
const SHORTEST: f64 = 2.0;

impl RideArguments {
    /// Refuses outputs that are the recording, or each other.
    pub fn apart<'a>(&'a self, outputs: impl Iterator<Item = &'a PathBuf>) -> Result<(), Failure> {
        apart(&self.recording, outputs)
    }

    /// Reads the recording, with what is across the vertical or without, and finds its rides; prints the warnings about it.
    pub fn find(&self, across: bool) -> Result<Rides, Failure> {
        let setup = self.options.setup()?;
        let reading = Reading {
            across,
            ..self.reading.over(&setup.config.reading)?
        };
        let recording = self.open(&reading)?;
        let clock = reading.rate.is_some() || reading.time.is_some() || reading.time_unit.is_some();
        let is_told = clock || reading.member.is_some();
        let seconds = recording.facts().end - recording.facts().start;
        if seconds < SHORTEST {
            return Err(self.refused(anyhow!(
                "must last at least {SHORTEST} s, got {seconds:.2} s (record a whole ride, with rest before and after it)"
            )));
        }
        let (reference, settings) = match setup.saved {
            Some(SavedState {
                knowledge,
                settings,
                rate,
                ..
            }) => (knowledge.reference, (settings, rate)),
            None => (None, (setup.config.settings, recording.rate())),
        };
        let known = (reference, self.begins.and_then(Beginning::is_rest));
        let rides = Rides::of(recording, is_told, settings, known);
        rides.map_err(|error| self.refused(error.into()))
    }

    /// Opens the recording, and prints the warnings about it.
    fn open(&self, reading: &Reading) -> Result<Recording, Failure> {
        let recording = Recording::open(&self.recording, reading).map_err(Failure::input)?;
        let facts = recording.facts();
        check_strength(facts.least)
            .and(check_strength(facts.greatest))
            .map_err(|error| self.refused(error))?;
        for warning in recording.warnings() {
            warn(warning);
        }
        Ok(recording)
    }

    /// The recording's file.
    pub fn path(&self) -> &Path {
        &self.recording
    }

    /// The recording's file, without its folder.
    pub fn name(&self) -> String {
        let path = self.recording.as_path();
        let name = path.file_name().unwrap_or(path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// The recording cannot be used.
    pub fn refused(&self, error: anyhow::Error) -> Failure {
        Failure::Input(error.context(self.recording.display().to_string()))
    }
}
