//! The report of `liftsim track`: JSON has all of it, CSV and the table have the trips, under the same names.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::air::Air;
use super::alignment::Alignment;
use super::calibration::Calibration;
use super::climb::CLIMB;
use super::floors::{Floor, Floors};
use super::height::Climbs;
use super::judged::QualityReport;
use super::landing;
use super::level::Level;
use super::quality::Measure;
use super::record::{Track, Tracked};
use super::settings::TrackSettings;
use super::shaken::{self, VibrationReport};
use super::vertical::ByRules;
use crate::detection::{Detection, Event, Recorded, Undecided, cell, columns};
use crate::recording::{Barometer, Recording};
use serde::Serialize;
use serde_json::Value;

/// A recording and its trips.
#[derive(Debug, Serialize)]
pub struct TrackReport<'a> {
    pub recording: Recorded,
    pub warnings: Vec<String>,
    pub settings: &'a TrackSettings,
    /// The sensor as the record shows it.
    pub level: Level,
    /// Gravity at each rest, where three axes are read.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub calibration: Vec<Calibration>,
    /// Whether the vertical turns, and is followed.
    #[serde(skip)]
    pub is_followed: bool,
    /// The floors after the trips, from the lowest up, where any are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floors: Option<Vec<Floor>>,
    /// The barometer, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub barometer: Option<Barometric<'a>>,
    /// How the rides were judged, where that is asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quality: Option<QualityReport>,
    /// The trips by the published rules, where that is asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rules: Option<ByRules>,
    /// How the rides vibrate beside what is usual, where that is asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vibration: Option<VibrationReport>,
    pub rides: &'a [Tracked],
    pub undecided: &'a [Undecided],
    pub events: &'a [Event],
}

/// A barometer and what it says of the air.
#[derive(Debug, Serialize)]
pub struct Barometric<'a> {
    pub file: &'a str,
    pub column: &'a str,
    pub unit: String,
    pub readings: usize,
    /// The deviation of a reading, m.
    pub noise: f64,
    /// Its steps, where they are coarser than that, m.
    pub step: Option<f64>,
    /// How its clock was aligned by the rides, where that was needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alignment: Option<Alignment>,
    pub air: Air,
}

impl<'a> Barometric<'a> {
    fn new(of: &'a Barometer, climbs: &Climbs) -> Self {
        Self {
            file: &of.file,
            column: &of.column,
            unit: of.unit.to_string(),
            readings: of.readings.len(),
            noise: climbs.noise,
            step: climbs.step,
            alignment: climbs.alignment,
            air: climbs.air,
        }
    }

    /// How fine its readings are.
    pub fn fineness(&self) -> String {
        match self.step {
            Some(step) => format!("steps of {step:.2} m"),
            None if self.noise == 0.0 => "no changes at rest".to_owned(),
            None => format!("deviation {:.2} m", self.noise.max(0.01)),
        }
    }
}

impl<'a> TrackReport<'a> {
    /// The report on a recording called `file`.
    pub fn new(
        file: String,
        recording: &Recording,
        detection: &'a Detection,
        track: &'a Track,
        floors: Option<&Floors>,
        barometer: Option<(&'a Barometer, &Climbs)>,
    ) -> Self {
        let of_recording = recording.warnings().iter().map(ToString::to_string);
        let of_detection = detection.warnings(recording.rate()).into_iter();
        let of_track = track.warnings().into_iter();
        let of_barometer = barometer.iter().flat_map(|(of, _)| &of.warnings);
        let of_heights = barometer
            .iter()
            .flat_map(|(_, climbs)| climbs.warnings(&track.trips));
        Self {
            warnings: of_recording
                .chain(of_detection.map(|it| it.to_string()))
                .chain(of_track.map(|it| it.to_string()))
                .chain(of_barometer.map(ToString::to_string))
                .chain(of_heights.map(|it| it.to_string()))
                .collect(),
            recording: Recorded::of(file, recording, detection),
            settings: &track.settings,
            level: track.level,
            calibration: track.calibrations(recording),
            is_followed: recording.vertical().is_followed(),
            floors: floors.map(Floors::floors),
            barometer: barometer.map(|(of, climbs)| Barometric::new(of, climbs)),
            quality: None,
            rules: None,
            vibration: None,
            rides: &track.trips,
            undecided: &detection.undecided,
            events: &detection.events,
        }
    }

    /// The same with the quality of its rides.
    pub fn with_quality(mut self, quality: Option<QualityReport>) -> Self {
        let warning = quality.as_ref().and_then(|it| it.warning);
        self.warnings.extend(warning.map(|it| it.to_string()));
        Self { quality, ..self }
    }

    pub fn json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        json.expect("a report is plain data") + "\n"
    }

    /// The names of the columns of [`TrackReport::rows`].
    pub fn columns(&self) -> Vec<String> {
        let measured = MEASURED.iter().map(|name| (*name).to_owned());
        let landing = self.floors.iter().flat_map(|_| landing::columns());
        let climb = self.barometer.iter().flat_map(|_| CLIMB);
        let quality = self.quality.iter().flat_map(|_| Measure::ALL);
        let quality = quality.map(|it| it.name().to_owned());
        let vibration = self.vibration.iter().flat_map(|_| shaken::COLUMNS);
        let measured = measured
            .chain(landing)
            .chain(climb.map(str::to_owned))
            .chain(quality)
            .chain(vibration.map(str::to_owned));
        columns().into_iter().chain(measured).collect()
    }

    /// A row for every trip.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let columns = self.columns();
        let row = |ride: &Tracked| {
            columns
                .iter()
                .map(|name| cell(&self.column(ride, name)))
                .collect()
        };
        self.rides.iter().map(row).collect()
    }

    fn column(&self, ride: &Tracked, name: &str) -> Value {
        let vibration = self.vibration.as_ref();
        let value = vibration.and_then(|it| it.column(ride.trip.ride, name));
        value.unwrap_or_else(|| ride.column(name))
    }
}

impl Tracked {
    /// The value of a column; null if it has none.
    pub fn column(&self, name: &str) -> Value {
        let measured = match name {
            "distance" => self.distance,
            "deviation" => self.deviation,
            "closing_speed" => self.closing_speed,
            "widened" => self.widened,
            "height" => self.climb.map(|it| it.height),
            "height_deviation" => self.climb.map(|it| it.height_deviation),
            "height_printed" => self.climb.map(|it| it.height_printed),
            "position" => self.standing.map(|it| it.position),
            "position_deviation" => self.standing.map(|it| it.position_deviation),
            _ => {
                if let Some(measure) = Measure::ALL.into_iter().find(|it| it.name() == name) {
                    return self
                        .quality
                        .and_then(|it| it.figure(measure))
                        .map(|it| it.value)
                        .into();
                }
                let landing = self.landing_column(name);
                return landing.unwrap_or_else(|| self.trip.column(name));
            }
        };
        measured.into()
    }
}

/// The columns that a trip gains where it is measured.
const MEASURED: [&str; 4] = ["distance", "deviation", "closing_speed", "widened"];
