//! What a report says of the quality of all rides.

use super::limits::{Limits, Verdict};
use super::{Measure, Quality};
use crate::track::Tracked;
use serde::Serialize;

/// The norm, and what is beyond it.
#[derive(Clone, Debug, Serialize)]
pub struct QualityReport {
    /// Whose limits these are.
    pub norm: &'static str,
    /// The speed that they are for, m/s: as given, or of the fastest ride; none if no ride was judged.
    pub rated_speed: Option<f64>,
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
            beyond: beyond.collect(),
            notes,
        }
    }
}
