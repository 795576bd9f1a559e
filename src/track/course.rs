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
    /// The first moment after that, in the latest stretch.
    begun: usize,
    /// Seconds between moments that are kept.
    pitch: f64,
}

/// More moments than a picture resolves.
const MOST_PLACES: f64 = 8192.0;

/// But moments are no farther apart than this, s: a trip takes some seconds.
const COARSEST: f64 = 0.5;

impl Course {
    /// Of a cage that stands at first, in a record of so many seconds.
    pub(super) fn new(seconds: f64) -> Self {
        Self {
            pitch: (seconds / MOST_PLACES).min(COARSEST),
            stretches: vec![Vec::new()],
            ..Self::default()
        }
    }

    /// The moments, stretch by stretch.
    pub fn stretches(&self) -> &[Vec<Place>] {
        &self.stretches
    }

    /// The position at a time, s, on the line between the moments around it, m; none where it is not known.
    pub fn position(&self, time: f64) -> Option<f64> {
        self.stretches.iter().find_map(|places| at(places, time))
    }

    /// How far it moves from one time to a later one, s; none where that is not known.
    pub(super) fn change(&self, from: f64, to: f64) -> Option<f64> {
        let mut stretches = self.stretches.iter();
        stretches.find_map(|places| Some(at(places, to)? - at(places, from)?))
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

    /// It stands again `after` a trip of this distance. The way there is bent so that it ends where the trip does, and as
    /// uncertain, as if the acceleration had a constant error.
    pub(super) fn stand(&mut self, after: &Range<f64>, distance: Uncertain) {
        self.stood = self.stood.plus(distance);
        let places = self.stretches.last_mut().expect("there is a stretch");
        let trip = &mut places[self.begun..];
        let stood = trip.partition_point(|place| place.time < after.start);
        let (moved, stood) = trip.split_at_mut(stood);
        stood
            .iter_mut()
            .for_each(|place| place.position = self.stood);
        if let [first, .., last] = &*moved {
            let (start, seconds) = (first.time, last.time - first.time);
            let off = self.stood.mean - last.position.mean;
            let wider = (self.stood.variance - last.position.variance).max(0.0);
            for place in moved {
                let share = ((place.time - start) / seconds).powi(2);
                place.position.mean += off * share;
                place.position.variance += wider * share * share;
            }
        }
        self.rest(after.end);
    }

    /// It stands.
    pub(super) fn rest(&mut self, time: f64) {
        let places = self.stretches.last_mut().expect("there is a stretch");
        places.push(Place {
            time,
            speed: 0.0,
            position: self.stood,
        });
        self.begun = places.len();
        self.updates.push((time..time, Update::None));
    }

    /// Where it is, is not known any more.
    pub(super) fn lose(&mut self) {
        self.stood = Uncertain::default();
        self.begun = 0;
        self.stretches.push(Vec::new());
    }

    /// The stretch in which the cage stood at this time, s, is where this position, m, says.
    pub(super) fn lay(&mut self, time: f64, position: f64) {
        let stands = |place: &&Place| place.time >= time && place.speed == 0.0;
        let at = |places: &&mut Vec<Place>| places.last().is_some_and(|last| last.time >= time);
        if let Some(places) = self.stretches.iter_mut().find(at)
            && let Some(stood) = places.iter().find(stands)
        {
            let by = position - stood.position.mean;
            for place in places {
                place.position.mean += by;
            }
        }
    }
}

/// The position at a time in a stretch.
fn at(places: &[Place], time: f64) -> Option<f64> {
    let next = places.partition_point(|it| it.time < time);
    let here = places.get(next)?;
    if here.time == time {
        return Some(here.position.mean);
    }
    let before = &places[next.checked_sub(1)?];
    let share = (time - before.time) / (here.time - before.time);
    let gone = here.position.mean - before.position.mean;
    Some(before.position.mean + share * gone)
}
