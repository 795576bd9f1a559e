//! Where the cage may go unseen: what a record does not decide, and its holes.

use crate::detection::{Detection, Trip};
use crate::recording::Sample;
use std::ops::Range;

/// A longer hole may hide a ride of one floor, s.
const HIDES: f64 = 4.0;

/// Whether nothing says what the cage did between two samples that follow each other.
pub(super) fn hides(one: Sample, next: Sample) -> bool {
    let since = next.time - one.time;
    since <= 0.0 || since > HIDES
}

/// Where the cage may go unseen, s.
#[derive(Clone, Debug, Default)]
pub struct Unseen {
    undecided: Vec<Range<f64>>,
    holes: Vec<Range<f64>>,
}

impl Unseen {
    /// In these samples, of which that is known.
    pub fn of(detection: &Detection, samples: &[Sample]) -> Self {
        let pairs = samples.windows(2).map(|pair| (pair[0], pair[1]));
        let holes = pairs.filter(|(one, next)| hides(*one, *next));
        // A clock that was set back hides what comes after.
        let holes = holes.map(|(one, next)| one.time..next.time.max(one.time));
        let undecided = detection.undecided.iter().map(|it| it.from..it.to);
        Self {
            undecided: undecided.collect(),
            holes: holes.collect(),
        }
    }

    #[cfg(test)]
    pub(super) fn undecided(undecided: Vec<Range<f64>>) -> Self {
        let holes = Vec::new();
        Self { undecided, holes }
    }

    /// Whether the record decides what the cage did on a trip.
    pub(super) fn is_decided(&self, trip: &Trip) -> bool {
        let from = trip.start.unwrap_or(f64::NEG_INFINITY);
        let to = trip.stop.unwrap_or(f64::INFINITY);
        self.touching(from, to).next().is_none()
    }

    /// A trip between these times, with what is not decided around it.
    pub(super) fn around(&self, from: f64, to: f64) -> Range<f64> {
        let touching = self.touching(from, to);
        touching.fold(from..to, |all, it| {
            all.start.min(it.start)..all.end.max(it.end)
        })
    }

    fn touching(&self, from: f64, to: f64) -> impl Iterator<Item = &Range<f64>> {
        let touches = move |it: &&Range<f64>| it.start < to && it.end > from;
        self.undecided.iter().filter(touches)
    }

    /// What is in a rest, all of it: what is not decided around a trip is a part of the trip.
    pub(super) fn within(&self, from: f64, to: f64) -> impl Iterator<Item = &Range<f64>> {
        let is_within = move |it: &&Range<f64>| it.start >= from && it.end <= to;
        self.undecided.iter().chain(&self.holes).filter(is_within)
    }
}
