//! Where the car stands at each rest of a record: [`SlowHeight`], taken through its trips.

use super::slow::{Drift, SlowHeight};
use crate::track::rested::Rested;
use crate::track::{Tracked, Uncertain};
use std::ops::Range;

/// The rest that is read on either side of a trip, and what is left out behind it, where a barometer lags, s.
const REST: f64 = 10.0;
const LAG: f64 = 1.0;

/// A distance that is not known, m.
const UNKNOWN: Uncertain = Uncertain {
    mean: 0.0,
    variance: 1e6,
};

/// A barometer as heights.
#[derive(Clone, Copy, Debug)]
pub struct Barometry<'a> {
    /// Times, s, and heights above any level, m, in order of time.
    pub readings: &'a [(f64, f64)],
    /// The deviation of the mean of a second of them, m.
    pub second: f64,
    /// The error of the mean of a rest that lies between two steps of the sensor, m.
    pub rounded: f64,
}

/// The car between two trips, or before the first, or after the last: m above where it stood first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// As it comes.
    pub begin: Uncertain,
    /// As it leaves.
    pub end: Uncertain,
    /// How far it may have gone in it, where that is not seen, m.
    pub unseen: Option<Uncertain>,
}

/// Between two trips, or beside the only one; an end that is not known is none, that of the record infinite.
struct Rest {
    begin: Option<f64>,
    end: Option<f64>,
    /// What the record does not decide in it, s.
    unseen: Option<Range<f64>>,
}

impl Barometry<'_> {
    /// Where the car is before all trips, then after each. Where
    /// no trip says how far it went, or it may have gone `unseen` between these times, s, the barometer does. `floor` is that
    /// at which the car is known to stand, if its position is about this.
    pub fn stays(
        &self,
        trips: &[Tracked],
        unseen: &[Range<f64>],
        floor: impl Fn(Uncertain) -> Option<Uncertain>,
    ) -> Vec<Stay> {
        let mut car = Carried::default();
        let stays = rests(trips, unseen).enumerate().map(|(number, rest)| {
            if let Some(before) = number.checked_sub(1) {
                car.gone = car.gone.plus(distance(&trips[before]));
            }
            let mut windows = rest.windows().into_iter();
            let mut position = |unseen: Uncertain| {
                car.gone = car.gone.plus(unseen);
                if let Some(window) = windows.next() {
                    self.read(&mut car, &window);
                }
                car.stand(&floor)
            };
            let begin = position(Uncertain::default());
            let end = match &rest.unseen {
                Some(_) => position(UNKNOWN),
                None => position(Uncertain::default()),
            };
            let gone = Uncertain {
                mean: end.mean - begin.mean,
                variance: end.variance + begin.variance,
            };
            Stay {
                begin,
                end,
                unseen: rest.unseen.map(|_| gone),
            }
        });
        stays.collect()
    }

    /// What the barometer reads in the meantime, if it reads anything.
    fn read(&self, car: &mut Carried, window: &Range<f64>) {
        let place = |time: f64| self.readings.partition_point(|it| it.0 < time);
        let (first, end) = (place(window.start), place(window.end));
        let read = Rested::of(&self.readings[first..end.max(first)]);
        if read.count > 0.0 {
            let noise = self.second * self.second * read.of_mean();
            car.arrive(read.time);
            car.height.read(Uncertain {
                mean: read.mean,
                variance: noise + self.rounded * self.rounded,
            });
        }
    }
}

/// The car on its way.
struct Carried {
    height: SlowHeight,
    /// When its height was known last, s.
    time: f64,
    /// How far it has gone since then.
    gone: Uncertain,
}

impl Default for Carried {
    fn default() -> Self {
        Self {
            height: SlowHeight::new(Drift::default()),
            time: 0.0,
            gone: Uncertain::default(),
        }
    }
}

impl Carried {
    fn arrive(&mut self, time: f64) {
        self.height.travel(self.gone, time - self.time);
        (self.time, self.gone) = (time, Uncertain::default());
    }

    fn stand(&mut self, floor: impl Fn(Uncertain) -> Option<Uncertain>) -> Uncertain {
        let position = self.height.position().plus(self.gone);
        let Some(floor) = floor(position) else {
            return position;
        };
        self.arrive(self.time);
        self.height.stand(floor);
        self.height.position()
    }
}

/// That of a trip from rest to rest, or any.
fn distance(trip: &Tracked) -> Uncertain {
    let known = trip.trip.stop.and(trip.distance).zip(trip.deviation);
    known.map_or(UNKNOWN, |(mean, deviation)| Uncertain {
        mean,
        variance: deviation * deviation,
    })
}

fn rests(trips: &[Tracked], unseen: &[Range<f64>]) -> impl Iterator<Item = Rest> {
    (0..=trips.len()).map(|number| {
        let before = number.checked_sub(1).map(|before| trips[before].trip.stop);
        let begin = before.unwrap_or(Some(f64::NEG_INFINITY));
        let next = trips.get(number).map(|it| it.trip.start);
        let end = next.unwrap_or(Some(f64::INFINITY));
        let is_in = |it: &&Range<f64>| {
            begin.is_none_or(|begin| it.end > begin) && end.is_none_or(|end| it.start < end)
        };
        let within = unseen.iter().filter(is_in).cloned();
        let unseen = within.reduce(|first, it| first.start.min(it.start)..first.end.max(it.end));
        Rest { begin, end, unseen }
    })
}

impl Rest {
    /// When a barometer is read: after its begin and before its end, or all the time where that is short.
    fn windows(&self) -> Vec<Range<f64>> {
        let (first, last) = match &self.unseen {
            Some(unseen) => (unseen.start, unseen.end),
            None => (f64::INFINITY, f64::NEG_INFINITY),
        };
        let known = |it: Option<f64>| it.filter(|time| time.is_finite());
        let end = self.end.unwrap_or(f64::INFINITY);
        let begin = self.begin.unwrap_or(f64::NEG_INFINITY);
        let after =
            known(self.begin).map(|begin| begin + LAG..(begin + LAG + REST).min(end).min(first));
        let before = known(self.end).map(|end| (end - REST).max(begin + LAG).max(last)..end);
        match (after, before) {
            (Some(after), Some(before)) if after.end >= before.start => {
                vec![after.start..before.end]
            }
            (after, before) => after.into_iter().chain(before).collect(),
        }
    }
}
