//! A barometer beside the accelerometer, for `track`: its flags, and what is printed of it.

use super::output::apart;
use super::rides::Rides;
use super::{Failure, warn};
use anyhow::anyhow;
use clap::Args;
use liftsim::recording::{Barometer, Recording};
use liftsim::track::{Alignment, AlignmentError, Barometric, Climbs, Track, TrackSettings, Unseen};
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
    /// The name of the barometer's column with the pressure, where there are several.
    #[arg(long, value_name = "COLUMN", requires = "barometer")]
    barometer_column: Option<String>,
    /// How far the accelerometer's clock is ahead of the barometer's, s; dates as they are, other times as they are printed
    /// [default: as dates say, or 0 where neither clock has any; where only one has, or where the rides clearly say otherwise, as the
    /// rides say, whose acceleration and pressure must fit].
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = seconds)]
    barometer_ahead: Option<f64>,
    /// Use no barometer.
    #[arg(long, conflicts_with_all = ["barometer", "barometer_ahead"])]
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

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|it: &f64| it.is_finite());
    seconds.ok_or_else(|| "must be a number of seconds".to_owned())
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
        let (barometer, clock) = match self.barometer(recording, &measured)? {
            Found::Used(barometer, clock) => (barometer, clock),
            Found::Unused(why) => {
                warn(&why);
                measured.unused = Some(without_folder(&why, recording));
                return Ok(measured);
            }
            Found::None => return Ok(measured),
        };
        let climbs = |of: &Measured| {
            let unseen = Unseen::of(&of.rides.detection, of.rides.recording.samples());
            let trips = &of.track.trips;
            let mut climbs = Climbs::of(trips, &unseen, &barometer, clock.ahead, self.temperature);
            climbs.alignment = clock.alignment;
            climbs.upside_down = climbs.upside_down.filter(|_| clock.is_checked);
            (climbs, unseen)
        };
        let (mut heights, mut unseen) = climbs(&measured);
        let is_sign_known = measured.rides.recording.vertical().is_sign_known;
        if let (Some(is_upside_down), false) = (heights.upside_down, is_sign_known) {
            measured.rides = measured.rides.with_up(is_upside_down)?;
            if is_upside_down {
                measured.track = track(&measured.rides);
                (heights, unseen) = climbs(&measured);
            }
        }
        measured.track.rise(&heights, &unseen);
        measured.heights = Some((barometer, heights));
        Ok(measured)
    }

    fn barometer(&self, path: &Path, measured: &Measured) -> Result<Found, Failure> {
        if self.no_barometer {
            return Ok(Found::None);
        }
        let (found, is_given) = match &self.barometer {
            Some(file) => {
                let column = self.barometer_column.as_deref();
                (Barometer::open(file, column).map(Some), true)
            }
            None if measured.rides.is_told => (Ok(None), false),
            None => (Barometer::recorded_with(path), false),
        };
        let found = found.map_err(|error| anyhow!(error));
        let used = found.and_then(|it| {
            it.map(|it| Ok((self.clock(measured, &it)?, it)))
                .transpose()
        });
        match used {
            Err(error) if is_given => Err(Failure::Input(error)),
            Err(error) => Ok(Found::Unused(format!(
                "the barometer is not used: {error:#}"
            ))),
            Ok(Some((clock, barometer))) => Ok(Found::Used(barometer, clock)),
            Ok(None) if self.barometer_ahead.is_some() => Err(Failure::Input(anyhow!(
                "--barometer-ahead: no barometer was recorded with the acceleration (give --barometer FILE)"
            ))),
            Ok(None) => Ok(Found::None),
        }
    }

    /// How far the recording's clock is ahead of a barometer's: as given, as they say, or as the rides say.
    fn clock(&self, of: &Measured, barometer: &Barometer) -> anyhow::Result<Clock> {
        let recording = &of.rides.recording;
        let dates = [barometer.clock_offset, recording.facts().clock_offset];
        // Times count from their dates; what is given, and printed, is between the clocks themselves.
        let dated = match dates {
            [Some(own), Some(other)] => own - other,
            _ => 0.0,
        };
        let said = match (self.barometer_ahead, dates) {
            (Some(given), _) => overlapping(recording, barometer, dated + given),
            (None, [Some(_), Some(_)] | [None, None]) => overlapping(recording, barometer, dated),
            _ => Err(anyhow!("only one of the two clocks has dates")),
        };
        let file = &barometer.file;
        if self.barometer_ahead.is_some() {
            let said =
                said.map_err(|why| anyhow!("{file}: {why} (give another --barometer-ahead)"))?;
            return Ok(Clock::of(said));
        }
        let is_up_known = recording.vertical().is_sign_known;
        let known = said.as_ref().ok().copied();
        let align = |is_up_known| {
            let detection = &of.rides.detection;
            (of.track).align(detection, barometer, known, self.temperature, is_up_known)
        };
        let aligned = align(is_up_known).or_else(|error| match align(false) {
            // A sensor that hangs upside down tells nothing against its clock.
            Ok(None) => Ok(None),
            _ => Err(error),
        });
        match (said, aligned) {
            (_, Ok(Some(by_rides))) => {
                let alignment = Alignment {
                    ahead: by_rides.ahead - dated,
                    instead_of: by_rides.instead_of.map(|it| it - dated),
                    ..by_rides
                };
                Ok(Clock {
                    alignment: Some(alignment),
                    ..Clock::of(by_rides.ahead)
                })
            }
            (Ok(said), Ok(None) | Err(AlignmentError::NoRide)) => Ok(Clock::of(said)),
            // Rides that are all alike, or few, tell of no clock: nor of which way is up.
            (Ok(said), Err(error)) => {
                let up = if is_up_known {
                    ""
                } else {
                    ", nor which way is up"
                };
                warn(format_args!(
                    "{file}: the rides do not show whether its clock is right{up}: {error} (--barometer-ahead SECONDS says it, 0 \
                     where the clocks are the same)"
                ));
                Ok(Clock {
                    is_checked: false,
                    ..Clock::of(said)
                })
            }
            (Err(why), Ok(None)) => Err(why),
            (Err(why), Err(error)) => Err(anyhow!(
                "{file}: {why}, and the clocks cannot be aligned, because {error} (give --barometer-ahead SECONDS, or leave it out with \
                 --no-barometer)"
            )),
        }
    }
}

/// How far a recording's clock is ahead of a barometer's.
#[derive(Clone, Copy)]
struct Clock {
    /// s.
    ahead: f64,
    /// How that was found by the rides, if so.
    alignment: Option<Alignment>,
    /// Whether the user says so, or the rides do not speak against it.
    is_checked: bool,
}

impl Clock {
    fn of(ahead: f64) -> Self {
        Self {
            ahead,
            alignment: None,
            is_checked: true,
        }
    }
}

/// A barometer that was looked for.
enum Found {
    None,
    Used(Barometer, Clock),
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

/// The offset, if with it a barometer has times of the recording.
fn overlapping(recording: &Recording, barometer: &Barometer, ahead: f64) -> anyhow::Result<f64> {
    let facts = recording.facts();
    let [from, to] = [barometer.readings.first(), barometer.readings.last()]
        .map(|it| it.map_or(f64::NAN, |it| it.time + ahead));
    if from < facts.end && to > facts.start {
        return Ok(ahead);
    }
    Err(anyhow!(
        "its times, {from:.1} to {to:.1} s, are not those of the recording, {:.1} to {:.1} s",
        facts.start,
        facts.end
    ))
}

fn track(rides: &Rides) -> Track {
    let recording = &rides.recording;
    let step = recording.facts().coarse_step;
    let settings = TrackSettings::default();
    Track::of(recording.samples(), step, &rides.detection, settings)
}

/// The barometer and the air, in lines.
pub fn text(of: &Barometric) -> String {
    let clock = of.alignment.map_or(String::new(), |it| format!(", {it}"));
    format!(
        "barometer: {}, \"{}\" ({}), {} readings, {}{clock}\nair: {}\n",
        of.file,
        of.column,
        of.unit,
        of.readings,
        of.fineness(),
        of.air,
    )
}
