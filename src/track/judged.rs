//! The quality of the rides of a record, judged, and what a report says of it.

use super::quality::{LEAST_RATE, Limits, Measure, Quality, Ride, Verdict};
use super::record::{Track, Tracked, stretches};
use super::rides::Surroundings;
use crate::detection::Detection;
use crate::explain::Faults;
use crate::recording::{Recording, Sample};
use serde::Serialize;

/// What a record does not show of the quality of its rides.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum QualityWarning {
    /// The filter changes what is judged.
    #[error(
        "no ride is judged: behind a high-pass filter accelerations and jerks are not those of the car (record the raw \
         accelerometer, with g)"
    )]
    Filter,
    /// Its rate, Hz, is below [`LEAST_RATE`].
    #[error(
        "no ride is judged: at {0:.1} Hz the record holds no vibration (record {LEAST_RATE} Hz or more, best 200 Hz)"
    )]
    Rate(f64),
    /// Horizontal vibration is not in it.
    #[error("horizontal vibration is not judged: only one axis was read (record all three)")]
    OneAxis,
}

impl QualityWarning {
    /// That of a recording, if there is one.
    pub fn of(recording: &Recording, detection: &Detection) -> Option<Self> {
        let rate = recording.rate();
        if detection.filter.time_constant().is_some() {
            Some(Self::Filter)
        } else if rate < LEAST_RATE {
            Some(Self::Rate(rate))
        } else {
            recording.across().is_none().then_some(Self::OneAxis)
        }
    }

    /// Whether no ride can be judged.
    fn forbids(self) -> bool {
        self != Self::OneAxis
    }
}

impl Track {
    /// Judges the quality of its whole rides, as far as the recording shows it. [`Reading::across`](crate::recording::Reading)
    /// adds horizontal vibration.
    pub fn judge(&mut self, recording: &Recording, detection: &Detection) {
        let (sound, _) = Faults::removed(recording.samples());
        let (samples, rate) = (&sound[..], recording.rate());
        let warning = QualityWarning::of(recording, detection);
        if warning.is_some_and(QualityWarning::forbids) || samples.is_empty() {
            return;
        }
        let across: &[Vec<Sample>] = recording.across().map_or(&[], |both| both);
        let surroundings = Surroundings::new(detection, stretches(samples));
        for tracked in &mut self.trips {
            let trip = &tracked.trip;
            let phases = trip
                .stop
                .and_then(|_| surroundings.phases(trip, &self.settings));
            let sign = trip.direction.sign();
            let ride = phases.map(|phases| Ride { phases, sign });
            tracked.quality = ride.and_then(|ride| Quality::of(samples, across, rate, &ride));
        }
    }
}

/// The norm, and what is beyond it.
#[derive(Clone, Debug, Serialize)]
pub struct QualityReport {
    /// What the record does not show.
    #[serde(skip)]
    pub warning: Option<QualityWarning>,
    /// Whose limits these are.
    pub norm: &'static str,
    /// The speed that they are for, m/s: as given, or of the fastest ride; none if no ride was judged.
    pub rated_speed: Option<f64>,
    /// They themselves.
    #[serde(skip)]
    pub limits: Limits,
    /// The figures that are beyond them.
    pub beyond: Vec<Beyond>,
    /// What to know of the figures.
    pub notes: Vec<String>,
}

/// A figure of a ride beyond its limit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Beyond {
    /// The ride's number.
    pub ride: usize,
    /// The figure's column.
    pub figure: &'static str,
    /// In the unit of its measure.
    pub value: f64,
    /// Whether it may be noise.
    pub verdict: Verdict,
}

/// Below this rate, Hz, a record lacks some of the vibration that is weighted.
const FULL_RATE: f64 = 200.0;

impl QualityReport {
    /// On trips that were judged, for a rated speed, m/s, if that is given.
    pub fn new(
        trips: &[Tracked],
        recording: &Recording,
        detection: &Detection,
        rated_speed: Option<f64>,
    ) -> Self {
        let rate = recording.rate();
        let judged = || {
            trips
                .iter()
                .filter_map(|it| Some((it.trip.ride, it.quality?)))
        };
        let speed = |quality: Quality| Some(quality.figure(Measure::Speed95)?.value);
        let fastest = judged().filter_map(|(_, it)| speed(it)).reduce(f64::max);
        let is_assumed = rated_speed.is_none() && fastest.is_some();
        let rated_speed = fastest.map(|fastest| rated_speed.unwrap_or(fastest));
        let limits = Limits::gb_t_10058(rated_speed.unwrap_or_default());
        let beyond = judged().flat_map(|(ride, quality)| {
            let of_ride = Measure::ALL.map(|measure| {
                let verdict = limits
                    .verdict(&quality, measure)
                    .filter(|it| *it != Verdict::Pass)?;
                Some(Beyond {
                    ride,
                    figure: measure.name(),
                    value: quality.figure(measure)?.value,
                    verdict,
                })
            });
            of_ride.into_iter().flatten()
        });
        let beyond: Vec<Beyond> = beyond.collect();
        let rate_note = format!(
            "vibration above {:.0} Hz is not in a record of {rate:.0} Hz",
            rate / 2.0
        );
        let mut notes = vec![
            "limits and definitions are from memory and from what others write of the norms; only the weightings were checked \
             against a table"
                .to_owned(),
        ];
        let speed_note = "the rated speed is taken to be that of the fastest ride (--rated-speed)";
        notes.extend(is_assumed.then(|| speed_note.to_owned()));
        notes.extend((rate < FULL_RATE - 0.5).then_some(rate_note));
        Self {
            warning: QualityWarning::of(recording, detection),
            norm: "GB/T 10058-2009, from memory",
            rated_speed,
            beyond,
            limits,
            notes,
        }
    }
    /// What its marks and gaps mean, and its notes, a line each.
    pub fn remarks(&self, rides: &[Tracked]) -> Vec<String> {
        if self.rated_speed.is_none() {
            let none = "no ride is judged: none is in the record with a second of rest around it, and no hole";
            let why = self.warning.filter(|it| it.forbids());
            return vec![why.map_or(none.to_owned(), |why| why.to_string())];
        }
        let judged = rides.iter().filter_map(|it| it.quality);
        let mut figures = judged.flat_map(|it| Measure::ALL.map(|measure| it.figure(measure)));
        let noise = figures
            .any(|it| it.is_some_and(|it| it.is_noise()))
            .then_some("~: at most 1.5 times what the sensor shows at rest: this may be its noise");
        let others = rides.iter().filter(|it| it.quality.is_none());
        let others: Vec<String> = others.map(|it| it.trip.ride.to_string()).collect();
        let others = (!others.is_empty()).then(|| {
            format!(
                "not judged, since it has a hole, or is not in the record with a second of rest around it: ride {}",
                others.join(", ")
            )
        });
        let notes = self.notes.iter().cloned();
        noise
            .map(str::to_owned)
            .into_iter()
            .chain(others)
            .chain(notes)
            .collect()
    }
}
