//! A record shown to the detector, which knows all of it before it says anything.

use crate::detection::{Detection, What};
use crate::lift::{Journey, Record};
use crate::monitor::{Design, Direction};
use crate::recording::Sample;

/// What a detector says of a record. Times in s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Each trip; an end outside the record is none.
    pub trips: Vec<Found>,
    /// Stretches of which it says that it cannot decide.
    pub undecided: Vec<(f64, f64)>,
}

/// A trip that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub start: Option<f64>,
    pub stop: Option<f64>,
    pub direction: Direction,
}

/// Detects the trips of a record.
pub fn detect(design: &Design, record: &Record) -> Outcome {
    let readings = record.times.iter().zip(&record.acceleration);
    let samples = readings.map(|(&time, &acceleration)| Sample { time, acceleration });
    let detection = Detection::of(design, &samples.collect::<Vec<_>>(), None, None);
    let (first, last) = ends(record);
    let doubted = detection
        .trips
        .iter()
        .filter(|trip| trip.or_start.or(trip.or_stop).is_some());
    let doubted = doubted.map(|trip| (trip.start.unwrap_or(first), trip.stop.unwrap_or(last)));
    let undecided = detection.undecided.iter().map(|it| (it.from, it.to));
    let slow = detection
        .events
        .iter()
        .filter(|event| event.what == What::SlowMotion);
    let slow = slow.map(|event| (event.from, event.to));
    Outcome {
        trips: (detection.trips.iter())
            .map(|trip| Found {
                start: trip.start,
                stop: trip.stop,
                direction: trip.direction,
            })
            .collect(),
        undecided: undecided.chain(doubted).chain(slow).collect(),
    }
}

/// How the trips of one record, or of several, were told. Each true trip is one of the first four.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Told {
    /// In the right direction, start and stop within the tolerance.
    pub found: u64,
    /// Said to be undecided, in part at least.
    pub undecided: u64,
    /// In the right direction, but start or stop are wrong.
    pub misplaced: u64,
    /// Not at all, or in the wrong direction only.
    pub missed: u64,
    /// Trips told where none went in that direction.
    pub false_trips: u64,
    /// True trips whose start and stop the record shows, with rest enough before and after; and those of them found.
    pub between_rests: u64,
    pub found_between_rests: u64,
}

impl Told {
    /// Compares what a detector says with the truth. Trips of which the record holds less than the least speed are
    /// left out; of the others, ends outside the record need not be told.
    pub fn new(record: &Record, outcome: &Outcome, least_speed: f64, tolerance: f64) -> Self {
        let mut told = Self::default();
        let shown = |trip: &&Journey| top_speed_within(record, trip) >= least_speed;
        for trip in record.journeys.iter().filter(shown) {
            let along = |found: &&Found| found.is_along(trip);
            let mut found = outcome.trips.iter().filter(along);
            let is_undecided = |&(from, to): &(f64, f64)| from < trip.stop && trip.start < to;
            let is_found = (found.clone()).any(|found| found.fits(trip, record, tolerance));
            if is_between_rests(record, trip) {
                told.between_rests += 1;
                told.found_between_rests += u64::from(is_found);
            }
            let count = if is_found {
                &mut told.found
            } else if outcome.undecided.iter().any(is_undecided) {
                &mut told.undecided
            } else if found.next().is_some() {
                &mut told.misplaced
            } else {
                &mut told.missed
            };
            *count += 1;
        }
        let is_false = |found: &&Found| !record.journeys.iter().any(|trip| found.is_along(trip));
        told.false_trips = outcome.trips.iter().filter(is_false).count() as u64;
        told
    }

    /// All true trips.
    pub fn trips(&self) -> u64 {
        self.found + self.undecided + self.misplaced + self.missed
    }
}

impl Found {
    /// Whether it shares a moment and the direction with a trip.
    fn is_along(&self, trip: &Journey) -> bool {
        let (start, stop) = (self.start, self.stop);
        self.direction == Direction::of(f64::from(trip.direction))
            && start.unwrap_or(f64::NEG_INFINITY) < trip.stop
            && trip.start < stop.unwrap_or(f64::INFINITY)
    }

    fn fits(&self, trip: &Journey, record: &Record, tolerance: f64) -> bool {
        let is_near = |said: Option<f64>, time: f64| match said {
            Some(said) if is_recorded(record, time) => (said - time).abs() <= tolerance,
            None if is_recorded(record, time) => false,
            _ => true,
        };
        is_near(self.start, trip.start) && is_near(self.stop, trip.stop)
    }
}

/// A pulse that a hole cuts off within this time of an end shows nothing of that end, s.
const EDGE: f64 = 0.6;

/// A shorter rest is none, s.
const REST: f64 = 1.0;

/// Whether the record shows the start and the stop of a trip, and rest before and after it.
fn is_between_rests(record: &Record, trip: &Journey) -> bool {
    let is_at_rest = |from: f64, to: f64| {
        let moves = |other: &Journey| other.start < to && from < other.stop;
        let shown = [from, to].map(|time| is_recorded(record, time));
        shown == [true; 2] && !record.journeys.iter().any(moves)
    };
    is_at_rest(trip.start - REST, trip.start) && is_at_rest(trip.stop, trip.stop + REST)
}

/// Whether the record shows the time: not outside it, and not in or at the edge of a hole.
fn is_recorded(record: &Record, time: f64) -> bool {
    let (first, last) = ends(record);
    let longest = 0.25f64.max(3.0 / record.rate);
    let around = record.times.partition_point(|other| *other < time - EDGE)
        ..record.times.partition_point(|other| *other <= time + EDGE);
    let near = record.times
        [around.start.saturating_sub(1)..(around.end + 1).min(record.times.len())]
        .windows(2);
    let has_hole = near.into_iter().any(|pair| pair[1] - pair[0] > longest);
    (first..=last).contains(&time) && !has_hole
}

/// The times of the first and the last sample, s.
fn ends(record: &Record) -> (f64, f64) {
    let ends = record.times.first().zip(record.times.last());
    ends.map_or((0.0, 0.0), |(first, last)| (*first, *last))
}

fn top_speed_within(record: &Record, trip: &Journey) -> f64 {
    let speeds = record.times.iter().zip(&record.speed);
    speeds
        .filter(|(time, _)| (trip.start..=trip.stop).contains(*time))
        .fold(0.0, |top, (_, speed)| top.max(speed.abs()))
}
