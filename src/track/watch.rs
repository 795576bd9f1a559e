//! Trips as they happen, each measured as [`Track`] measures a record.
//!
//! The samples that are not told yet are kept, so that a trip is seen whole and from both sides, as in a recording. They are
//! measured once the monitor says that the cage stands. Where it does not say so they are looked at when nothing has happened
//! for some time: the cage stands or moves uniformly, and the stretch as a whole shows which. Of it what is before the last stop
//! is told, if nothing after that is undecided. What is cut off, or too long, is told as it is.

use super::floors::{Fault, Floors, Judgement};
use super::record::{Track, Tracked};
use super::unseen::hides;
use super::warning::Warning;
use crate::detection::{Detection, Undecided};
use crate::monitor::{Design, State};
use crate::recording::Sample;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::ops::Range;

/// A stretch is measured once nothing has happened for so long, s, if the monitor says that the cage stands;
const SETTLED: f64 = 2.5;

/// if not, for so long: no cage creeps to its floor for longer than 8 s, see
/// [`UniformSettings::patience`](super::UniformSettings).
const QUIET: f64 = 10.0;

/// And it is not looked at for so long after the cage has stood, s: till then it mostly is on its way.
const ON_ITS_WAY: f64 = 20.0;

/// What was not decided is looked at again when it is longer by this share, so that all that is measured is at most five times
/// the record.
const GROWS: f64 = 0.25;

/// The rest that is kept before the next trip, s.
const KEPT: f64 = 10.0;

/// What remains of a stop is over, s.
const OVER: f64 = 0.2;

/// A longer stretch is measured as it is, s.
const LONGEST: f64 = 900.0;

/// A lift that is watched.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Watch {
    design: Design,
    /// What is not told yet.
    samples: VecDeque<Sample>,
    /// Whether it begins at rest, if that is known.
    begins_at_rest: Option<bool>,
    cage: Cage,
    rides: usize,
    /// The bias of the sensor, m/s², where trips were measured.
    bias: Option<f64>,
}

/// What the cage has done in a stretch that is not told yet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Cage {
    /// It stands.
    Stands,
    /// It may have moved. Where the monitor does not say that it stands, that is not looked at before this time, s.
    MayMove { look: f64 },
}

/// Why a stretch is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Due {
    /// It is over: the cage stands, or there are no more samples.
    Over,
    /// It is over, and nothing says what the cage did between the last sample but one and the last.
    CutOff,
    /// It may be decided.
    Look,
    /// It is too long.
    Long,
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
    /// Watches a cage with a monitor of this design; it begins at rest or in motion, if that is known.
    pub fn new(design: Design, begins_at_rest: Option<bool>) -> Self {
        Self {
            design,
            samples: VecDeque::new(),
            begins_at_rest,
            cage: Cage::MayMove {
                look: f64::NEG_INFINITY,
            },
            rides: 0,
            bias: None,
        }
    }

    /// A reason to distrust every distance so far.
    pub fn warning(&self) -> Option<Warning> {
        self.bias.and_then(Warning::of_bias)
    }

    /// Takes a sample, the monitor's state after it, and for how long it has been [quiet](crate::monitor::Monitor::quiet), s;
    /// the car goes among these floors, if any are known.
    #[inline]
    pub fn step(
        &mut self,
        sample: Sample,
        state: State,
        quiet: f64,
        floors: Option<&mut Floors>,
    ) -> Vec<Happened> {
        let last = self.samples.back().copied();
        self.samples.push_back(sample);
        if last.is_some_and(|last| hides(last, sample)) {
            return self.begin_anew(sample, floors);
        }
        match self.due(sample.time, state, quiet) {
            Some(due) => self.measure(due, floors),
            None => Vec::new(),
        }
    }

    /// The samples end: tells what is not told yet.
    pub fn end(&mut self, floors: Option<&mut Floors>) -> Vec<Happened> {
        if self.samples.is_empty() || self.cage == Cage::Stands {
            Vec::new()
        } else {
            self.measure(Due::Over, floors)
        }
    }

    /// Tells what is not told yet, since nothing says what the cage did before this sample.
    fn begin_anew(&mut self, sample: Sample, floors: Option<&mut Floors>) -> Vec<Happened> {
        let told = self.measure(Due::CutOff, floors);
        *self = Self {
            samples: VecDeque::from([sample]),
            rides: self.rides,
            bias: self.bias,
            ..Self::new(self.design.clone(), None)
        };
        told
    }

    /// Why to measure the stretch now, if so.
    fn due(&mut self, now: f64, state: State, quiet: f64) -> Option<Due> {
        let stands = state == State::REST;
        match self.cage {
            Cage::Stands if stands => self.forget_before(now - KEPT),
            Cage::Stands => {
                self.cage = Cage::MayMove {
                    look: now + ON_ITS_WAY,
                };
            }
            Cage::MayMove { .. } if stands && quiet >= SETTLED => return Some(Due::Over),
            Cage::MayMove { .. } if now - self.samples[0].time > LONGEST => return Some(Due::Long),
            Cage::MayMove { look } => {
                return (now >= look && quiet >= QUIET).then_some(Due::Look);
            }
        }
        None
    }

    /// But for the last, beside which a hole is seen.
    fn forget_before(&mut self, time: f64) {
        let last = self.samples.back().map_or(time, |it| it.time);
        let time = time.min(last);
        let old = self.samples.iter().take_while(|it| it.time < time).count();
        self.samples.drain(..old);
    }

    /// Tells what is decided of the stretch, and forgets it.
    fn measure(&mut self, due: Due, mut floors: Option<&mut Floors>) -> Vec<Happened> {
        let samples = &*self.samples.make_contiguous();
        let known = &samples[..samples.len() - usize::from(due == Due::CutOff)];
        let (first, now) = (known[0].time, known[known.len() - 1].time);
        let (mut detection, mut track) = Track::found(&self.design, known, self.begins_at_rest);
        let stood = self.begins_at_rest == Some(true);
        let Some(until) = due.until(&detection, &track, stood, first..now) else {
            let wait = QUIET.max(GROWS * (now - first));
            self.cage = Cage::MayMove { look: now + wait };
            return Vec::new();
        };
        let ends = ends(&track.trips, now);
        if let Some(later) = ends.iter().position(|end| *end > until) {
            detection.trips.truncate(later);
            track.trips.truncate(later);
        }
        detection.undecided.retain(|it| it.to <= until);
        if let Some(floors) = &mut floors {
            track.land(&detection, samples, floors);
        }
        if !track.trips.is_empty() {
            self.bias = Some(track.level.bias);
        }
        // Of what is told nothing may be left, or it is told again.
        let told = self.told(track.trips, detection.undecided, now);
        let last = told.last().map_or(f64::NEG_INFINITY, |it| it.time);
        self.forget_before(last.max(until.min(now - KEPT)) + OVER);
        self.begins_at_rest = (due == Due::Over || until.is_finite()).then_some(true);
        self.cage = match due {
            Due::Over => Cage::Stands,
            _ => Cage::MayMove { look: now + QUIET },
        };
        told
    }

    /// What is told of these, in order of time.
    fn told(&mut self, trips: Vec<Tracked>, undecided: Vec<Undecided>, now: f64) -> Vec<Happened> {
        let happened = |time: f64, what| Happened {
            time,
            reported: now,
            what,
        };
        let mut told = Vec::new();
        for (time, mut trip) in ends(&trips, now).into_iter().zip(trips) {
            self.rides += 1;
            trip.trip.ride = self.rides;
            told.push(happened(time, Found::Trip(Box::new(trip))));
            if let Some(judgement) = trip.landing.and_then(|it| it.judgement)
                && let Some(alarm) = judgement.fault
            {
                told.push(happened(time, Found::Alarm { alarm, judgement }));
            }
        }
        let undecided = undecided.into_iter();
        told.extend(undecided.map(|it| happened(it.to, Found::Undecided(it))));
        told.sort_by(|a, b| a.time.total_cmp(&b.time));
        told
    }
}

/// When trips end, s: where a stop is not recorded, at the latest as the next trip begins.
fn ends(trips: &[Tracked], now: f64) -> Vec<f64> {
    let next = |place: usize| trips.get(place + 1).and_then(|it| it.trip.start);
    let ends = trips.iter().enumerate();
    ends.map(|(place, it)| it.trip.stop.or(next(place)).unwrap_or(now))
        .collect()
}

impl Due {
    /// Up to when a stretch, s, is told, if it is: what comes later is left to the next. `stood`: as it began.
    fn until(
        self,
        detection: &Detection,
        track: &Track,
        stood: bool,
        stretch: Range<f64>,
    ) -> Option<f64> {
        let undecided = &detection.undecided;
        let mut stops = detection.trips.iter().rev().filter_map(|it| it.stop);
        match self {
            Self::Over | Self::CutOff => Some(f64::INFINITY),
            Self::Long => {
                // At least half of it, so that it comes to an end.
                let half = stretch.start.midpoint(stretch.end);
                let is_outside = |stop: f64| move |it: &Undecided| it.to <= stop || it.from >= stop;
                let stop =
                    stops.find(|stop| *stop > half && undecided.iter().all(is_outside(*stop)));
                Some(stop.unwrap_or(f64::INFINITY))
            }
            // Where it may have begun in motion, rest and uniform motion look alike from here.
            Self::Look if !stood => None,
            Self::Look => {
                let past = stretch.end - 0.5 * QUIET;
                // A cage that stood, and made no trip, stands.
                let has_stood = detection.trips.is_empty() && undecided.is_empty();
                let stands = has_stood.then_some(past);
                let stop = stops.find(|stop| *stop <= past).or(stands)?;
                // Behind a high-pass filter a start looks like a hop, until more is seen.
                let least = track.settings.least_distance;
                let is_hop = |it: &Tracked| it.distance.is_some_and(|it| it.abs() < least);
                let is_decided = undecided.iter().all(|it| it.to <= stop);
                (is_decided && !track.trips.iter().any(is_hop)).then_some(stop)
            }
        }
    }
}
