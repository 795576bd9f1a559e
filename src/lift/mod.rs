//! Whole rides in physical units: a cage rests and makes trips in turn, and a sensor in it records the
//! acceleration (m/s², up positive, sample i at i/rate in s).
//!
//! A sample is the mean acceleration over the sampling period around its time, as from a sensor that
//! integrates between readings: the change of speed in the period, divided by its length. So samples add up
//! to speeds exactly, even if a jam is short compared with the period.
//!
//! ```
//! use liftsim::lift::{Drive, Ending, Pickup, Ride, Trip};
//!
//! let trip = Trip { distance: -12.0, drive: Drive::slow(), ending: Ending::Commanded };
//! let ride = Ride::new(100.0, vec![5.0, 5.0], vec![trip])?;
//! let pickup = Pickup { vibration: 2.0, ..Pickup::white(0.012) };
//! let simulated = ride.simulate(&pickup, 2014, 0);
//! assert_eq!(simulated.record.len(), ride.samples());
//! assert_eq!(simulated.journeys[0].direction, -1);
//! # Ok::<(), liftsim::lift::RideError>(())
//! ```

mod accelerometer;
mod building;
mod course;
mod draws;
mod drive;
mod export;
mod pickup;
mod pulse;
mod record;
mod simulate;
#[cfg(test)]
mod tests;
mod trip;

pub use accelerometer::{Accelerometer, Model, Pose};
pub use building::{Building, BuildingError, Fault, FaultKind, Journeys, Levelling, Stop};
pub use course::Course;
pub use drive::Drive;
pub use export::{ExportLayout, write_phyphox, write_truth};
pub use pickup::{Pickup, PickupError};
pub(crate) use record::MOST_TRIPS;
pub use record::{Class, Record};
pub use simulate::Simulated;
pub use trip::{Braking, Ending, Trip, TripError};

use crate::signal::Phase;
use pulse::Pulse;

/// Rests and trips in turn, sampled at a rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Ride {
    rate: f64,
    rests: Vec<f64>,
    trips: Vec<Trip>,
    courses: Vec<Course>,
    /// What shakes the cage along the vertical, and along the way of its doors.
    shocks: [Vec<Pulse>; 2],
}

/// A part of a ride in one phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The phase of the cage.
    pub phase: Phase,
    /// s from the first sample.
    pub from: f64,
    /// s.
    pub to: f64,
    /// 1 up, −1 down, 0 at rest.
    pub direction: i8,
}

/// A trip as made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Journey {
    /// s from the first sample.
    pub start: f64,
    /// End of the acceleration, s.
    pub uniform: f64,
    /// Start of the braking or the jam, s.
    pub braking: f64,
    /// Start of the levelling, where the braking ends in one, s.
    pub levelling: Option<f64>,
    /// Time at which the cage stands again, s.
    pub stop: f64,
    /// 1 up, −1 down.
    pub direction: i8,
    /// The distance travelled, m, up positive.
    pub distance: f64,
    /// The highest speed, m/s.
    pub speed: f64,
    /// Whether it ended in a jam.
    pub jammed: bool,
}

impl Journey {
    /// Time of the jam, s from the first sample.
    pub fn jam(&self) -> Option<f64> {
        self.jammed.then_some(self.braking)
    }
}

/// Why a ride was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RideError {
    /// A rate out of range.
    #[error("rate must lie in [1e-3, 1e9] Hz, got {0}")]
    Rate(f64),
    /// Rests do not enclose the trips.
    #[error("rests: {trips} trips need {needed}, got {rests} (before, between and after them)")]
    Rests {
        /// The number of trips.
        trips: usize,
        /// The number of rests needed.
        needed: usize,
        /// The number of rests given.
        rests: usize,
    },
    /// A rest of negative or infinite duration.
    #[error("rest {number} must last zero or more seconds, got {seconds}")]
    Rest {
        /// Which one, from 1.
        number: usize,
        /// The duration given.
        seconds: f64,
    },
    /// A trip that cannot be made.
    #[error("trip {number}")]
    Trip {
        /// Which one, from 1.
        number: usize,
        /// Why.
        #[source]
        reason: TripError,
    },
    /// No samples, or too many.
    #[error(
        "a ride must have 1 to {most} samples, got {samples:.0} ({seconds:.1} s at {rate} Hz; \
             choose another rate, or other trips and rests)"
    )]
    Length {
        /// The most samples allowed.
        most: usize,
        /// The number of samples.
        samples: f64,
        /// Its duration.
        seconds: f64,
        /// Its rate.
        rate: f64,
    },
}

/// Samples of the longest ride: 1.6 GB.
const MOST_SAMPLES: usize = 200_000_000;

impl Ride {
    /// `trips` with `rests` (s) before, between and after them, sampled at `rate` Hz.
    ///
    /// # Errors
    /// If the rate or a rest is out of range, a trip cannot be made, the rests do not enclose the trips, or the
    /// ride has no samples or too many.
    pub fn new(rate: f64, rests: Vec<f64>, trips: Vec<Trip>) -> Result<Self, RideError> {
        if !(1e-3..=1e9).contains(&rate) {
            return Err(RideError::Rate(rate));
        }
        if rests.len() != trips.len() + 1 {
            return Err(RideError::Rests {
                trips: trips.len(),
                needed: trips.len() + 1,
                rests: rests.len(),
            });
        }
        if let Some(index) = rests.iter().position(|s| !(*s >= 0.0 && s.is_finite())) {
            return Err(RideError::Rest {
                number: index + 1,
                seconds: rests[index],
            });
        }
        let courses = (1..)
            .zip(&trips)
            .map(|(number, trip)| {
                (trip.course()).map_err(|reason| RideError::Trip { number, reason })
            })
            .collect::<Result<_, _>>()?;
        Self {
            rate,
            rests,
            trips,
            courses,
            shocks: Default::default(),
        }
        .of_some_length()
    }

    /// A ride of a single rest.
    ///
    /// # Errors
    /// Same as [`Ride::new`].
    pub fn still(rate: f64, seconds: f64) -> Result<Self, RideError> {
        Self::new(rate, vec![seconds], Vec::new())
    }

    fn of_some_length(self) -> Result<Self, RideError> {
        let (seconds, rate) = (self.duration(), self.rate);
        let samples = (seconds * rate).round();
        if (1.0..=MOST_SAMPLES as f64).contains(&samples) {
            Ok(self)
        } else {
            Err(RideError::Length {
                most: MOST_SAMPLES,
                samples,
                seconds,
                rate,
            })
        }
    }

    /// Hz.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// The rests before, between and after the trips, s.
    pub fn rests(&self) -> &[f64] {
        &self.rests
    }

    /// The trips as asked for.
    pub fn trips(&self) -> &[Trip] {
        &self.trips
    }

    /// The duration of the ride, s.
    pub fn duration(&self) -> f64 {
        let moving = self.courses.iter().map(Course::duration).sum::<f64>();
        self.rests.iter().sum::<f64>() + moving
    }

    /// The number of samples.
    pub fn samples(&self) -> usize {
        (self.duration() * self.rate).round() as usize
    }

    /// The phases of the cage in order, without gaps; phases of no length are left out.
    pub fn truth(&self) -> Vec<Stretch> {
        let mut now = 0.0;
        let mut stretches = Vec::new();
        let mut add = |phase, seconds, direction| {
            let (from, to) = (now, now + seconds);
            if to > from {
                stretches.push(Stretch {
                    phase,
                    from,
                    to,
                    direction,
                });
            }
            now = to;
        };
        for (rest, course) in self.rests.iter().zip(&self.courses) {
            add(Phase::Rest, *rest, 0);
            for (phase, seconds) in course.phases() {
                add(phase, seconds, course.direction());
            }
        }
        add(Phase::Rest, self.rests[self.courses.len()], 0);
        stretches
    }

    /// The trips as made.
    pub fn journeys(&self) -> Vec<Journey> {
        self.started()
            .map(|(start, course)| {
                let (uniform, braking) = course.uniform_motion();
                Journey {
                    start,
                    uniform: start + uniform,
                    braking: start + braking,
                    levelling: course.levelling().map(|time| start + time),
                    stop: start + course.duration(),
                    direction: course.direction(),
                    distance: course.distance(),
                    speed: course.top_speed(),
                    jammed: course.is_jammed(),
                }
            })
            .collect()
    }

    /// Each trip's start, s from the first sample, and its motion.
    pub fn started(&self) -> impl Iterator<Item = (f64, &Course)> {
        let mut now = 0.0;
        (self.rests.iter().zip(&self.courses)).map(move |(rest, course)| {
            let start = now + rest;
            now = start + course.duration();
            (start, course)
        })
    }
}
