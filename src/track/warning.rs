//! Reasons to distrust distances.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::height::Climbs;
use super::height_warning::HeightWarning;
use super::record::{Track, Tracked, Unknown};

/// A reason to distrust distances.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error(
        "distances are not measured: behind a high-pass filter they would be metres wrong (record the raw \
         accelerometer, with g)"
    )]
    Filter,
    #[error(
        "ride {0}: no distance, the record does not hold its start (record a few seconds of rest before the ride)"
    )]
    Start(usize),
    #[error("ride {0}: no distance, a hole hides a change of its speed (record the ride again)")]
    Hole(usize),
    #[error(
        "ride {ride}: the record does not hold its stop; {gone:.2} m is how far it went by then (record a few seconds \
         of rest after the ride)"
    )]
    Stop { ride: usize, gone: f64 },
    #[error(
        "ride {ride}: the speed left at the stop, {speed:.3} m/s, is too much for the noise, so the deviation is \
         widened by {by:.2} m (lay the sensor flat and still, with its gain calibrated)"
    )]
    Closing { ride: usize, speed: f64, by: f64 },
    #[error(
        "the sensor's steps of {step:.3} m/s^2 are coarser than its noise, so the deviations are widened (choose a \
         finer range)"
    )]
    Coarse { step: f64 },
    #[error(
        "at rest the record is {0:.1} times as noisy as the settings say, so the deviations are widened (lay the sensor on the \
         floor of the lift)"
    )]
    Noisy(f64),
    #[error(
        "at rest the sensor reads {0:.2} m/s^2, neither 0 nor 9.8: it is tilted, every distance is wrong by as much, and the \
         deviations do not hold it (lay it flat and read its vertical axis, or record all three axes for `liftsim track`)"
    )]
    Tilted(f64),
}

/// Between them, m/s², a sensor at rest reads gravity along an axis that is not vertical: by 14 degrees or more.
const TILTED: (f64, f64) = (0.5, 9.5);

impl Climbs {
    /// The warnings about the heights of these trips, if the vertical of the record is known.
    pub fn warnings(&self, trips: &[Tracked]) -> Vec<HeightWarning> {
        let clocks = self.alignment.and_then(|by_rides| {
            let said = by_rides.instead_of?;
            Some(HeightWarning::Clocks { by_rides, said })
        });
        // Of a ride without a height nothing is the height.
        let has_height = |of: usize| {
            let mut pairs = trips.iter().zip(&self.climbs);
            pairs.any(|(it, climb)| it.trip.ride == of && climb.is_some())
        };
        let faults = self.faults.iter().filter(|it| match it {
            HeightWarning::Silent { ride, .. } => has_height(*ride),
            _ => true,
        });
        let upside_down = self.upside_down.filter(|it| *it);
        let upside_down = upside_down.map(|_| HeightWarning::UpsideDown);
        let of_trips = trips.iter().zip(&self.climbs).filter_map(|(it, climb)| {
            let ride = it.trip.ride;
            let Some(climb) = climb else {
                let is_whole = it.trip.start.and(it.trip.stop).is_some();
                let is_said = self.faults.iter().any(|it| it.is_frozen(ride));
                return (is_whole && !is_said).then_some(HeightWarning::Missing(ride));
            };
            let unlike = self.unlike.contains(&ride);
            it.distance
                .filter(|_| unlike)
                .map(|distance| HeightWarning::Unlike {
                    ride,
                    height: climb.height,
                    distance,
                })
        });
        clocks
            .into_iter()
            .chain(faults.cloned())
            .chain(upside_down)
            .chain(of_trips)
            .collect()
    }
}

impl Track {
    /// The warnings about its distances.
    pub fn warnings(&self) -> Vec<Warning> {
        let is_filtered = (self.trips.iter()).any(|it| it.unknown == Some(Unknown::Filter));
        let has_distance = self.trips.iter().any(|it| it.distance.is_some());
        let coarse = self.step.map(|step| Warning::Coarse { step });
        // In motion every lift is noisier than the sensor.
        let noisy = self.noisier.map(|power| Warning::Noisy(power.sqrt()));
        let of_axis = Warning::of_bias(self.level.bias);
        let of_record = coarse.into_iter().chain(noisy).chain(of_axis);
        let of_record = of_record.filter(|_| has_distance);
        let filter = is_filtered.then_some(Warning::Filter).into_iter();
        let of_trips = self.trips.iter().flat_map(Tracked::warnings);
        filter.chain(of_record).chain(of_trips).collect()
    }
}

impl Warning {
    /// That about the axis of a sensor with this bias, m/s², if there is one.
    pub(super) fn of_bias(bias: f64) -> Option<Self> {
        let is_tilted = (TILTED.0..TILTED.1).contains(&bias.abs());
        is_tilted.then_some(Self::Tilted(bias))
    }
}

impl Tracked {
    fn warnings(&self) -> impl Iterator<Item = Warning> {
        let ride = self.trip.ride;
        let unknown = match self.unknown {
            Some(Unknown::Start) => Some(Warning::Start(ride)),
            Some(Unknown::Hole) => Some(Warning::Hole(ride)),
            Some(Unknown::Filter) | None => None,
        };
        let is_open = self.trip.stop.is_none();
        let open = self
            .distance
            .filter(|_| is_open)
            .map(|gone| Warning::Stop { ride, gone });
        let closing = self.closing_speed.zip(self.widened);
        let closing = closing.map(|(speed, by)| Warning::Closing { ride, speed, by });
        [unknown, open, closing].into_iter().flatten()
    }
}
