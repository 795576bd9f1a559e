//! The course of a cage for a picture, thinned.

use super::filter::{TripFilter, Uncertain, Update};
use std::ops::Range;

/// The cage at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// s.
    pub time: f64,
    /// m/s, up positive.
    pub speed: f64,
    /// m, up positive, from where its stretch begins.
    pub position: Uncertain,
}

/// Its moments. After a trip that is not measured a new stretch begins, and positions count from there.
#[derive(Clone, Debug, Default)]
pub struct Course {
    stretches: Vec<Vec<Place>>,
    updates: Vec<(Range<f64>, Update)>,
    /// Where the cage stood last.
    stood: Uncertain,
    /// Seconds between moments that are kept.
    pitch: f64,
}

/// More moments than a picture resolves.
const MOST_PLACES: f64 = 8192.0;

impl Course {
    /// Of a cage that stands at first, in a record of so many seconds.
    pub(super) fn new(seconds: f64) -> Self {
        Self {
            pitch: seconds / MOST_PLACES,
            stretches: vec![Vec::new()],
            ..Self::default()
        }
    }

    /// The moments, stretch by stretch.
    pub fn stretches(&self) -> &[Vec<Place>] {
        &self.stretches
    }

    /// When the filter knew something beside the acceleration.
    pub fn updates(&self) -> &[(Range<f64>, Update)] {
        &self.updates
    }

    /// The cage moves, or is about to.
    pub(super) fn note(&mut self, time: f64, update: Update, filter: &TripFilter) {
        let places = self.stretches.last_mut().expect("there is a stretch");
        let latest = places.last().map_or(f64::NEG_INFINITY, |it| it.time);
        if time - latest >= self.pitch {
            let (gone, speed) = (filter.distance(), filter.speed().mean);
            places.push(Place {
                time,
                speed,
                position: self.stood.plus(gone),
            });
        }
        match self.updates.last_mut() {
            Some((span, of)) if *of == update => span.end = time,
            _ => self.updates.push((time..time, update)),
        }
    }

    /// It stands again, after a trip of this distance.
    pub(super) fn stand(&mut self, time: f64, distance: Uncertain) {
        self.stood = self.stood.plus(distance);
        self.rest(time);
    }

    /// It stands.
    pub(super) fn rest(&mut self, time: f64) {
        let places = self.stretches.last_mut().expect("there is a stretch");
        places.push(Place {
            time,
            speed: 0.0,
            position: self.stood,
        });
        self.updates.push((time..time, Update::None));
    }

    /// Where it is, is not known any more.
    pub(super) fn lose(&mut self) {
        self.stood = Uncertain::default();
        self.stretches.push(Vec::new());
    }
}
