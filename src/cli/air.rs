//! A barometer beside the accelerometer, for `track`: its flags, and what is printed of it.

use super::output::apart;
use super::rides::Rides;
use super::{Failure, warn};
use anyhow::anyhow;
use clap::Args;
use liftsim::recording::{Barometer, Recording};
use liftsim::track::{Barometric, Climbs, Track, TrackSettings, hidden};
use std::path::{Path, PathBuf};

/// The air that lifts are in, °C.
const AIR: (f64, f64) = (-60.0, 60.0);

/// A barometer, and the air that it measures.
#[derive(Debug, Args)]
#[command(next_help_heading = "The barometer")]
pub struct AirArguments {
    /// The recording of a barometer: heights beside the distances, and which way is up where gravity does not show it
    /// [default: one that was recorded with the acceleration, in the same file or in one beside it that is called alike; none
    /// where --rate, --time, --time-unit or --member is given].
    #[arg(long, value_name = "FILE")]
    barometer: Option<PathBuf>,
    /// Use no barometer.
    #[arg(long, conflicts_with = "barometer")]
    no_barometer: bool,
    /// The temperature of the air, °C; heights are in proportion to its distance from −273.15 [default: that with which
    /// they are the distances, near 20].
    #[arg(long, value_name = "CELSIUS", allow_negative_numbers = true, value_parser = celsius)]
    temperature: Option<f64>,
}

/// Measured rides, and their heights where there is a barometer.
pub struct Measured {
    pub rides: Rides,
    pub track: Track,
    pub heights: Option<(Barometer, Climbs)>,
    /// Why one that was found is not used.
    pub unused: Option<String>,
}

fn celsius(text: &str) -> Result<f64, String> {
    let celsius = text.parse().ok().filter(|it| (AIR.0..=AIR.1).contains(it));
    celsius.ok_or_else(|| format!("must be a temperature of {} to {} °C", AIR.0, AIR.1))
}

impl AirArguments {
    /// Refuses outputs that are the barometer.
    pub fn apart<'a>(&'a self, outputs: impl Iterator<Item = &'a PathBuf>) -> Result<(), Failure> {
        (self.barometer.as_ref()).map_or(Ok(()), |barometer| apart(barometer, outputs))
    }

    /// Measures rides, with the barometer if there is one. Where the record does not say which way is up, it does.
    pub fn measure(&self, rides: Rides, recording: &Path) -> Result<Measured, Failure> {
        let mut measured = Measured {
            track: track(&rides),
            rides,
            heights: None,
            unused: None,
        };
        let (barometer, ahead) = match self.barometer(recording, &measured.rides)? {
            Found::Used(barometer, ahead) => (barometer, ahead),
            Found::Unused(why) => {
                warn(&why);
                measured.unused = Some(without_folder(&why, recording));
                return Ok(measured);
            }
            Found::None => return Ok(measured),
        };
        let climbs = |track: &Track| Climbs::of(&track.trips, &barometer, ahead, self.temperature);
        let mut heights = climbs(&measured.track);
        let is_sign_known = measured.rides.recording.vertical().is_sign_known;
        if let (Some(is_upside_down), false) = (heights.upside_down, is_sign_known) {
            measured.rides = measured.rides.with_up(is_upside_down)?;
            if is_upside_down {
                measured.track = track(&measured.rides);
                heights = climbs(&measured.track);
            }
        }
        let (detection, recording) = (&measured.rides.detection, &measured.rides.recording);
        let unseen = hidden(detection, recording.samples());
        measured.track.rise(&heights, &unseen);
        measured.heights = Some((barometer, heights));
        Ok(measured)
    }

    fn barometer(&self, path: &Path, rides: &Rides) -> Result<Found, Failure> {
        if self.no_barometer {
            return Ok(Found::None);
        }
        let (found, is_given) = match &self.barometer {
            Some(file) => (Barometer::open(file).map(Some), true),
            None if rides.is_told => (Ok(None), false),
            None => (Barometer::recorded_with(path), false),
        };
        let found = found.map_err(|error| anyhow!(error));
        let used = found.and_then(|it| {
            it.map(|it| on_the_clock_of(&rides.recording, it))
                .transpose()
        });
        match used {
            Err(error) if is_given => Err(Failure::Input(error)),
            Err(error) => Ok(Found::Unused(format!(
                "the barometer is not used: {error:#}"
            ))),
            Ok(Some((barometer, ahead))) => Ok(Found::Used(barometer, ahead)),
            Ok(None) => Ok(Found::None),
        }
    }
}

/// A barometer that was looked for.
enum Found {
    None,
    /// And how far the recording's clock is ahead of its, s.
    Used(Barometer, f64),
    /// It cannot be used, and why.
    Unused(String),
}

/// A message without the folder that a recording is in, for what is passed on.
fn without_folder(message: &str, recording: &Path) -> String {
    let folder = recording.parent().filter(|it| *it != Path::new(""));
    folder.map_or(message.to_owned(), |folder| {
        message.replace(&format!("{}/", folder.display()), "")
    })
}

/// A barometer whose clock is that of a recording, and how far the latter's is ahead.
fn on_the_clock_of(
    recording: &Recording,
    barometer: Barometer,
) -> anyhow::Result<(Barometer, f64)> {
    let facts = recording.facts();
    let ahead = match (barometer.clock_offset, facts.clock_offset) {
        (Some(own), Some(other)) => own - other,
        (None, None) => 0.0,
        _ => {
            return Err(anyhow!(
                "{}: only one of the two clocks has dates (give both the same clock)",
                barometer.file
            ));
        }
    };
    let times = || barometer.readings.iter().map(|it| it.time + ahead);
    let (from, to) = times().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
        (low.min(it), high.max(it))
    });
    if from >= facts.end || to <= facts.start {
        return Err(anyhow!(
            "{}: its times, {from:.1} to {to:.1} s, are not those of the recording, {:.1} to {:.1} s (give both the same \
             clock, or leave it out with --no-barometer)",
            barometer.file,
            facts.start,
            facts.end
        ));
    }
    Ok((barometer, ahead))
}

fn track(rides: &Rides) -> Track {
    let recording = &rides.recording;
    let step = recording.facts().coarse_step;
    let settings = TrackSettings::default();
    Track::of(recording.samples(), step, &rides.detection, settings)
}

/// The barometer and the air, in lines.
pub fn text(of: &Barometric) -> String {
    format!(
        "barometer: {}, \"{}\" ({}), {} readings, deviation {:.2} m\nair: {}\n",
        of.file, of.column, of.unit, of.readings, of.noise, of.air,
    )
}
