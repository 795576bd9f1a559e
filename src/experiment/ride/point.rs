//! One point of a study: a drive, a cage with a sensor in it, and a monitor.

use super::keys::RideKeys;
use super::{MOST_TRIPS, Measure, RideProblem};
use crate::monitor::Settings;
use crate::rule::{OutOfRange, Rule};
use crate::signal::{
    Digitiser, Disturbance, Drive, During, Ending, Impulses, Pickup, Ride, RideError, Sensor, Trip,
};

/// All that a trial needs beside its draws.
#[derive(Clone, Debug, PartialEq)]
pub struct RidePoint {
    /// What is asked of it.
    pub measure: Measure,
    /// Of every trip, m; up and down in turn.
    pub distance: f64,
    /// The limits of its motion.
    pub drive: Drive,
    /// How many there are.
    pub trips: usize,
    /// The shortest and the longest rest before, between and after them, s; uniformly random.
    pub rest: [f64; 2],
    /// How long a rest is that is watched for itself, s.
    pub length: f64,
    /// In how many s a jam brings the cage to a stand.
    pub jam_within: f64,
    /// How far from the truth, s, a start, a stop or a jam may be reported.
    pub tolerance: f64,
    /// Hz.
    pub rate: f64,
    /// In the cage.
    pub pickup: Pickup,
    /// Of the monitor.
    pub settings: Settings,
    /// Whether it has learnt what rest is like, from another rest.
    pub learnt: bool,
    /// Whether it assumes that the record begins at rest, true or not.
    pub begins_at_rest: bool,
    /// Whether it assumes that motion shows.
    pub motion_shows: bool,
}

/// The deviation of the noise where the file says nothing, m/s²: that of a good phone.
const SIGMA: f64 = 0.012;

impl RidePoint {
    pub(super) fn new(
        measure: Measure,
        keys: &RideKeys,
        settings: Settings,
    ) -> Result<Self, RideProblem> {
        keys.check()?;
        let drive = Drive {
            speed: keys.speed,
            acceleration: keys.acceleration,
            jerk: keys.jerk,
        };
        let point = Self {
            measure,
            distance: keys.distance,
            trips: keys.trips,
            rest: keys.rest,
            length: keys.length,
            jam_within: keys.jam_within,
            tolerance: keys.tolerance,
            pickup: keys.pickup(&drive)?,
            settings,
            learnt: keys.learnt,
            begins_at_rest: (keys.begins_at_rest).unwrap_or(measure != Measure::SwitchedOn),
            motion_shows: keys.motion_shows,
            drive,
            rate: keys.rate,
        };
        point.check()?;
        Ok(point)
    }

    /// Whatever is drawn, a trial can be run: the longest can.
    fn check(&self) -> Result<(), RideProblem> {
        let in_ride = |path: &str| format!("ride.{}", path.rsplit('.').next().unwrap_or(path));
        (self.settings.at(self.rate)).map_err(|error| error.called(in_ride))?;
        if self.measure.rests() {
            self.still()?;
        }
        if self.measure.rides() {
            let (from, to) = self.trip(0, Ending::Commanded).course()?.uniform_motion();
            let must_be_uniform = matches!(self.measure, Measure::Jam | Measure::SwitchedOn);
            if must_be_uniform && to - from < 1e-6 {
                return Err(RideProblem::NeverUniform(self.distance));
            }
            self.ride(|| 1.0)?;
        }
        Ok(())
    }

    /// A rest that is watched for itself.
    ///
    /// # Errors
    /// Where it is too long to be held.
    pub fn still(&self) -> Result<Ride, RideError> {
        Ride::still(self.rate, self.length)
    }

    /// A ride; its rests and the moment of a jam are drawn by `uniform`, numbers in [0, 1].
    ///
    /// # Errors
    /// Where it is too long to be held.
    pub fn ride(&self, mut uniform: impl FnMut() -> f64) -> Result<Ride, RideError> {
        let [shortest, longest] = self.rest;
        let rests = (0..=self.trips).map(|_| shortest + (longest - shortest) * uniform());
        let rests = rests.collect();
        let mut trips: Vec<Trip> = (0..self.trips)
            .map(|index| self.trip(index, Ending::Commanded))
            .collect();
        if let (Measure::Jam, Some(last)) = (self.measure, trips.last_mut()) {
            let refused = |reason| RideError::Trip { number: 1, reason };
            let (from, to) = last.course().map_err(refused)?.uniform_motion();
            last.ending = Ending::Jam {
                after: (from + (to - from) * uniform()).min(to),
                within: self.jam_within,
            };
        }
        Ride::new(self.rate, rests, trips)
    }

    fn trip(&self, index: usize, ending: Ending) -> Trip {
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        Trip {
            distance: sign * self.distance,
            drive: self.drive,
            ending,
        }
    }
}

impl RideKeys {
    fn check(&self) -> Result<(), RideProblem> {
        for (key, value) in [
            ("ride.speed", Some(self.speed)),
            ("ride.acceleration", Some(self.acceleration)),
            ("ride.jerk", Some(self.jerk)),
            ("ride.distance", Some(self.distance)),
            ("ride.length", Some(self.length)),
            ("ride.jam_within", Some(self.jam_within)),
            ("ride.tolerance", Some(self.tolerance)),
            ("ride.density", self.density),
            ("ride.delta_over_sigma", self.delta_over_sigma),
        ] {
            Rule::Positive.check(key, &value)?;
        }
        Rule::Within(1.0, MOST_TRIPS as f64, "").check("ride.trips", &self.trips)?;
        let [shortest, longest] = self.rest;
        if !(0.0 < shortest && shortest <= longest) {
            let rule = "be two lengths in s, [shortest, longest]";
            let got = format_args!("[{shortest}, {longest}]");
            return Err(OutOfRange::new("ride.rest", rule, got).into());
        }
        Ok(())
    }

    fn sigma(&self, drive: &Drive) -> Result<f64, RideProblem> {
        match (self.sigma, self.density, self.delta_over_sigma) {
            (None, None, None) => Ok(SIGMA),
            (Some(sigma), None, None) => Ok(sigma),
            (None, Some(density), None) => Ok(density * libm::sqrt(self.rate / 2.0)),
            (None, None, Some(ratio)) => Ok(drive.acceleration / ratio),
            _ => Err(RideProblem::Strength),
        }
    }

    fn pickup(&self, drive: &Drive) -> Result<Pickup, RideProblem> {
        Ok(Pickup {
            sensor: Sensor::from_ar(self.ar.clone())?,
            digitiser: Digitiser::from((self.quantum, None)),
            vibration: self.vibration,
            impulses: Impulses {
                nu: self.nu,
                theta: self.theta,
                during: During::Motion,
            },
            disturbance: Disturbance {
                footfalls: self.footfalls,
                jolt: self.jolt,
                ..Disturbance::default()
            },
            ..Pickup::white(self.sigma(drive)?)
        }
        .checked()?)
    }
}
