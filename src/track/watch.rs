//! Trips as they happen, each measured as [`Track`] measures a record: once a monitor says that the cage stands again.
//!
//! The samples since the last rest are kept, so that a trip is seen whole and from both sides, as in a recording. What
//! the stretch does not decide is told too, and the car may then be at any floor.

use super::floors::{Fault, Floors, Judgement};
use super::landing::HIDES;
use super::record::{Track, Tracked};
use crate::detection::Undecided;
use crate::monitor::{Design, State};
use crate::recording::Sample;
use serde::Serialize;
use std::collections::VecDeque;

/// A stretch is measured after so much rest, s.
const SETTLED: f64 = 2.5;

/// The rest that is kept before the next trip, s.
const KEPT: f64 = 5.0;

/// What remains of a stop is over, s.
const OVER: f64 = 0.2;

/// A longer stretch without rest is measured as it is, s.
const LONGEST: f64 = 900.0;

/// A lift that is watched.
#[derive(Clone, Debug)]
pub struct Watch {
    design: Design,
    samples: VecDeque<Sample>,
    /// Whether the samples begin at rest, if that is known.
    begins_at_rest: Option<bool>,
    /// Since when the cage is said to stand, s.
    rests: Option<f64>,
    has_moved: bool,
    rides: usize,
}

/// Something that is told of a trip.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Happened {
    /// s.
    pub time: f64,
    /// When it was known, s.
    pub reported: f64,
    /// What.
    #[serde(flatten)]
    pub what: Found,
}

/// What is found of a stretch.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// A trip, with its distance if that is measured, and the stop after it.
    Trip(Box<Tracked>),
    /// What the cage did is not decided.
    Undecided(Undecided),
    /// The car stands where no floor is.
    #[serde(untagged)]
    Alarm {
        /// What that means.
        alarm: Fault,
        /// Against which floor.
        judgement: Judgement,
    },
}

impl Watch {
    /// Watches a cage of which a monitor of this design tells when it stands; it begins at rest or in motion, if that is known.
    pub fn new(design: Design, begins_at_rest: Option<bool>) -> Self {
        Self {
            design,
            samples: VecDeque::new(),
            begins_at_rest,
            rests: None,
            has_moved: false,
            rides: 0,
        }
    }

    /// Takes a sample, and what the monitor says after it; the car goes among these floors, if any are known.
    #[inline]
    pub fn step(
        &mut self,
        sample: Sample,
        state: State,
        mut floors: Option<&mut Floors>,
    ) -> Vec<Happened> {
        let told = if self.is_cut_off(sample) {
            self.leave(floors.as_deref_mut())
        } else {
            Vec::new()
        };
        self.samples.push_back(sample);
        if state == State::REST {
            self.rests.get_or_insert(sample.time);
        } else {
            self.rests = None;
            self.has_moved = true;
        }
        let is_settled = self.rests.is_some_and(|from| sample.time - from >= SETTLED);
        if is_settled && self.has_moved {
            return [told, self.measure(floors)].concat();
        }
        if is_settled {
            self.drop_before(sample.time - KEPT);
        } else if sample.time - self.samples[0].time > LONGEST {
            let more = self.measure(floors);
            // What goes on is not over.
            self.has_moved = true;
            self.begins_at_rest = None;
            return [told, more].concat();
        }
        told
    }

    /// Whether nothing says what the cage did between the last sample and this.
    fn is_cut_off(&self, sample: Sample) -> bool {
        let since = self.samples.back().map(|it| sample.time - it.time);
        since.is_some_and(|it| it <= 0.0 || it > HIDES)
    }

    /// Tells what the samples so far hold, and forgets them: the car may be at any floor then.
    fn leave(&mut self, mut floors: Option<&mut Floors>) -> Vec<Happened> {
        let told = if self.has_moved {
            self.measure(floors.as_deref_mut())
        } else {
            Vec::new()
        };
        if let Some(floors) = floors {
            floors.lose();
        }
        let rides = self.rides;
        *self = Self {
            rides,
            ..Self::new(self.design.clone(), None)
        };
        told
    }

    /// The samples end: tells what is not told yet.
    pub fn end(mut self, floors: Option<&mut Floors>) -> Vec<Happened> {
        if self.has_moved && !self.samples.is_empty() {
            self.measure(floors)
        } else {
            Vec::new()
        }
    }

    fn drop_before(&mut self, time: f64) {
        while self.samples.front().is_some_and(|it| it.time < time) {
            self.samples.pop_front();
        }
    }

    fn measure(&mut self, floors: Option<&mut Floors>) -> Vec<Happened> {
        let samples = &*self.samples.make_contiguous();
        let reported = samples.last().map_or(0.0, |it| it.time);
        let (detection, mut track) = Track::found(&self.design, samples, self.begins_at_rest);
        if let Some(floors) = floors {
            track.land(&detection, samples, floors);
        }
        let happened = |time: f64, what| Happened {
            time,
            reported,
            what,
        };
        let mut told = Vec::new();
        for mut trip in track.trips {
            self.rides += 1;
            trip.trip.ride = self.rides;
            let time = trip.trip.stop.unwrap_or(reported);
            told.push(happened(time, Found::Trip(Box::new(trip))));
            let judgement = trip.landing.and_then(|it| it.judgement);
            if let Some((alarm, judgement)) = judgement.and_then(|it| Some((it.fault?, it))) {
                told.push(happened(time, Found::Alarm { alarm, judgement }));
            }
        }
        let undecided = detection.undecided.into_iter();
        told.extend(undecided.map(|it| happened(it.to, Found::Undecided(it))));
        told.sort_by(|a, b| a.time.total_cmp(&b.time));
        let stop = detection.trips.last().and_then(|trip| trip.stop);
        self.drop_before(stop.map_or(reported - KEPT, |stop| stop + OVER));
        self.begins_at_rest = self.rests.map(|_| true);
        self.has_moved = false;
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lift::{Drive, Ending, Pickup, Ride, Trip};
    use crate::monitor::{Knowledge, Monitor, Settings};
    use crate::track::floors::{self, Start};

    const RATE: f64 = 100.0;

    /// What is told of a lift that makes these trips, m, among floors 4 m apart.
    fn told(trips: &[f64]) -> (Vec<Happened>, Ride) {
        told_of(trips, Some)
    }

    /// The same where the clock tells another time, or nothing is recorded.
    fn told_of(trips: &[f64], clock: impl Fn(f64) -> Option<f64>) -> (Vec<Happened>, Ride) {
        let drive = Drive {
            speed: 1.6,
            acceleration: 1.0,
            jerk: 1.5,
        };
        let trip = |distance: &f64| Trip {
            distance: *distance,
            drive,
            ending: Ending::Commanded,
        };
        let rests = vec![12.0; trips.len() + 1];
        let ride = Ride::new(RATE, rests, trips.iter().map(trip).collect()).unwrap();
        let record = ride.simulate(&Pickup::white(0.012), 5, 0).record;
        let heights = [0.0, 4.0, 8.0, 12.0];
        let settings = floors::Settings::default();
        let mut floors = Floors::given(settings, &heights, 0.01, Start::Floor(0)).unwrap();
        let design = Settings::default().at(RATE).unwrap();
        let knowledge = Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        };
        let mut monitor = Monitor::new(design.clone(), knowledge);
        let mut watch = Watch::new(design, Some(true));
        let mut told = Vec::new();
        for (place, acceleration) in record.into_iter().enumerate() {
            let Some(time) = clock(place as f64 / RATE) else {
                continue;
            };
            let sample = Sample { time, acceleration };
            monitor.step(sample, None);
            told.extend(watch.step(sample, monitor.state(), Some(&mut floors)));
        }
        told.extend(watch.end(Some(&mut floors)));
        (told, ride)
    }

    /// Every trip once, with its distance, its floor and its time, a few seconds after the stop.
    #[test]
    fn trips_are_told_as_they_happen() {
        let (told, ride) = told(&[4.0, 8.0, -12.0, 4.0]);
        let trips: Vec<&Happened> = told.iter().collect();
        assert_eq!(trips.len(), 4, "{told:?}");
        for ((happened, journey), floor) in trips.iter().zip(ride.journeys()).zip([1, 3, 0, 1]) {
            let Found::Trip(trip) = &happened.what else {
                panic!("{happened:?}");
            };
            assert!(
                (trip.distance.unwrap() - journey.distance).abs() < 0.1,
                "{trip:?}"
            );
            assert_eq!(trip.landing.unwrap().floor, Some(floor));
            assert!((happened.time - journey.stop).abs() < 0.5, "{happened:?}");
            assert!(happened.reported - journey.stop < 8.0, "{happened:?}");
        }
    }

    #[test]
    fn a_stop_between_floors_is_an_alarm() {
        let (told, _) = told(&[4.0, 2.0, 2.0]);
        let alarms: Vec<_> = told
            .iter()
            .filter_map(|it| match it.what {
                Found::Alarm { alarm, .. } => Some((alarm, it.time)),
                _ => None,
            })
            .collect();
        assert_eq!(alarms.len(), 1, "{told:?}");
        assert_eq!(alarms[0].0, Fault::BetweenFloors);
        let json = serde_json::to_string(&told).unwrap();
        assert!(json.contains("\"alarm\":\"between_floors\""), "{json}");
    }

    fn floors_of(told: &[Happened]) -> Vec<Option<usize>> {
        let trips = told.iter().filter_map(|it| match &it.what {
            Found::Trip(trip) => Some(trip.landing.and_then(|landing| landing.floor)),
            _ => None,
        });
        trips.collect()
    }

    /// A hole, or a clock that is set back, just after a stop: the trip before it is told, and of the floor nothing is taken
    /// for known: no alarm where the car went on unseen.
    #[test]
    fn what_is_cut_off_is_told_first() {
        let trips = [4.0, 4.0, -8.0];
        let (_, ride) = told(&trips);
        let stop = ride.journeys()[0].stop;
        let next = ride.journeys()[1].stop;
        let hole = |time: f64| (time < stop + 1.5 || time > next + 3.0).then_some(time);
        let (told, _) = told_of(&trips, hole);
        assert_eq!(floors_of(&told).len(), 2, "{told:?}");
        assert_eq!(floors_of(&told)[0], Some(1));
        assert!(
            !told.iter().any(|it| matches!(it.what, Found::Alarm { .. })),
            "{told:?}"
        );
        let back = |time: f64| Some(if time < stop + 1.5 { time } else { time - 5.0 });
        let (told, _) = told_of(&trips, back);
        assert_eq!(floors_of(&told).len(), 3, "{told:?}");
    }

    /// Rests too short to be called rest: every trip is told, at the latest when the stretch is as long as may be.
    #[test]
    fn a_long_stretch_loses_no_trip() {
        let drive = Drive {
            speed: 1.6,
            acceleration: 1.0,
            jerk: 1.5,
        };
        let trip = |place: usize| Trip {
            distance: if place.is_multiple_of(2) { 4.0 } else { -4.0 },
            drive,
            ending: Ending::Commanded,
        };
        let mut rests = vec![2.0; 181];
        rests[0] = 10.0;
        let ride = Ride::new(RATE, rests, (0..180).map(trip).collect()).unwrap();
        let record = ride.simulate(&Pickup::white(0.012), 5, 0).record;
        let design = Settings::default().at(RATE).unwrap();
        let mut watch = Watch::new(design, Some(true));
        let mut told = Vec::new();
        for (place, acceleration) in record.into_iter().enumerate() {
            let time = place as f64 / RATE;
            let state = if time < 9.0 {
                State::REST
            } else {
                State::Unknown
            };
            told.extend(watch.step(Sample { time, acceleration }, state, None));
        }
        told.extend(watch.end(None));
        let decided = |it: &&Happened| matches!(it.what, Found::Trip(_));
        let (trips, others) = (told.iter().filter(decided).count(), told.len());
        assert!(trips >= 178 && others >= 180, "{trips} {others}");
    }
}
