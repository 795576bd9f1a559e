//! The trips of a record, measured.

use super::climb::{Climb, Standing};
use super::course::Course;
use super::filter::Uncertain;
use super::floors::Stop;
use super::level::Level;
use super::phases::Phases;
use super::quality::Quality;
use super::rides::Surroundings;
use super::settings::TrackSettings;
use super::settled::settled;
use super::steps::HOLE;
use super::travelled::Travelled;
use crate::detection::{Detection, Trip};
use crate::explain::Faults;
use crate::monitor::Design;
use crate::recording::{Facts, Sample};
use serde::Serialize;
use std::ops::Range;

/// A trip and how far it went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tracked {
    /// As detected.
    #[serde(flatten)]
    pub trip: Trip,
    /// m, up positive; of a trip whose end is not recorded, so far.
    pub distance: Option<f64>,
    /// Its standard deviation, m.
    pub deviation: Option<f64>,
    /// The speed left at the stop, m/s, up positive.
    pub closing_speed: Option<f64>,
    /// What that adds to the deviation where it is too much for the noise, m.
    pub widened: Option<f64>,
    /// The stop after it, where floors are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub landing: Option<Stop>,
    /// Its height by a barometer, where there is one.
    #[serde(flatten)]
    pub climb: Option<Climb>,
    /// Where the car stands after it, where there is one.
    #[serde(flatten)]
    pub standing: Option<Standing>,
    /// How smooth it was, where that is asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quality: Option<Quality>,
    /// How far the car went unseen before it, by a barometer, m.
    #[serde(skip)]
    pub unseen: Option<Uncertain>,
    /// Why there is no distance.
    #[serde(skip)]
    pub unknown: Option<Unknown>,
}

/// Why a trip has no distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum Unknown {
    #[error("the record does not hold its start")]
    Start,
    #[error("a hole hides a change of its speed")]
    Hole,
    #[error("the sensor is behind a high-pass filter")]
    Filter,
}

/// The trips of a record.
#[derive(Clone, Debug)]
pub struct Track {
    /// The settings, with the noise of the record where it is the larger.
    pub settings: TrackSettings,
    /// How many times S_a is larger at rest than they said, if it is.
    pub noisier: Option<f64>,
    /// The sensor as the record shows it.
    pub level: Level,
    /// The sensor's steps, if they are coarser than its noise, m/s².
    pub step: Option<f64>,
    /// In order of time.
    pub trips: Vec<Tracked>,
    /// For a picture.
    pub course: Course,
    /// When nothing moves the sensor, s.
    pub(super) rests: Vec<Range<f64>>,
}

impl Track {
    /// Finds the trips of a record of which nothing else is known, but perhaps how it begins, and measures them.
    pub fn found(
        design: &Design,
        samples: &[Sample],
        begins_at_rest: Option<bool>,
    ) -> (Detection, Self) {
        let detection = Detection::of(design, samples, None, begins_at_rest);
        let facts = Facts::of(samples, false, None);
        let step = facts.ok().and_then(|facts| facts.coarse_step);
        let track = Self::of(samples, step, &detection, TrackSettings::default());
        (detection, track)
    }

    /// Measures the trips of a detection in its samples, whose steps are coarser than their noise if `step`, m/s², is
    /// given.
    pub fn of(
        samples: &[Sample],
        step: Option<f64>,
        detection: &Detection,
        settings: TrackSettings,
    ) -> Self {
        let (sound, _) = Faults::removed(samples);
        let stretches = stretches(&sound);
        let seconds = stretches.iter().map(|it| it.end - it.start).sum();
        let surroundings = Surroundings::new(detection, stretches);
        let rests = surroundings.rests(&settings);
        let level = Level::of(
            &sound,
            &rests,
            &surroundings.uniform(&detection.trips, &settings),
        );
        let (settings, noisier) = settings.noisier(&level);
        let mut track = Self {
            settings,
            noisier,
            step,
            level,
            trips: Vec::with_capacity(detection.trips.len()),
            course: Course::new(seconds),
            rests,
        };
        track
            .course
            .rest(sound.first().map_or(0.0, |first| first.time));
        for trip in &detection.trips {
            let phases = track.phases(trip, detection, &surroundings, &sound);
            let tracked = match phases {
                Ok(phases) => track.measure(trip, &phases, &sound),
                Err(unknown) => {
                    track.course.lose();
                    Tracked::unknown(trip, unknown)
                }
            };
            track.trips.push(tracked);
        }
        track
            .course
            .rest(sound.last().map_or(0.0, |last| last.time));
        track
    }

    fn phases(
        &self,
        trip: &Trip,
        detection: &Detection,
        surroundings: &Surroundings,
        samples: &[Sample],
    ) -> Result<Phases, Unknown> {
        if detection.filter.time_constant().is_some() {
            return Err(Unknown::Filter);
        }
        let phases = surroundings.phases(trip, &self.settings);
        let phases = phases.ok_or(Unknown::Start)?;
        let phases = self.settled(phases, samples);
        let hidden = phases.changes().iter().any(|part| has_hole(samples, part));
        if hidden {
            Err(Unknown::Hole)
        } else {
            Ok(phases)
        }
    }

    /// Without the ends of the uniform motion that seem to change the speed still, if less speed is left at the stop then.
    fn settled(&self, phases: Phases, samples: &[Sample]) -> Phases {
        let [uniform, levelling] = &phases.uniform;
        let shorter = Phases {
            uniform: [settled(samples, uniform), levelling.clone()],
            ..phases.clone()
        };
        if shorter == phases {
            return phases;
        }
        let left = |phases: &Phases| {
            let travelled = phases.measure(samples, self.bias(), &self.settings, |_, _, _| {});
            travelled.closing_speed.map(f64::abs)
        };
        match (left(&phases), left(&shorter)) {
            (Some(before), Some(after)) if after < before => shorter,
            _ => phases,
        }
    }

    fn bias(&self) -> Uncertain {
        Uncertain {
            mean: self.level.bias,
            ..Uncertain::error(self.settings.bias_error)
        }
    }

    fn measure(&mut self, trip: &Trip, phases: &Phases, samples: &[Sample]) -> Tracked {
        let bias = self.bias();
        let course = &mut self.course;
        let mut travelled =
            phases.measure(samples, bias, &self.settings, |step, update, filter| {
                course.note(step.time, update, filter);
            });
        if let Some(step) = self.step {
            travelled = travelled.plus(Uncertain::error(phases.error_of_steps(step)));
        }
        if trip.stop.is_some() {
            course.stand(&phases.after, travelled.distance);
        } else {
            // Of its speed the gain's error is never taken off.
            let gone = travelled.distance.mean.abs();
            travelled = travelled.plus(Uncertain::error(self.settings.gain_error * gone));
            course.lose();
        }
        Tracked::of(trip, &travelled)
    }
}

impl Tracked {
    /// A trip of which nothing is measured.
    pub(super) fn bare(trip: &Trip) -> Self {
        Self {
            trip: *trip,
            distance: None,
            deviation: None,
            closing_speed: None,
            widened: None,
            landing: None,
            climb: None,
            standing: None,
            unseen: None,
            quality: None,
            unknown: None,
        }
    }

    fn of(trip: &Trip, travelled: &Travelled) -> Self {
        Self {
            distance: Some(travelled.distance.mean),
            deviation: Some(travelled.distance.variance.sqrt()),
            closing_speed: travelled.closing_speed,
            widened: (travelled.widened > 0.0).then_some(travelled.widened),
            ..Self::bare(trip)
        }
    }

    fn unknown(trip: &Trip, unknown: Unknown) -> Self {
        Self {
            unknown: Some(unknown),
            ..Self::bare(trip)
        }
    }
}

#[cfg(test)]
impl Tracked {
    /// A trip between these times, s, of a distance that is known to 5 cm.
    pub(super) fn told(ride: usize, [start, stop]: [f64; 2], distance: f64) -> Self {
        let trip = Trip {
            ride,
            direction: crate::monitor::Direction::of(distance),
            start: Some(start),
            inertial: None,
            braking: None,
            levelling: None,
            landing: None,
            stop: Some(stop),
            speed: 1.0,
            ended: crate::detection::End::Stop,
            or_start: None,
            or_stop: None,
            start_decision: None,
            stop_decision: None,
            start_at: None,
            stop_at: None,
        };
        Self {
            distance: Some(distance),
            deviation: Some(0.05),
            ..Self::bare(&trip)
        }
    }
}

/// From when to when a record has no holes, s.
pub(super) fn stretches(samples: &[Sample]) -> Vec<Range<f64>> {
    let stretches = samples.chunk_by(|one, next| next.time - one.time <= 2.0 * HOLE);
    let stretches = stretches.map(|part| part[0].time..part[part.len() - 1].time);
    stretches.collect()
}

fn has_hole(samples: &[Sample], part: &Range<f64>) -> bool {
    let place = |time: f64| samples.partition_point(|sample| sample.time < time);
    let first = place(part.start);
    // In a hole both ends may be the other way round.
    let end = place(part.end).max(first);
    // The samples on either side too.
    let around = &samples[first.saturating_sub(1)..(end + 1).min(samples.len())];
    stretches(around).len() > 1
}
