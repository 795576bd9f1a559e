//! The quality of the rides of a record, judged, and what a report says of it.

use super::quality::{LEAST_RATE, Limits, Measure, Quality, Ride, Verdict};
use super::record::{Track, Tracked, stretches};
use super::rides::Surroundings;
use crate::detection::Detection;
use crate::explain::Faults;
use crate::recording::{Recording, Sample};
use serde::Serialize;

impl Track {
    /// Judges the quality of its whole rides, as far as the recording shows it. [`Reading::across`](crate::recording::Reading)
    /// adds horizontal vibration.
    pub fn judge(&mut self, recording: &Recording, detection: &Detection) {
        let (sound, _) = Faults::removed(recording.samples());
        let (samples, rate) = (&sound[..], recording.rate());
        let is_filtered = detection.filter.time_constant().is_some();
        if is_filtered || rate < LEAST_RATE || samples.is_empty() {
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
    /// On trips that were judged, in a record of this rate, Hz, for a rated speed, m/s, if that is given.
    pub fn new(trips: &[Tracked], rate: f64, rated_speed: Option<f64>) -> Self {
        let judged = || {
            trips
                .iter()
                .filter_map(|it| Some((it.trip.ride, it.quality?)))
        };
        let speed = |quality: Quality| Some(quality.figure(Measure::Speed95)?.value);
        let fastest = judged().filter_map(|(_, it)| speed(it)).reduce(f64::max);
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
        notes.extend((rate < FULL_RATE - 0.5).then_some(rate_note));
        Self {
            norm: "GB/T 10058-2009, from memory",
            rated_speed,
            beyond,
            limits,
            notes,
        }
    }
}
